// A house style in films and pictures: what it changes, what depends on it, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kStyledScene = "assets/scenes/rr_free.yaml";
const Words kStyledFilm{"--set", "video.width=96", "--set", "video.height=54", "--set", "duration=2.2"};  // two chunks of a film

std::string colored_square(const std::string& color) {
  return "<svg xmlns='http://www.w3.org/2000/svg' width='10' height='10'><rect width='10' height='10' fill='" + color + "'/></svg>";
}

class HouseStyleFilm : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name)) << text;
    return fs::absolute(folder_.file(name)).string();
  }
  // With the style in a file of this text.
  Words with_style(const Words& words, const std::string& text) const {
    return with(with(words, kStyledFilm), {"--set", "style=" + write("lab.yaml", text)});
  }
  const TemporaryFolder folder_;
};

TEST_F(HouseStyleFilm, ExampleIsDrawnAndSaysNothingAgainstItself) {
  for (const std::string theme : {"light", "dark"}) {
    const std::string svg = folder_.file(theme + ".svg");
    const ProgramResult run = run_program({"snapshot", kStyledScene, "--at", "1", "--theme", theme, "-o", svg, "--set",
                                           "style=" + fs::absolute("assets/styles/lecture.yaml").string()});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("contrast")));
    EXPECT_THAT(read_whole_file(svg), HasSubstr("#8ecae6")) << "pages of vectors have the same style";
  }
}

// Files that the command line names lie where it is typed, else where the scene's own do: models, styles, logos, tables alike.
TEST(PathsOfTheCommandLine, StartInTheWorkingFolderAndThenBesideTheScene) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "here");
  fs::create_directories(folder.path() / "scenes");
  const std::string rr = read_whole_file("models/rr.urdf"), rrr = read_whole_file("models/rrr.urdf");
  folder.write("here/mine.urdf", rr);
  folder.write("here/both.urdf", rr);
  folder.write("scenes/both.urdf", rrr);
  folder.write("scenes/theirs.urdf", rrr);
  folder.write("here/uni.yaml", "light: {ink: \"#102030\"}\n");
  folder.write("here/push.csv", "t,tau1,tau2\n0,1,0\n1,2,0\n");
  folder.write("scenes/s.yaml", "model: theirs.urdf\nmethod: rk4\nstep: 0.01\nduration: 0.1\n");
  const RunOptions here{.folder = (folder.path() / "here").string()};
  const auto check = [&](const Words& more) { return run_program(with({"check", "../scenes/s.yaml"}, more), here); };
  const auto model_of = [&](const std::string& name) {
    const ProgramResult run = run_program({"simulate", "../scenes/s.yaml", "-o", "a.csv", "--force", "--json", "--set", "model=" + name}, here);
    EXPECT_EQ(run.status, 0) << run.err;
    const std::string head = read_whole_file((folder.path() / "here/a.csv").string()).substr(0, 200);
    return head.find("q3") == std::string::npos ? 2 : 3;
  };
  EXPECT_EQ(model_of("mine.urdf"), 2);
  EXPECT_EQ(model_of("both.urdf"), 2) << "here comes first";
  EXPECT_EQ(model_of("theirs.urdf"), 3) << "else as in the scene's file";
  EXPECT_EQ(check({"--set", "style=uni.yaml"}).status, 0);
  EXPECT_EQ(check({"--set", "model=mine.urdf", "--set", "torque={csv: push.csv}"}).status, 0) << "what lies in a value, too";
  EXPECT_EQ(run_program({"check", "rr_free", "--set", "style=uni.yaml"}, here).status, 0) << "of a scene that comes with the program";
  EXPECT_THAT(check({"--set", "style=none.yaml"}).err, HasSubstr("paths of --set are looked for from the working folder, then from the scene's"));
  EXPECT_THAT(check({"--set", "model=none.urdf"}).err, HasSubstr("paths of --set are looked for from the working folder"));
  // What stands in the file is never looked for here.
  folder.write("scenes/s.yaml", "model: mine.urdf\nmethod: rk4\nduration: 0.1\n");
  EXPECT_THAT(check({}).err, HasSubstr("paths are relative to the scene file"));
}

TEST_F(HouseStyleFilm, SaysWhatCannotBeReadAndInItsReport) {
  const ProgramResult run = run_program(with_style({"render", kStyledScene, "-o", folder_.file("a.gif")}, "light: {ink: \"#AAAAAA\"}\n"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("style: ink has a contrast of 2.3"));
  const Json report = parse_json(read_whole_file(folder_.file("a.json")));
  EXPECT_THAT(report["style"]["low_contrast"][0].get<std::string>(), HasSubstr("ink"));
}

TEST_F(HouseStyleFilm, TellsWhichFontsStandInForScriptsThatItsOwnLack) {
  const auto report_of = [&](const std::string& title) {
    const ProgramResult run = run_program({"render", kStyledScene, "--force", "--quiet", "-o", folder_.file("a.gif"), "--set", "title=" + title,
                                           "--set", "duration=0.1", "--set", "video.width=320", "--set", "video.height=180"});
    EXPECT_EQ(run.status, 0) << run.err;
    return parse_json(read_whole_file(folder_.file("a.json")));
  };
  const Json report = report_of("\u6a5f\u68b0");  // fonts-droid-fallback, or whatever else has them
  ASSERT_EQ(report["style"]["fallback_fonts"].size(), 1u) << report["style"];
  EXPECT_EQ(report["style"]["fallback_fonts"][0]["sha256"].get<std::string>().size(), 64u);
  EXPECT_TRUE(report_of("\u03c4 \u00e9").value("style", Json()).is_null()) << "these are the program's own";
}

TEST_F(HouseStyleFilm, LogoStandsOnFiguresAndChartsToo) {
  write("logo.svg", colored_square("#12AB34"));
  const std::string style = "style=" + write("lab.yaml", "logo: {file: logo.svg}\n"), svg = folder_.file("a.svg");
  const Words scene{kStyledScene, "--set", "duration=0.5"};
  for (const Words& words : {with({"snapshot"}, scene), Words{"snapshot", "models/rr.urdf", "--pose", "0.3,0.4"}, Words{"ellipse", "models/rr.urdf", "--pose", "0.3,0.4"},
                             Words{"ellipse", "models/rr.urdf", "--joint-space", "--pose", "0.3,0.4"}, Words{"ellipse", "--along", kStyledScene, "--set", "duration=0.5"},
                             with({"energy"}, scene), with({"chart", "--methods", "rk4"}, scene)}) {
    const ProgramResult run = run_program(with(words, {"--set", style, "--force", "-o", svg}));
    ASSERT_EQ(run.status, 0) << words.front() << run.err;
    EXPECT_THAT(read_whole_file(svg), HasSubstr("#12ab34")) << words.front() << words.back();
  }
}

TEST_F(HouseStyleFilm, LogosThatNeedOtherFilesAreRefused) {
  const auto snapshot_with = [&](const std::string& inside) {
    write("logo.svg", "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='10' height='10'>"
                      "<g id='g'><rect width='10' height='10'/></g>" + inside + "</svg>");
    return run_program(with_style({"snapshot", kStyledScene, "--force", "-o", folder_.file("a.png")}, "logo: {file: logo.svg}\n"));
  };
  for (const char* inside : {"<image href='seal.png' width='9' height='9'/>", "<g><image xlink:href='https://a.org/seal.png'/></g>",
                             "<use href='other.svg#g'/>", "<style>@import url(o.css);</style>", "<rect style=\"fill: url( 'o.svg#g')\" width='1' height='1'/>",
                             "<rect filter='url(o.svg#f)' width='1' height='1'/>"}) {
    const ProgramResult run = snapshot_with(inside);
    EXPECT_EQ(run.status, 3) << inside;
    EXPECT_THAT(run.err, AllOf(HasSubstr("logo.svg"), HasSubstr("from outside of the file"))) << inside;
  }
  const std::string pixel = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
  for (const std::string& inside : {"<image href='" + pixel + "' width='9' height='9'/>", std::string("<use href='#g'/>"),
                                    std::string("<a href='https://a.org/'><rect width='3' height='3'/></a>")})
    EXPECT_EQ(snapshot_with(inside).status, 0) << inside;
  EXPECT_THAT(snapshot_with("<foreignObject width='9' height='9'><p/></foreignObject>").err, HasSubstr("<foreignObject> is not drawn"));
  EXPECT_EQ(snapshot_with("<rect fill='url(#none)' style='fill:url(\"#g\")' width='1' height='1'/>").status, 0);
}

TEST_F(HouseStyleFilm, PartsDependOnTheLogosBytes) {
  const auto part = [&](const std::string& which) {
    return run_program(with_style({"render", kStyledScene, "--quiet", "-o", folder_.file("a.mp4"), "--shard", which}, "logo: {file: logo.svg}\n"));
  };
  write("logo.svg", colored_square("red"));
  ASSERT_EQ(part("1/2").status, 0);
  ASSERT_EQ(part("2/2").status, 0);
  const Words join{"join", folder_.file("a.part-1-of-2.mp4"), folder_.file("a.part-2-of-2.mp4"), "-o", folder_.file("whole.mp4"), "--force"};
  EXPECT_EQ(run_program(join).status, 0);
  write("logo.svg", colored_square("blue"));
  ASSERT_EQ(run_program(with(with_style({"render", kStyledScene, "--quiet", "-o", folder_.file("a.mp4"), "--shard", "2/2"}, "logo: {file: logo.svg}\n"),
                             {"--force"})).status, 0);
  const ProgramResult mixed = run_program(join);
  EXPECT_EQ(mixed.status, 3) << "half of the film would have another logo";
  EXPECT_THAT(mixed.err, HasSubstr("its style's logo or font files are others"));
}

TEST_F(HouseStyleFilm, SweptFilesAreDrawnAnewWhereTheLogoIsAnother) {
  write("logo.svg", colored_square("red"));
  const auto sweep = [&](const Words& more) {
    return run_program(with(with_style({"sweep", kStyledScene, "--over", "start.q.1=0,1", "--each", "png", "-o", folder_.file("runs/")},
                                       "logo: {file: logo.svg}\n"),
                            more)).out;
  };
  EXPECT_THAT(sweep({}), HasSubstr("0 of them done before"));
  EXPECT_THAT(sweep({"--force"}), HasSubstr("2 of them done before"));
  write("logo.svg", colored_square("blue"));
  EXPECT_THAT(sweep({"--force"}), HasSubstr("0 of them done before"));
}

TEST_F(HouseStyleFilm, FacesAreThoseThatAreNamedOrNone) {
  const std::string out = folder_.file("a.svg");
  const ProgramResult gone = run_program(with_style({"snapshot", kStyledScene, "-o", out}, "fonts: {label: \"DejaVu Sanz\"}\n"));
  EXPECT_EQ(gone.status, 4);
  EXPECT_THAT(gone.err, AllOf(HasSubstr("'DejaVu Sanz' is not installed"), HasSubstr("did you mean 'DejaVu Sans'?")));
  const ProgramResult no_math = run_program(with_style({"snapshot", kStyledScene, "-o", out}, "fonts: {math: \"DejaVu Sans Mono\"}\n"));
  EXPECT_EQ(no_math.status, 4);
  EXPECT_THAT(no_math.err, HasSubstr("MATH table"));
  // The program's own face by its name: the same picture, and the file is told.
  const std::string plain = folder_.file("plain.png"), named = folder_.file("named.png");
  ASSERT_EQ(run_program(with({"snapshot", kStyledScene, "-o", plain}, kStyledFilm)).status, 0);
  ASSERT_EQ(run_program(with_style({"snapshot", kStyledScene, "-o", named}, "fonts: {label: DejaVu Sans}\n")).status, 0);
  EXPECT_EQ(run_program({"compare", plain, named}).status, 0);
}

}  // namespace
}  // namespace chainreel

// Scenes that compare, as files: film, audit, numbers and exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// PP on a spring: half a second of it, small. Steps of 1 ms are calm; with explicit Euler and a stiff spring
// the amplitude grows by half at every step.
constexpr char kTwoPanels[] = R"(title: Two
model: MODEL
gravity: [0, 0, 0]
start: {q: [0, 1]}
torque: [0, -k * y_G]
parameters: {k: 100}
duration: 0.5
method: semi_implicit_euler
step: 0.001
video: {width: 320, height: 180}
text_scale: 1.5
)";

class CompareFilm : public ::testing::Test {
 protected:
  std::string scene(const std::string& panels) const {
    std::string text = kTwoPanels;
    const std::string model = (fs::path(CHAINREEL_SOURCE_FOLDER) / "models/pp.urdf").string();
    text.replace(text.find("MODEL"), 5, model);
    return folder_.write("two.yaml", text + panels);
  }
  std::string calm_and_wild(const std::string& expect) const {
    return scene(
        "compare:\n  - title: calm\n  - {title: wild, method: explicit_euler, parameters.k: 1e6, expect: " +
        expect + "}\n");
  }
  ProgramResult render(const std::string& scene, std::vector<std::string> more = {}) const {
    std::vector<std::string> command{"render", scene, "-o", folder_.file("two.mp4"), "--quiet"};
    command.insert(command.end(), more.begin(), more.end());
    return run_program(command);
  }

  TemporaryFolder folder_;
};

TEST_F(CompareFilm, OfAPanelThatDivergesAsExpectedIsAWholeFilm) {
  const ProgramResult result = render(calm_and_wild("diverge"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(probe_video(folder_.file("two.mp4")).frames, 30);
  const Json audit = Json::parse(read_whole_file(folder_.file("two.json")));
  EXPECT_EQ(audit["title"], "Two");
  EXPECT_EQ(audit["layout"], "compare");
  EXPECT_EQ(audit["frames"], 30);
  ASSERT_EQ(audit["panels"].size(), 2u);
  const Json &calm = audit["panels"][0], &wild = audit["panels"][1];
  EXPECT_EQ(calm["title"], "calm");
  EXPECT_EQ(calm["status"], "finished");
  EXPECT_EQ(calm["method"], "semi_implicit_euler");
  EXPECT_EQ(calm["step"], 0.001);
  EXPECT_TRUE(calm["left_picture_at"].is_null());
  EXPECT_EQ(wild["status"], "diverged");
  EXPECT_EQ(wild["expect"], "diverge");
  EXPECT_EQ(wild["method"], "explicit_euler");
  EXPECT_GT(wild["left_picture_at"].get<double>(), 0);
  EXPECT_LT(wild["left_picture_at"].get<double>(), 0.1);
  EXPECT_NE(calm["trajectory_sha256"], wild["trajectory_sha256"]);
  for (const Json& panel : audit["panels"]) EXPECT_TRUE(panel.contains("energy_error"));
}

TEST_F(CompareFilm, OfAPanelThatDivergesUnasked) {
  const ProgramResult result = render(calm_and_wild("finish"));
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("panel 2 (wild): "));
  EXPECT_THAT(result.err, HasSubstr("diverged at joint"));
  EXPECT_FALSE(fs::exists(folder_.file("two.mp4")));
  EXPECT_EQ(probe_video(folder_.file("two.partial.mp4")).frames, 30) << "the calm panel goes on";
}

TEST_F(CompareFilm, OfAPanelThatShouldDivergeButDoesNotIsExitFive) {
  const ProgramResult result =
      render(scene("compare:\n  - title: calm\n  - {title: too calm, expect: diverge}\n"));
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("two.yaml:14:"));
  EXPECT_THAT(result.err,
              HasSubstr("panel 2 (too calm): the run was expected to diverge, but finished at t = 0.5 s"));
}

TEST_F(CompareFilm, ThePlainSceneMayExpectToDiverge) {
  const std::vector<std::string> wild{"--set", "method=explicit_euler", "--set", "parameters.k=1e6"};
  EXPECT_EQ(render(scene("expect: diverge\n"), wild).status, 0);
  EXPECT_EQ(probe_video(folder_.file("two.mp4")).frames, 30);
  EXPECT_EQ(render(scene("expect: diverge\n"), {"--force"}).status, 5);  // negative control: it does not
}

TEST_F(CompareFilm, IsTheSameFileTwice) {
  ASSERT_EQ(render(calm_and_wild("diverge")).status, 0);
  const std::string once = read_whole_file(folder_.file("two.mp4"));
  ASSERT_EQ(render(calm_and_wild("diverge"), {"--force"}).status, 0);
  EXPECT_EQ(once, read_whole_file(folder_.file("two.mp4")));
}

TEST_F(CompareFilm, APanelRunsAsItWouldByItself) {
  ASSERT_EQ(render(scene("compare:\n  - {}\n  - {method: rk4}\n")).status, 0);
  const Json both = Json::parse(read_whole_file(folder_.file("two.json")));
  ASSERT_EQ(render(scene(""), {"--force", "--set", "method=rk4"}).status, 0);
  const Json alone = Json::parse(read_whole_file(folder_.file("two.json")));
  EXPECT_EQ(both["panels"][1]["trajectory_sha256"], alone["trajectory_sha256"]);
  EXPECT_NE(both["panels"][0]["trajectory_sha256"], alone["trajectory_sha256"]);  // negative control
  EXPECT_EQ(both["panels"][0]["title"], "semi-implicit Euler");
  EXPECT_EQ(both["panels"][1]["title"], "RK4");
}

TEST_F(CompareFilm, SimulateWritesAFileForEachPanelOrTheOneThatIsAskedFor) {
  const std::string two = calm_and_wild("diverge");
  const std::string csv = folder_.file("two.csv");
  const ProgramResult all = run_program({"simulate", two, "-o", csv});
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_FALSE(fs::exists(csv));
  const std::string first = read_whole_file(folder_.file("two.1.csv"));
  const std::string second = read_whole_file(folder_.file("two.2.csv"));
  EXPECT_NE(first, second);
  const ProgramResult one = run_program({"simulate", two, "-o", "-", "--panel", "1"});
  EXPECT_EQ(one.out, first);
  EXPECT_EQ(run_program({"simulate", two, "-o", "-"}).status, 2);
  EXPECT_EQ(run_program({"simulate", two, "--panel", "3"}).status, 2);
  const ProgramResult json = run_program({"simulate", two, "-o", csv, "--json", "--force"});
  EXPECT_EQ(Json::parse(json.out)["panels"].size(), 2u);
}

TEST_F(CompareFilm, SnapshotDrawsThePanelsAlsoBehindTheEndOfOne) {
  const std::string two = calm_and_wild("diverge");
  const ProgramResult late = run_program({"snapshot", two, "--at", "0.45", "-o", folder_.file("late.png")});
  EXPECT_EQ(late.status, 0) << late.err;
  const ProgramResult failed =
      run_program({"snapshot", calm_and_wild("finish"), "--at", "0.45", "-o", folder_.file("never.png")});
  EXPECT_EQ(failed.status, 5);
  EXPECT_FALSE(fs::exists(folder_.file("never.png")));
}

// Of two --set of one key the later holds, as without panels.
TEST_F(CompareFilm, LaterSettingsReplaceEarlierOnes) {
  for (const auto& [first, later] : {std::pair{"duration=1", "duration=0.5"}, {"torque.1=5", "torque=[0, 0]"}})
    EXPECT_EQ(run_program({"check", "assets/scenes/euler_gains_energy.yaml", "--set", first, "--set", later}).status, 0) << first;
}

TEST_F(CompareFilm, VaryIsACompareWithoutAFile) {
  const std::string written = scene(
      "compare:\n  - {method: rk4, parameters.k: 100}\n  - {method: rk4, parameters.k: 50}\n"
      "  - {method: dop853, parameters.k: 100}\n  - {method: dop853, parameters.k: 50}\n");
  const ProgramResult file = run_program(
      {"snapshot", written, "--at", "0.2", "-o", folder_.file("file.svg"), "--set", "draw=[chain, trail]"});
  ASSERT_EQ(file.status, 0) << file.err;
  const std::string plain = scene("");
  const ProgramResult varied =
      run_program({"snapshot", plain, "--at", "0.2", "-o", folder_.file("varied.svg"), "--set",
                   "draw=[chain, trail]", "--vary", "method=rk4,dop853", "--vary", "parameters.k=100,50"});
  ASSERT_EQ(varied.status, 0) << varied.err;
  const auto without_memory = [&](const std::string& name) {
    const std::string text = read_whole_file(folder_.file(name));
    return text.substr(text.find("</metadata>"), text.rfind("<!-- sha256") - text.find("</metadata>"));  // which is of the memory, too
  };
  EXPECT_EQ(without_memory("file.svg"), without_memory("varied.svg"));
  const ProgramResult other =
      run_program({"snapshot", plain, "--at", "0.2", "-o", folder_.file("other.svg"), "--set",
                   "draw=[chain, trail]", "--vary", "method=rk4,dop853", "--vary", "parameters.k=100,60"});
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_NE(without_memory("file.svg"), without_memory("other.svg"));
}

// Methods look alike, six of them, too: what is wrong with the energy tells them apart, and by its colours who is who.
TEST_F(CompareFilm, OfSixMethodsHasAPlotInTheColoursOfItsPanels) {
  const auto svg_of = [&](const std::string& varied) {
    const ProgramResult result = run_program({"snapshot", "rr_free", "--vary", varied, "--set", "step=5ms", "--set", "acknowledge=[energy]", "--at", "1", "-o", folder_.file("six.svg"), "--force"});
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(folder_.file("six.svg"));
  };
  const auto colour_of = [](const std::string& svg, const std::string& title) {
    const std::size_t word = svg.find(">" + title + "<"), fill = svg.rfind("fill=\"", word);
    return word == std::string::npos ? "" : svg.substr(fill + 6, 7);
  };
  const std::string methods = svg_of("method=explicit_euler,semi_implicit_euler,rk4,taylor,symplectic_euler,verlet");
  EXPECT_THAT(methods, HasSubstr("energy error [J]"));
  std::set<std::string> colours;
  for (const char* title : {"explicit Euler", "semi-implicit Euler", "RK4", "symplectic Euler", "Verlet"}) {
    const std::string colour = colour_of(methods, title);
    EXPECT_THAT(methods, HasSubstr("stroke=\"" + colour)) << title << ": no curve and no trail has its colour";
    colours.insert(colour);
  }
  EXPECT_EQ(colours.size(), 5u);
  const std::string starts = svg_of("start.q.1=10deg:60deg:6");
  EXPECT_EQ(starts.find("energy error [J]"), std::string::npos) << "negative control: these are seen to differ";
}

// On a small page panels above a plot are so low that nothing is seen in them: they stand beside it.
TEST_F(CompareFilm, StandsBesideItsPlotWhereThatMakesItMuchLarger) {
  const auto left_of_second = [&](const std::string& width, const std::string& height) {
    const ProgramResult result = run_program({"snapshot", "redundant", "--at", "1", "--width", width, "--height", height, "-o", folder_.file("two.svg"), "--force", "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
    const std::string svg = read_whole_file(folder_.file("two.svg"));
    const std::size_t x = svg.rfind("x=\"", svg.find(">twice<"));
    return std::stod(svg.substr(x + 3)) / 960;  // of its view box
  };
  EXPECT_LT(left_of_second("480", "270"), 0.4) << "both panels and the plot in one row";
  EXPECT_GT(left_of_second("1920", "1080"), 0.5) << "negative control: half of the page each";
}

TEST_F(CompareFilm, VaryRefusesWhatDoesNotFitAPage) {
  const std::string plain = scene("");
  const ProgramResult many = run_program({"snapshot", plain, "--vary", "parameters.k=1:100:13"});
  EXPECT_EQ(many.status, 2);
  EXPECT_THAT(many.err, HasSubstr("13 panels"));
  const ProgramResult unknown = run_program({"render", plain, "--vary", "metod=rk4,taylor"});
  EXPECT_EQ(unknown.status, 3);
  EXPECT_THAT(unknown.err, HasSubstr("method"));
}

TEST_F(CompareFilm, CheckPrintsASceneThatReadsBackTheSame) {
  const ProgramResult once = run_program({"check", calm_and_wild("diverge"), "--json"});
  ASSERT_EQ(once.status, 0) << once.err;
  const Json report = Json::parse(once.out);
  EXPECT_EQ(report["panels"].size(), 2u);
  EXPECT_EQ(report["panels"][1]["cost"]["status"], "diverged");
  const std::string text = report["scene"].get<std::string>();
  const ProgramResult again = run_program({"check", folder_.write("again.yaml", text), "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["scene"], text);
  EXPECT_THAT(run_program({"check", folder_.file("again.yaml")}).out, HasSubstr("panel 2: wild"));
}

}  // namespace
}  // namespace chainreel

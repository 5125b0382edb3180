// chainreel ellipse: where poses come from, what is written, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// Runs `ellipse` with these words and a small picture.
ProgramResult draw(std::vector<std::string> words, const std::string& output) {
  std::vector<std::string> all{"ellipse"};
  all.insert(all.end(), words.begin(), words.end());
  all.insert(all.end(), {"-o", output, "--width", "640", "--height", "360"});
  return run_program(all);
}

Json report_of(const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  std::vector<std::string> all = words;
  all.push_back("--json");
  const ProgramResult result = draw(all, folder.file("a.png"));
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? Json::parse(result.out) : Json{};
}

std::string golden(const std::vector<std::string>& words, const std::string& name) {
  const TemporaryFolder folder;
  std::vector<std::string> all = words;
  all.insert(all.end(), {"--text-scale", "1.5"});
  const std::string file = folder.file("a.png");
  const ProgramResult result = draw(all, file);
  if (result.status != 0) return result.err;
  const auto same = matches_golden(read_png(file), name, {.max = 24, .mean = 0.05});
  return same ? "" : same.message();
}

// A scene lends its model where that stands in it in numbers, as everything else takes it.
TEST(Ellipse, TakesTheModelOfAScene) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "two.yaml", "title: of the film\nmodel: {links: [1, 1], masses: 1, shape: point}\nmethod: rk4\nduration: 1\n");
  const std::string rows = folder.write("dh.yaml", "model: {dh: [[1, 0, 0, 0], [1, 0, 0, 0]], masses: 1, shape: point}\n");
  const Json of_file = report_of({"models/rr.urdf", "--pose", "0.3,1.2"});
  for (const std::string& named : {scene, rows}) {
    const Json of_numbers = report_of({named, "--pose", "0.3,1.2"});
    for (int i = 0; i < 2; ++i)  // the round-off of two writings of one chain
      EXPECT_NEAR(of_numbers["poses"][0]["eigenvalues"][std::size_t(i)].get<double>(), of_file["poses"][0]["eigenvalues"][std::size_t(i)].get<double>(), 1e-12) << named;
    EXPECT_EQ(report_of({named, "--field", "--samples", "5"})["poses"].size(), report_of({"models/rr.urdf", "--field", "--samples", "5"})["poses"].size()) << named;
    EXPECT_EQ(report_of({named, "--sweep", "q2=30deg:150deg:4"})["poses"].size(), 4u);
    EXPECT_EQ(draw({named, "--pose", "0.3,1.2", "--joint-space", "--force"}, folder.file("j.svg")).status, 0);
  }
  EXPECT_EQ(draw({scene, "--pose", "0,1"}, folder.file("t.svg")).status, 0);
  const std::string page = text_of(folder.file("t.svg"));  // behind what it remembers of the scene
  EXPECT_THAT(page.substr(page.find("</metadata>")), testing::Not(HasSubstr("of the film")));
  EXPECT_THAT(draw({scene}, folder.file("x.png")).err, HasSubstr("the ellipses along its motion are `--along " + scene + "`"));
  EXPECT_THAT(draw({"assets/scenes/pen.yaml", "--pose", "0,0,0"}, folder.file("x.png")).err, HasSubstr("has constraints"));
  EXPECT_EQ(draw({"rr", "--pose", "0,1"}, folder.file("bare.png")).status, 0) << "the model of that name";
  EXPECT_THAT(draw({"nothing", "--pose", "0,1"}, folder.file("x.png")).err, HasSubstr("neither a model (.urdf) nor a scene (.yaml)"));
  EXPECT_EQ(draw({"assets/scenes/compare.yaml", "--pose", "0,1"}, folder.file("x.png")).status == 0, false) << "which panel's?";
}

TEST(Ellipse, SweepsRefuseUnitsOfAnotherKindAndDoubtRadians) {
  const TemporaryFolder folder;
  EXPECT_THAT(draw({"models/rr.urdf", "--sweep", "q2=1m,2m"}, folder.file("a.png")).err, HasSubstr("is in the unit m, but this is in rad"));
  EXPECT_THAT(draw({"models/rr.urdf", "--sweep", "q2=0:1m:3"}, folder.file("a.png")).err, HasSubstr("is in the unit m, but this is in rad"));
  EXPECT_THAT(draw({"models/pp.urdf", "--sweep", "q2=0:90deg:3"}, folder.file("a.png")).err, HasSubstr("is in the unit rad, but this is in m"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.png")));
  EXPECT_THAT(draw({"models/rr.urdf", "--sweep", "q2=0:90:3"}, folder.file("b.png")).err, HasSubstr("WARNING: --sweep: 45 of joint2 is in radians"));
  EXPECT_EQ(draw({"models/rr.urdf", "--sweep", "q2=0:90deg:3"}, folder.file("c.png")).err, "");
}

TEST(EllipseGoldens, OfEachKindOfFigure) {
  EXPECT_EQ(golden({"models/rr.urdf", "--pose", "0,90deg", "--pose", "0,150deg", "--reading", "belt"}, "ellipse_belt"), "");
  EXPECT_EQ(golden({"models/rr.urdf", "--pose", "0,90deg", "--pose", "0,0", "--reading", "energy"}, "ellipse_energy"), "");
  EXPECT_EQ(golden({"models/rr.urdf", "--sweep", "q2=30deg:150deg:5", "--layout", "superposed", "--theme", "dark"},
                   "ellipse_superposed_dark"), "");
  EXPECT_EQ(golden({"models/rr.urdf", "--field", "--samples", "8"}, "ellipse_field"), "");
  EXPECT_EQ(golden({"models/rr.urdf", "--pose", "0,90deg", "--joint-space"}, "ellipse_joint_space"), "");
}

TEST(EllipseNumbers, HaveTheSemiAxesOfTheReading) {
  const std::vector<std::string> folded{"models/rr.urdf", "--pose", "0,150deg", "--pose", "0,0", "--reading"};
  const auto with = [&](const std::string& reading) {
    std::vector<std::string> words = folded;
    words.push_back(reading);
    return report_of(words);
  };
  const Json mass = with("mass"), energy = with("energy");
  EXPECT_EQ(mass["reading"], "mass");
  EXPECT_EQ(mass["unit"], "kg");
  EXPECT_EQ(energy["unit"], "m/s");
  // A few roundings of numbers up to 5.
  EXPECT_NEAR(mass["poses"][0]["semi_axes"][0].get<double>(), 5, 1e-12);
  EXPECT_NEAR(mass["poses"][0]["semi_axes"][1].get<double>(), 1, 1e-12);
  EXPECT_NEAR(energy["poses"][0]["semi_axes"][0].get<double>(), 1 / std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(energy["poses"][0]["eigenvalues"][0].get<double>(), 5, 1e-12);
  EXPECT_NEAR(mass["poses"][0]["point"][0].get<double>(), 1 - std::sqrt(3.0) / 2, 1e-14);
  EXPECT_TRUE(mass["poses"][1]["Lambda"].is_null());
  EXPECT_TRUE(mass["poses"][1]["semi_axes"][0].is_null());
  EXPECT_EQ(energy["poses"][1]["semi_axes"][0], 0);
  EXPECT_EQ(mass["poses"][1]["singular_directions"].size(), 1u);
}

// The section by a plane that is tilted against the singular direction of a stretched arm: the energy's is a segment, whose length changes as little as the pose.
TEST(EllipseNumbers, OfSectionsAreKnownAtAndNearSingularPoses) {
  const TemporaryFolder folder;
  const std::string body = R"(<inertial><origin xyz="0.4 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.08" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial>)";
  const std::string model = folder.write("s.urdf", R"(<robot name="s"><link name="l0"/><link name="l1">)" + body + R"(</link><link name="l2">)" + body + R"(</link><link name="l3">)" + body +
      R"(</link><link name="tip"/><joint name="j1" type="continuous"><parent link="l0"/><child link="l1"/><axis xyz="0 0 1"/></joint>
      <joint name="j2" type="continuous"><parent link="l1"/><child link="l2"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/></joint>
      <joint name="j3" type="continuous"><parent link="l2"/><child link="l3"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
      <joint name="t" type="fixed"><parent link="l3"/><child link="tip"/><origin xyz="0.8 0 0" rpy="0.3 0.5 0.7"/></joint></robot>)");
  const auto axes = [&](const std::string& bend) {
    const ProgramResult result = run_program({"ellipse", model, "--pose", "0.3,0.4," + bend, "--shape", "section", "--reading", "energy", "-o", folder.file("e.json"), "--force", "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(read_whole_file(folder.file("e.json")))["poses"][0]["semi_axes"].get<std::vector<double>>();
  };
  const double far = axes("1e-4").back();
  EXPECT_GT(far, 0.1);
  for (const char* bend : {"1e-6", "1e-8", "0"}) {
    EXPECT_NEAR(axes(bend).back() / far, 1, 1e-3) << bend;  // O(bend) and what a mass beyond all leaves
    EXPECT_LT(axes(bend).front(), 1e-4) << bend;
  }
}

TEST(EllipseSweep, GoesThroughTheValuesOfOneCoordinate) {
  const Json report = report_of({"models/rr.urdf", "--pose", "0.3,0", "--sweep", "q2=0:180deg:9"});
  ASSERT_EQ(report["poses"].size(), 9u);
  EXPECT_EQ(report["poses"][4]["q"][0], 0.3);
  EXPECT_NEAR(report["poses"][4]["q"][1].get<double>(), std::acos(-1) / 2, 1e-15);
  const ProgramResult wrong = draw({"models/rr.urdf", "--sweep", "q3=0,1"}, "out/x.png");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("no such coordinate"));
}

TEST(EllipseAlong, TakesPosesFromTheMotion) {
  const Json report = report_of({"--along", "assets/scenes/rr_free.yaml", "--samples", "5"});
  ASSERT_EQ(report["poses"].size(), 5u);
  EXPECT_EQ(report["poses"][0]["t"], 0);
  EXPECT_EQ(report["poses"][4]["t"], 10);
  // Negative control: the chain has moved.
  EXPECT_NE(report["poses"][0]["q"], report["poses"][4]["q"]);
}

// How often a word is written, halos left out.
int count_of(const std::string& svg, const std::string& word) {
  int count = 0;
  for (std::size_t at = svg.find(word + "</tspan>"); at != std::string::npos; at = svg.find(word + "</tspan>", at + 1)) ++count;
  return count / 2;
}

// A motion there and back: what looks the same is drawn once, with all instants.
TEST(EllipseAlong, PosesThatLookTheSameAreOne) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.svg");
  ASSERT_EQ(draw({"--along", "assets/scenes/arm_ellipsoid.yaml"}, file).status, 0);
  for (const char* both : {"t = 0 s, t = 5 s", "t = 1 s, t = 4 s", "t = 2 s, t = 3 s"}) EXPECT_EQ(count_of(text_of(file), both), 1) << both;
  for (const char* length : {"1.65 m/s", "1.27 m/s", "0.426 m/s"}) EXPECT_EQ(count_of(text_of(file), length), 1) << "of both, at its axis: " << length;
  // Negative control: of a motion that comes back nowhere each pose has its own name.
  ASSERT_EQ(draw({"--along", "assets/scenes/rr_free.yaml", "--force"}, file).status, 0);
  for (const char* own : {"t = 2 s", "t = 4 s", "t = 10 s"}) EXPECT_EQ(count_of(text_of(file), own), 1) << own;
}

// An axis that leads out of the page has one number, wherever it is cut; the page in pixels is the scene's.
TEST(EllipseFilm, NumbersStandOnce) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.svg");
  for (const char* at : {"7.5", "7.56", "7.9", "8.1", "8.2", "8.3", "8.5"}) {
    ASSERT_EQ(run_program({"snapshot", "assets/scenes/rr_ellipse.yaml", "--at", at, "--width", "640", "--height", "360", "--quiet", "--force", "-o", file}).status, 0);
    const std::string svg = text_of(file);
    int numbers = 0;
    for (std::size_t place = svg.find(" kg</tspan>"); place != std::string::npos; place = svg.find(" kg</tspan>", place + 1)) ++numbers;
    EXPECT_EQ(numbers, 2 * 2 + 1) << at << ": of each axis one with its halo, and the scale's";
    EXPECT_THAT(svg, HasSubstr("width=\"640\" height=\"360\" viewBox=\"0 0 960 540\""));
  }
}

TEST(EllipseField, ReachesItsPoints) {
  const Json report = report_of({"models/rr.urdf", "--field", "--samples", "8"});
  // Cells of 0.5 m about +-0.25, +-0.75, ...: those within 2 m of the base.
  int within = 0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) within += std::hypot(0.5 * i - 1.75, 0.5 * j - 1.75) <= 2;
  ASSERT_EQ(report["poses"].size(), std::size_t(within));
  for (const Json& pose : report["poses"]) {
    for (const int axis : {0, 1}) {
      const double cells = (pose["point"][axis].get<double>() + 1.75) / 0.5;
      EXPECT_NEAR(cells, std::round(cells), 2e-9);
    }
    EXPECT_LE(pose["q"][1].get<double>(), 0);  // elbow up
  }
}

TEST(EllipseOutputs, AreWordsInPdfAndSvgAndNumbersInCsv) {
  const TemporaryFolder folder;
  for (const char* ending : {"svg", "pdf"}) {
    const std::string file = folder.file(std::string("a.") + ending);
    ASSERT_EQ(draw({"models/rr.urdf", "--pose", "0,1", "--reading", "belt"}, file).status, 0);
    EXPECT_GT(std::filesystem::file_size(file), 1000u);
  }
  EXPECT_THAT(text_of(folder.file("a.svg")), HasSubstr("belt"));
  const std::string table = folder.file("a.csv");
  ASSERT_EQ(draw({"models/rr.urdf", "--pose", "0,90deg", "--pose", "0,0"}, table).status, 0);
  EXPECT_THAT(text_of(table), HasSubstr("x [m],y [m],z [m],Lambda_inv_xx [1/kg],Lambda_inv_xy [1/kg],Lambda_inv_yy [1/kg],Lambda_xx [kg],Lambda_xy [kg],"
                                        "Lambda_yy [kg],mass_along_x [kg],mass_along_y [kg],eigenvalue1 [kg],direction1_x,direction1_y,"));
  EXPECT_THAT(text_of(table), HasSubstr(",inf,"));
  // Bent by a right angle the outer mass alone is felt along x, both across; stretched, nothing moves it along x.
  const Json poses = report_of({"models/rr.urdf", "--pose", "0,90deg", "--pose", "0,0"})["poses"];
  EXPECT_NEAR(poses[0]["mass_along"][0].get<double>(), 1, 1e-12);
  EXPECT_NEAR(poses[0]["mass_along"][1].get<double>(), 2, 1e-12);
  EXPECT_TRUE(poses[1]["mass_along"][0].is_null());
  EXPECT_NEAR(poses[1]["mass_along"][1].get<double>(), 1, 1e-12);
  EXPECT_NEAR(poses[0]["mass_along"][1].get<double>() * poses[0]["Lambda_inv"][1][1].get<double>(), 1, 1e-12);
}

// Words are 7 pt and larger where the page is as wide as it says.
TEST(EllipseOutputs, HaveTheirSizeOnPaper) {
  const TemporaryFolder folder;
  const auto draw_on_paper = [&](const std::string& name, std::vector<std::string> words) {
    words.insert(words.begin(), {"ellipse", "models/rr.urdf", "--sweep", "q2=30deg:150deg:6", "--width-mm", "84", "--letters"});
    words.insert(words.end(), {"-o", folder.file(name)});
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return text_of(folder.file(name));
  };
  const std::string svg = draw_on_paper("a.svg", {"--height-mm", "60"});
  EXPECT_THAT(svg, HasSubstr("width=\"84mm\" height=\"60"));
  EXPECT_THAT(svg, HasSubstr("(f)"));
  // 84 mm are 238.11 pt; 540 units of the page are 60 mm, 170.08 pt.
  const double pt_per_unit = 170.08 / 540;
  std::size_t sizes = 0;
  for (std::size_t at = svg.find("font-size=\""); at != std::string::npos; at = svg.find("font-size=\"", at + 1), ++sizes)
    EXPECT_GE(std::stod(svg.substr(at + 11)) * pt_per_unit, 7 - 1e-2);
  EXPECT_GT(sizes, 6u);
  draw_on_paper("a.pdf", {"--height-mm", "60"});
  EXPECT_THAT(run_command({"pdfinfo", folder.file("a.pdf")}).out, HasSubstr("238.11 x 170."));
  const std::string png = draw_on_paper("a.png", {"--dpi", "100"});
  const std::size_t at = png.find("pHYs");
  ASSERT_NE(at, std::string::npos);
  // 331 pixels of 84 mm: 3940 a metre, in two bytes behind two zeros.
  EXPECT_EQ(png.substr(at + 4, 4), std::string("\0\0\x0f\x64", 4));
  EXPECT_EQ(read_png(folder.file("a.png")).width, 331);
  // Negative control: without a size on paper there is none.
  ASSERT_EQ(draw({"models/rr.urdf", "--pose", "0,1"}, folder.file("b.png")).status, 0);
  EXPECT_EQ(text_of(folder.file("b.png")).find("pHYs"), std::string::npos);
}

// However it is written.
TEST(EllipseOutputs, AreNoFileThatIsNamedTwice) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program({"ellipse", "models/rr.urdf", "--pose", "0,1", "-o", folder.file("a.csv"), "-o", folder.file("./a.csv")}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.csv")));
}

TEST(EllipseOptions, ThatDoNotGoTogetherAreNamed) {
  const auto error = [](const std::vector<std::string>& words) {
    const ProgramResult result = draw(words, "out/x.png");
    EXPECT_EQ(result.status, 2) << result.err;
    return result.err;
  };
  EXPECT_THAT(error({"models/rr.urdf"}), HasSubstr("which poses?"));
  EXPECT_THAT(error({"--pose", "0,1"}), HasSubstr("which model?"));
  EXPECT_THAT(error({"models/rr.urdf", "--field", "--pose", "0,1"}), HasSubstr("leave out --pose"));
  EXPECT_THAT(error({"models/rrr.urdf", "--pose", "0,1,1", "--joint-space"}), HasSubstr("--joints 1,2"));
  EXPECT_THAT(error({"models/rrr.urdf", "--pose", "0,1,1", "--joint-space", "--joints", "1,4"}),
              HasSubstr("between 1 and 3"));
  EXPECT_THAT(error({"models/pp.urdf", "--field"}), HasSubstr("without limits"));
  EXPECT_THAT(error({"models/rr.urdf", "--pose", "0,1", "--joint-space", "--reading", "belt"}),
              HasSubstr("leave out --reading"));
  EXPECT_THAT(error({"models/rr.urdf", "--pose", "0,1", "--width-mm", "84"}), HasSubstr("leave out --width"));
  EXPECT_THAT(error({"models/rr.urdf", "--pose", "0,1", "--dpi", "600"}), HasSubstr("go with --width-mm"));
  EXPECT_THAT(error({"models/rr.urdf", "--pose", "0,1", "--width-mm", "0"}), HasSubstr("between 20 and 2000"));
  EXPECT_THAT(error({"models/rr.urdf", "--field", "--letters"}), HasSubstr("--letters name panels"));
  EXPECT_THAT(error({"models/rr.urdf", "--along", "assets/scenes/rr_free.yaml"}), HasSubstr("leave out models/rr.urdf"));
}

TEST(EllipseScene, NamesItsReading) {
  const TemporaryFolder folder;
  const auto snapshot = [&](const std::string& reading) {
    const std::string file = folder.file(reading + ".png");
    const ProgramResult result =
        run_program({"snapshot", "assets/scenes/rr_ellipse.yaml", "--at", "1", "-o", file, "--set", "video.width=320",
                     "--set", "video.height=180", "--set", "ellipse.reading=" + reading});
    EXPECT_EQ(result.status, reading == "tensor" ? 3 : 0) << result.err;
    return result.err;
  };
  for (const char* reading : {"mass", "energy", "belt"}) EXPECT_EQ(snapshot(reading), "");
  EXPECT_NE(read_png(folder.file("mass.png")).bgra, read_png(folder.file("belt.png")).bgra);
  EXPECT_NE(read_png(folder.file("mass.png")).bgra, read_png(folder.file("energy.png")).bgra);
  EXPECT_THAT(snapshot("tensor"), HasSubstr("'ellipse.reading' must be mass, energy or belt"));
}

// An example in a message is one for the model that was given.
TEST(EllipseSweep, GivesAnExampleThatTheModelTakes) {
  for (const auto& [model, wrong] : {std::pair{"models/pp.urdf", "q1=0:90deg:3"}, {"models/pp.urdf", "q2=0:1"}, {"models/p.urdf", "q2=0:1:3"}, {"models/rr.urdf", "q2=0:1m:3"}}) {
    const ProgramResult refused = run_program({"ellipse", model, "--sweep", wrong});
    EXPECT_EQ(refused.status, 2);
    const std::string like = "like --sweep ";
    const std::size_t at = refused.err.find(like);
    ASSERT_NE(at, std::string::npos) << refused.err;
    const std::string example = refused.err.substr(at + like.size(), refused.err.find_first_of("; \n", at + like.size()) - at - like.size());
    const TemporaryFolder folder;
    const ProgramResult taken = run_program({"ellipse", model, "--sweep", example, "-o", folder.file("a.csv")});
    EXPECT_EQ(taken.status, 0) << example << ": " << taken.err;
  }
}

TEST(EllipseCommand, TitlesAreFormulasOrRefused) {
  const TemporaryFolder folder;
  const auto titled = [&](const char* title) {
    return run_program({"ellipse", "models/rr.urdf", "--pose", "0,1", "--title", title, "--width", "320", "--height", "180", "--force", "--quiet", "-o", folder.file("a.svg")});
  };
  EXPECT_EQ(titled("$\\Lambda$ for \\$5").status, 0);
  EXPECT_THAT(titled("$\\foo$").err, HasSubstr("\\foo is not known"));
  EXPECT_THAT(titled("$col{a; b}$").err, HasSubstr("no room in a line"));
}

// A point at the end effector weighs the same in each direction: Lambda' = J^-T (M + m J^T J) J^-1 = Lambda + m.
TEST(PayloadCommand, AddsItsMassToLambdaInEachDirection) {
  const auto lambda = [](const std::vector<std::string>& more) {
    std::vector<std::string> words{"dynamics", "models/rr.urdf", "--q", "0.3,0.9", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult run = run_program(words);
    EXPECT_EQ(run.status, 0) << run.err;
    return parse_json(run.out)["Lambda"];
  };
  const Json without = lambda({}), with = lambda({"--set", "payload.mass=2.5"});
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(with[i][j].get<double>(), without[i][j].get<double>() + (i == j ? 2.5 : 0), 1e-13) << "rounding of numbers up to 10";
  EXPECT_EQ(lambda({"--set", "payload={mass: 2.5}"}), with);
  // A sweep of a model in a file.
  const TemporaryFolder folder;
  const std::string csv = folder.file("s/table.csv");
  const ProgramResult sweep = run_program({"sweep", "rr_free", "--set", "duration=0.2", "--over", "payload.mass=0:2:3", "-o", folder.file("s"), "--quiet"});
  ASSERT_EQ(sweep.status, 0) << sweep.err;
  // Where it is means nothing without a mass; one of zero, as in a sweep, has a place.
  for (const char* lone : {"payload.at=[0.1, 0, 0]", "payload.at.1=0.1", "payload.link=link1"})
    EXPECT_THAT(run_program({"check", "rr_free", "--set", lone}).err, testing::HasSubstr("give payload.mass")) << lone;
  EXPECT_EQ(run_program({"check", "rr_free", "--set", "payload={mass: 0, at: [0.1, 0, 0]}"}).status, 0);
  // A symbol of a link that carries it is not the link's alone.
  EXPECT_THAT(run_program({"equations", "models/rr.urdf", "--set", "payload.mass=3"}).out, testing::HasSubstr("mass of link2 with its payload"));
  EXPECT_THAT(run_program({"check", "rr_free", "--set", "payload.mass=-1"}).err, testing::HasSubstr("payload.mass"));
  EXPECT_THAT(run_program({"check", "rr_free", "--set", "payload.mass=1", "--set", "payload.link=elbow"}).err, testing::HasSubstr("'payload.link' names no link"));
}

}  // namespace
}  // namespace chainreel

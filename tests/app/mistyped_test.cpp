// Words that people mistype, and remedies that can be typed as they stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

int longest_line(const std::string& text) {
  std::size_t longest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return int(longest);
}

TEST(Mistyped, WordsAreAnsweredByTheNearestNames) {
  const std::string scene = "assets/scenes/rr_free.yaml";
  const std::vector<std::tuple<Words, int, std::string>> slips{
      {{"rendr", scene}, 2, "There is no command 'rendr': did you mean 'render'?"},
      {{"Render", scene}, 2, "did you mean 'render'?"},
      {{"render", scene, "--ouput", "a.mp4"}, 2, "did you mean '--output'?"},
      {{"render", scene, "--them=dark"}, 2, "did you mean '--theme'?"},
      {{"simulate", scene, "--set", "method=euler"}, 3, "did you mean 'explicit_euler', 'semi_implicit_euler' or 'symplectic_euler'?"},
      {{"simulate", scene, "--set", "method=RK4"}, 3, "did you mean 'rk4'?"},
      {{"simulate", scene, "--set", "method=semi-implicit-euler"}, 3, "did you mean 'semi_implicit_euler'?"},
      {{"simulate", scene, "--set", "draw=[chian]"}, 3, "did you mean 'chain'?"},
      {{"simulate", scene, "--set", "tau=[0, 0]"}, 3, "unknown key 'tau'"},
      {{"simulate", scene, "--set", "Duration=1"}, 3, "did you mean 'duration'?"},
      {{"simulate", scene, "--width", "640"}, 2, "scenes have the key 'video.width': --set video.width=VALUE"},
      {{"simulate", scene, "--set", "plot=[kinetic]"}, 3, "'kinetic' is a curve of the plot `energy`, which has all of them: plot: [energy]"},
      {{"render", "--nosuch"}, 2, "The following argument was not expected: --nosuch"},
      {{"render", "rr_fre"}, 3, "did you mean 'rr_free'?"},
      {{"snapshot", "rrr.urfd"}, 3, "did you mean 'rrr.urdf'?"},
      {{"snapshot", "models/rr.urdf", "--pose", "jiont2=30deg", "-o", "a.png"}, 2, "did you mean 'joint2'?"},
      {{"simulate", scene, "--set", "start.dq=[0, 0]"}, 3, "did you mean 'qd'?"},
      {{"ellipse", scene}, 2, "`--along "}};
  for (const auto& [words, status, text] : slips) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_LT(longest_line(result.err), 240) << "names are not listed by the dozen: " << result.err;
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
  }
}

TEST(Mistyped, KeyOfAComparisonIsToldOnce) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [1, 1]}\nstart: {q: [1]}\ncompare: [{step: 0.1}, {step: 0.2}, {step: 0.3}]\nmethod: rk4\n");
  const ProgramResult result = run_program({"check", scene});
  EXPECT_EQ(result.status, 3);
  const std::string what = "'start.q' has 1 numbers";
  const std::size_t first = result.err.find(what);
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find(what, first + 1), std::string::npos) << result.err;
}

TEST(Problems, AreElevenLinesAtMostAndAllCounted) {
  const TemporaryFolder folder;
  std::string keys = "model: {links: [1, 1]}\n", urdf = "<robot name='many'>";
  for (int i = 0; i < 50; ++i) keys += "colour" + std::to_string(i) + ": 1\n";
  for (int i = 0; i < 50; ++i) urdf += "\n<joint name='j" + std::to_string(i) + "' type='bent'/>";
  const ProgramResult scene = run_program({"check", folder.write("s.yaml", keys)});
  EXPECT_EQ(std::count(scene.err.begin(), scene.err.end(), '\n'), 11) << scene.err;
  EXPECT_THAT(scene.err, HasSubstr(".. and 40 more problems"));
  const std::string model = folder.write("m.urdf", urdf + "</robot>");
  const ProgramResult file = run_program({"dynamics", model});
  EXPECT_EQ(std::count(file.err.begin(), file.err.end(), '\n'), 11) << file.err;
}

TEST(SceneInACommandsPlace, MeansItsFilm) {
  const TemporaryFolder folder;
  const Words small{"-o", folder.file("a.gif"), "--quiet", "--set", "duration=0.1", "--set", "video.width=64", "--set", "video.height=36"};
  EXPECT_EQ(run_program(with({"assets/scenes/pp_free.yaml"}, small)).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.file("a.gif")));
  const ProgramResult absent = run_program({folder.file("absent.yaml")});
  EXPECT_EQ(absent.status, 3);
  EXPECT_THAT(absent.err, HasSubstr("there is no such file"));
}

TEST(SetMethod, LeavesOutWhatDoesNotGoWithIt) {
  const TemporaryFolder folder;
  const std::string fixed = folder.write("fixed.yaml", "model: {links: [1, 1]}\nmethod: rk4\nstep: 0.01\nduration: 0.1\n");
  const std::string chosen = folder.write("auto.yaml", "model: {links: [1, 1]}\naccuracy: 1 px\nduration: 0.1\n");
  const std::string adaptive = folder.write("adaptive.yaml", "model: {links: [1, 1]}\nmethod: taylor\norder: 20\ntolerance: 1e-6\nduration: 0.1\n");
  const auto simulate = [&](const std::string& scene, const Words& set) {
    Words words{"simulate", scene, "-o", folder.file("a.csv"), "--force"};
    for (const std::string& one : set) words = with(words, {"--set", one});
    return run_program(words);
  };
  const ProgramResult automatic = simulate(fixed, {"method=auto"});
  EXPECT_EQ(automatic.status, 0) << automatic.err;
  EXPECT_THAT(automatic.err, HasSubstr("'step' of the scene is left out"));
  EXPECT_EQ(simulate(chosen, {"method=rk4"}).status, 0);
  EXPECT_EQ(simulate(adaptive, {"method=rk4"}).status, 0);
  EXPECT_EQ(simulate(adaptive, {"method=dop853"}).status, 0);
  EXPECT_EQ(simulate(fixed, {"method=dop853", "tolerance=1e-6"}).status, 0);
  // What the command line says itself is never passed over, and a file that contradicts itself is refused.
  EXPECT_EQ(simulate(fixed, {"method=auto", "step=0.02"}).status, 3);
  EXPECT_EQ(simulate(fixed, {"method=rk4", "tolerance=1e-6"}).status, 3);
  EXPECT_EQ(simulate(fixed, {"tolerance=1e-6"}).status, 3);
  EXPECT_EQ(simulate(folder.write("wrong.yaml", "model: {links: [1, 1]}\nmethod: auto\nstep: 0.1\n"), {}).status, 3);
}

TEST(SetKey, WithoutAValueTakesItAway) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [1, 1]}\ntitle: a\nmethod: dop853\ntolerance: 1e-6\nduration: 0.1\ntorque: [1, 2]\n");
  const ProgramResult bare = run_program({"check", scene, "--json", "--set", "torque=", "--set", "tolerance=", "--set", "title="});
  ASSERT_EQ(bare.status, 0) << bare.err;
  EXPECT_THAT(bare.out, HasSubstr("torque: [0, 0]"));
  EXPECT_THAT(bare.out, HasSubstr("tolerance: 1e-09"));
  EXPECT_EQ(run_program({"check", scene, "--set", "model="}).status, 3);
  EXPECT_EQ(run_program({"check", scene, "--set", "torque.1="}).status, 2);
  const ProgramResult unknown = run_program({"check", scene, "--set", "durration="});
  EXPECT_EQ(unknown.status, 3);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'duration'?"));
}

// What stands between backquotes behind "chainreel" or "--set" is an order that the program takes.
TEST(Remedies, CanBeTypedAsTheyStand) {
  const TemporaryFolder folder;
  std::string urdf = "<robot name='two'><link name='base'/>";
  for (const std::string link : {"a", "b"})
    urdf += "<link name='" + link + "'><inertial><origin xyz='1 0 0'/><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
            "iyz='0'/></inertial></link><joint name='j" + link + "' type='continuous'><parent link='base'/><child link='" + link +
            "'/><axis xyz='0 0 1'/></joint>";
  const std::string model = folder.write("two.urdf", urdf + "</robot>");
  const std::string scene = folder.write("two.yaml", "model: two.urdf\nmethod: rk4\nduration: 0.05\nvideo: {width: 64, height: 36}\n");
  const std::vector<Words> commands{{"ellipse", model, "--pose", "0,0", "-o", folder.file("a.svg"), "--force"},
                                    {"ellipse", "--along", scene, "-o", folder.file("b.svg"), "--force"},
                                    {"snapshot", model, "-o", folder.file("c.svg"), "--force"},
                                    {"check", model},
                                    {"dynamics", model},
                                    {"render", scene, "-o", folder.file("d.gif"), "--force"},
                                    {"simulate", scene, "-o", folder.file("e.csv"), "--force"}};
  const std::string remedy = "`--set end_effector=NAME`";
  int told = 0;
  for (const Words& words : commands) {
    const ProgramResult without = run_program(words);
    if ((without.out + without.err).find(remedy) == std::string::npos) continue;
    ++told;
    const ProgramResult with_it = run_program(with(words, {"--set", "end_effector=a"}));
    EXPECT_EQ(with_it.status, 0) << words[0] << with_it.err;
    EXPECT_EQ((with_it.out + with_it.err).find(remedy), std::string::npos) << words[0];
  }
  EXPECT_GE(told, 5);
  for (const Words& words : std::vector<Words>{{"help"}, {"help", "scene"}, {"help", "layers"}, {"methods"}, {"init", folder.file("x")}})
    EXPECT_EQ(run_program(words).status, 0) << words[0];
}

// What a variable of the shell leaves that is not set.
TEST(EmptyWords, AreRefusedWithTheOption) {
  const TemporaryFolder folder;
  for (const Words& command : std::vector<Words>{{"dynamics", "models/rr.urdf", "--q", ""}, {"dynamics", "models/rr.urdf", "--gravity", ""}, {"render", "rr_free", "--frames", "", "-o", folder.file("a.mp4")},
                                                 {"render", "rr_free", "--shard", "", "-o", folder.file("a.mp4")}, {"simulate", "rr_free", "--every", "", "-o", folder.file("a.csv")},
                                                 {"fall", "humanoid_fall", "--sweep", ""}, {"snapshot", "models/rr.urdf", "--pose", "", "-o", folder.file("a.png")}}) {
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.status, 2) << command[2];
    EXPECT_THAT(result.err, testing::HasSubstr(command[2] + ": is empty")) << command[2];
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.mp4")));
}

}  // namespace
}  // namespace chainreel

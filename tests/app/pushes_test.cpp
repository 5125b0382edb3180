// Pushes as scenes write them, in all that a scene becomes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/csv.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kPushedScene =
    "title: Pushed\nmodel: {links: [1, 1], masses: [1, 1]}\ngravity: [0, 0, 0]\nstart: {q: [0, 1]}\nduration: 1\n"
    "push: {force: [3, 4], from: 0.2, until: 0.5s}\n";

class PushedScene : public testing::Test {
 protected:
  std::string scene(const std::string& more = "") const { return folder_.write("pushed.yaml", kPushedScene + more); }
  std::string trouble(const std::string& push) const {
    const ProgramResult result = run_program({"check", scene(), "--set", "push=" + push});
    EXPECT_EQ(result.status, 3) << push;
    return result.err;
  }
  TemporaryFolder folder_;
};

TEST_F(PushedScene, IsRefusedWithALineAndARemedyWhereItIsWrong) {
  EXPECT_THAT(trouble("{force: [1]}"), HasSubstr("takes three numbers"));
  EXPECT_THAT(trouble("{force: [1, 2, 3, 4]}"), HasSubstr("takes three numbers"));
  EXPECT_THAT(trouble("{frame: gripper}"), HasSubstr("needs `force`"));
  EXPECT_THAT(trouble("{force: [1, 2], from: -1}"), HasSubstr("0 s or later"));
  EXPECT_THAT(trouble("{force: [1, 2], from: 2, until: 1}"), HasSubstr("must come behind `from`"));
  EXPECT_THAT(trouble("{force: [1, .nan]}"), HasSubstr("force"));
  EXPECT_THAT(trouble("{force: [1, 2], frame: griper}"), AllOf(HasSubstr("names no link"), HasSubstr("did you mean 'gripper'?")));
  EXPECT_THAT(trouble("{force: [1, 2], at: 1}"), HasSubstr("unknown key"));
  EXPECT_THAT(trouble("[]"), HasSubstr("must be a push"));
  EXPECT_THAT(trouble("{force: [5deg, 0]}"), HasSubstr("N"));
  EXPECT_THAT(trouble("{force: [5 kg, 0]}"), HasSubstr("N"));
  EXPECT_THAT(trouble("5"), HasSubstr("must be a push"));
  EXPECT_EQ(run_program({"check", scene(), "--set", "push="}).status, 0);
  EXPECT_THAT(run_program({"check", scene(), "--set", "push=", "--set", "push.force.1=80"}).err, HasSubstr("there is no push whose force"));
  EXPECT_EQ(run_program({"check", scene(), "--set", "push.force.1=80"}).status, 0);
}

TEST_F(PushedScene, IsSaidWhereNothingComesOfIt) {
  const auto said = [&](const std::string& push) { return run_program({"check", scene(), "--set", "push=" + push}).err; };
  EXPECT_THAT(said("{force: [1, 2], from: 1}"), HasSubstr("where the run has ended"));
  EXPECT_THAT(said("{force: [1, 2], frame: base}"), HasSubstr("stands still whatever the chain does"));
  EXPECT_THAT(said("{force: [1, 2], frame: link1}"), HasSubstr("stands still whatever the chain does")) << "it turns about its origin";
  EXPECT_EQ(said("{force: [0, 0]}"), "") << "no push beside one: a row of a sweep, a panel of a comparison";
  EXPECT_THAT(said("{force: [1, 2, 3]}"), HasSubstr("3 N of its force are perpendicular"));
  EXPECT_THAT(said("{force: [1, 2, 0]}"), Not(HasSubstr("push")));
}

// M qdd + h = tau + tau_push at any instant of the run, and without one behind it.
TEST_F(PushedScene, IsInTheEquationOfMotion) {
  const std::string file = scene("torque: [1, \"-qd2\"]\n");
  for (const auto& [at, is_pushed] : {std::pair{"0.3", true}, {"0.7", false}}) {
    const Json now = Json::parse(run_program({"dynamics", file, "--at", at, "--json"}).out);
    ASSERT_EQ(now["tau_push"].size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      double left = now["h"][i];
      for (std::size_t j = 0; j < 2; ++j) left += now["M"][i][j].get<double>() * now["qdd"][j].get<double>();
      EXPECT_NEAR(left, now["tau"][i].get<double>() + now["tau_push"][i].get<double>(), 1e-12) << at;
      EXPECT_EQ(now["tau_push"][i] != 0.0, is_pushed) << at;
    }
    const Json lagrange = Json::parse(run_program({"dynamics", file, "--at", at, "--json", "--formulation", "lagrange"}).out);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(lagrange["qdd"][i].get<double>(), now["qdd"][i].get<double>(), 1e-9) << at;
  }
}

TEST_F(PushedScene, IsRememberedAndToldInWords) {
  const Words small{"--set", "video.width=160", "--set", "video.height=90"};
  ASSERT_EQ(run_program(with({"render", scene(), "-o", folder_.file("a.mp4"), "--quiet"}, small)).status, 0);
  EXPECT_THAT(read_whole_file(folder_.file("a.txt")), HasSubstr("pushed by 5 N at gripper from 0.2 s to 0.5 s"));
  const std::string again = folder_.file("again/pushed.yaml");
  ASSERT_EQ(run_program({"extract", folder_.file("a.mp4"), "-o", again}).status, 0);
  EXPECT_THAT(read_whole_file(again), HasSubstr("push: {force: [3, 4], from: 0.2, until: 0.5}"));
  ASSERT_EQ(run_program({"render", again, "-o", folder_.file("b.mp4"), "--quiet"}).status, 0);
  EXPECT_TRUE(read_whole_file(folder_.file("a.mp4")) == read_whole_file(folder_.file("b.mp4")));
}

TEST_F(PushedScene, WithAnotherPushIsAnotherPhysics) {
  const std::string suite = folder_.write("snapshots.yaml", "scene: pushed.yaml\nat: 0.4\nsize: 160x90\n");
  scene();
  ASSERT_EQ(run_program({"verify", suite, "--missing", "write"}).status, 0);
  EXPECT_EQ(run_program({"verify", suite}).status, 0);
  folder_.write("pushed.yaml", kPushedScene.substr(0, kPushedScene.find("push:")) + "push: {force: [3, 5], from: 0.2, until: 0.5s}\n");
  const ProgramResult result = run_program({"verify", suite});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("push.force.2 4 -> 5"));
}

TEST_F(PushedScene, IsOfRunsAlone) {
  const std::string log = folder_.write("log.csv", "t,q1,q2\n0,0,0\n0.5,0.1,0.2\n1,0.3,0.1\n");
  const ProgramResult replay = run_program({"check", scene("motion: log.csv\n"), "--set", "start="});
  EXPECT_EQ(replay.status, 3);
  EXPECT_THAT(replay.err, HasSubstr("push"));
  const ProgramResult inverse = run_program({"inverse", scene(), "--trajectory", log, "-o", folder_.file("tau.csv")});
  EXPECT_EQ(inverse.status, 3);
  EXPECT_THAT(inverse.err, HasSubstr("--set push="));
  EXPECT_EQ(run_program({"inverse", scene(), "--set", "push=", "--trajectory", log, "-o", folder_.file("tau.csv")}).status, 0) << "the remedy works";
}

// A parameter gives it, so that a title and a sweep follow.
TEST(PushOfAParameter, IsWhatTheNumberIs) {
  const TemporaryFolder folder;
  const std::string body = "model: {links: [0.5, 0.5], masses: [1, 1]}\nduration: 0.5\nmethod: rk4\nstep: 1ms\n";
  const std::string named = folder.write("f.yaml", body + "title: \"pushed with {F} N\"\nparameters: {F: 30}\npush: {force: [F, -F / 3], from: 0.1, until: 0.2s}\n");
  const std::string plain = folder.write("p.yaml", body + "push: {force: [30, -10], from: 0.1, until: 0.2s}\n");
  const auto rows = [&](const Words& more) {
    Words words{"simulate", more[0], "--quiet", "--force", "-o", folder.file("t.csv")};
    words.insert(words.end(), more.begin() + 1, more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(folder.file("t.csv"));
  };
  EXPECT_EQ(rows({named}), rows({plain}));
  EXPECT_EQ(rows({named, "--set", "parameters.F=12"}), rows({plain, "--set", "push.force=[12, -4]"}));
  EXPECT_NE(rows({named}), rows({named, "--set", "parameters.F=12"}));
  // The effective scene keeps the name, so that what comes of it follows, too.
  ASSERT_EQ(run_program({"snapshot", named, "--at", "0.15", "-o", folder.file("s.png"), "--quiet"}).status, 0);
  ASSERT_EQ(run_program({"extract", folder.file("s.png"), "-o", folder.file("again.yaml")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("again.yaml")), HasSubstr("force: [F, -F / 3]"));
  EXPECT_EQ(run_program({"sweep", named, "--over", "parameters.F=0:30:3", "-o", folder.file("w.csv")}).status, 0);
  EXPECT_EQ(rows({named, "--set", "parameters={k: 12, m: 18}", "--set", "push.force=[k + m, -10]"}), rows({plain})) << "m is a name here, and no unit";
  for (const char* bad : {"push.force=['', 4]", "push.force=[5deg, 0]", "push.force=[1 kg, 0]"}) EXPECT_EQ(run_program({"check", named, "--set", bad}).status, 3) << bad;
  const ProgramResult wrong = run_program({"check", named, "--set", "push.force=[G, 0]"});
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.err, testing::AllOf(HasSubstr("'push.force.1'"), HasSubstr("'G'"), HasSubstr("parameters")));
}

TEST_F(PushedScene, IsSweptByItsNumbers) {
  ASSERT_EQ(run_program({"sweep", scene(), "--over", "push.force.1=0,3,-3", "--set", "push.force.2=0", "-o", folder_.file("a.json")}).status, 0);
  const Json table = Json::parse(read_whole_file(folder_.file("a.json")));
  EXPECT_EQ(table["qd1"][0], 0.0) << "nothing moves";
  EXPECT_GT(std::abs(table["qd1"][1].get<double>()), 0.1);
}

// What holds the joints beside a push stands on the page: M qdd + h = tau + J^T F.
TEST_F(PushedScene, StandsInTheEquationOnThePage) {
  const auto page = [&](const Words& more) {
    const std::string file = folder_.file("page.svg");
    const ProgramResult result = run_program(with({"snapshot", scene(), "--at", "0.3", "--set", "draw=[+equation]", "--force", "-o", file}, more));
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(file);
  };
  EXPECT_NE(page({}), page({"--set", "push="}));
}

// A contact force is what the constraint bears, pushes or none: its control knows of them.
TEST_F(PushedScene, ChangesNoContactForce) {
  const std::string file = folder_.write(
      "pressed.yaml", "model: {links: [0.5, 0.4, 0.3], masses: [2, 1.5, 1], damping: 0.3}\nstart: {q: [1.1889, -0.526846, -1.47727]}\n"
                      "torque: {gravity_compensation: true, plus: [1, -qd2, 0]}\npush: [{frame: link2, force: [20, 0], from: 0.1, until: 0.3}]\n"
                      "constraints: [{line: {frame: gripper, point: [0, 0.35], direction: [1, 0.2]}}]\ncontact_force: {constraint: 1, force: [0, -8]}\n"
                      "duration: 0.4\n");
  ASSERT_EQ(run_program({"simulate", file, "--columns", "t,lambda", "-o", folder_.file("l.csv")}).status, 0);
  const Table table = read_csv(folder_.file("l.csv"));
  ASSERT_GT(table.rows(), 20u);
  // 8 N down on a line whose normal is (-1, 5) / sqrt(26). Rounding of some 10 N, through the solution for the multipliers.
  for (const double lambda : table.columns[1]) EXPECT_NEAR(lambda, -8 * 5 / std::sqrt(26), 1e-9);
}

// Two numbers are those of the plane in which the chain moves, wherever that lies.
TEST_F(PushedScene, OfTwoNumbersLiesInThePlaneOfMotion) {
  const std::string plane = folder_.write("xz.yaml", "model: {links: [1, 1], masses: 1, joints: RyRy}\ngravity: [0, 0, 0]\nduration: 0.5\nstart: {q: [0, 1]}\n");
  const auto end_of = [&](const std::string& force) {
    const std::string file = folder_.file("end.csv");
    EXPECT_EQ(run_program({"simulate", plane, "--set", "push={force: " + force + "}", "-o", file, "--force", "--quiet"}).status, 0);
    const std::string text = read_whole_file(file);
    return text.substr(text.rfind("0.5,"));
  };
  EXPECT_EQ(end_of("[3, 20]"), end_of("[3, 0, 20]"));
  EXPECT_NE(end_of("[3, 20]"), end_of("[3, 20, 0]"));
  const ProgramResult in_space = run_program({"check", "assets/scenes/arm_ellipsoid.yaml", "--set", "push={force: [1, 2]}"});
  EXPECT_EQ(in_space.status, 3);
  EXPECT_THAT(in_space.err, HasSubstr("takes three numbers of force"));
}

// What a table tells of an instant at which something jumps is what comes then, of all its numbers.
TEST_F(PushedScene, HasItsMultipliersAtItsBeginning) {
  const std::string file = folder_.write("tied.yaml",
                                         "model: {links: [1, 1], masses: 1}\nstart: {q: [60deg, -120deg]}\nduration: 1\nmethod: rk4\nstep: 0.01\n"
                                         "constraints: [{line: {frame: gripper, point: [0, 0], direction: [1, 0]}}]\n"
                                         "push: {force: [0, 10], from: 0.5, until: 0.75}\nvideo: {fps: 20}\n");
  const std::string table = folder_.file("a.json");
  ASSERT_EQ(run_program({"simulate", file, "--columns", "t,lambda", "-o", table}).status, 0);
  const Json rows = Json::parse(read_whole_file(table));
  for (const std::size_t k : {9, 10, 14, 15}) {
    const std::string at = std::to_string(rows["t"][k].get<double>());
    const Json now = Json::parse(run_program({"dynamics", file, "--at", at, "--json"}).out);
    EXPECT_NEAR(rows["lambda"][k][0].get<double>(), now["lambda"][0].get<double>(), 1e-9) << at;
  }
  EXPECT_NEAR(rows["lambda"][10][0].get<double>() - rows["lambda"][9][0].get<double>(), 10, 2) << "the line bears it at once";
}

TEST_F(PushedScene, IsNoSeriesAndNamesPanelsWithoutBraces) {
  EXPECT_THAT(run_program({"check", scene("method: taylor\n")}).err, HasSubstr("because something pushes it from outside"));
  const std::string file = folder_.write("two.yaml", "model: {links: [1, 1], masses: 1}\nduration: 0.2\ncompare:\n  - push: {force: [3, 4]}\n  - push: {force: [3, 9], frame: link2}\n");
  const ProgramResult result = run_program({"check", file});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, Not(HasSubstr("stays as it is")));
}

// A row that came to its end and is no motion all the same.
TEST_F(PushedScene, ThatExplodesIsADoubtfulRow) {
  const ProgramResult result = run_program({"sweep", "assets/scenes/rr_free.yaml", "--over", "step=0.0001,0.02", "--set", "method=explicit_euler", "--set",
                                            "duration=2", "-o", folder_.file("a.csv")});
  EXPECT_EQ(result.status, 0) << "it is no failure";
  EXPECT_THAT(result.err, HasSubstr("1 row is doubtful"));
  EXPECT_THAT(read_whole_file(folder_.file("a.csv")), HasSubstr("\"doubtful: the energy is off by "));
}

}  // namespace
}  // namespace chainreel

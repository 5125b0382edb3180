// What the audit has against a run is said aloud, whatever else is quiet.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"


namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kRoot = CHAINREEL_SOURCE_FOLDER;

std::string coarse(const std::string& more) {
  return "model: " + kRoot + "/models/rr.urdf\nduration: 3\ntorque: [0, 0]\n" + more;
}

TEST(Warnings, AreSaidOfEnergyThatTheMethodMadeAndChangeNoExitCode) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("coarse.yaml", coarse("method: explicit_euler\nstep: 0.02\n"));
  const ProgramResult run =
      run_program({"simulate", scene, "-o", folder.file("a.csv"), "--quiet", "--json"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("WARNING: coarse: the energy is off by"));
  EXPECT_THAT(run.err, HasSubstr("--set step="));
  const Json report = Json::parse(run.out);
  ASSERT_EQ(report["warnings"].size(), 1u);
  EXPECT_EQ(report["warnings"][0]["kind"], "energy");
  EXPECT_NEAR(report["warnings"][0]["amount"].get<double>(),
              report["energy_error"].get<double>() / report["energy_moved"].get<double>(), 1e-12);
  const ProgramResult picture = run_program({"snapshot", scene, "-o", folder.file("a.png"), "--at", "2", "--quiet"});
  EXPECT_EQ(picture.status, 0) << picture.err;
  EXPECT_THAT(picture.err, HasSubstr("WARNING: coarse: the energy is off by"));
}

// Numbers of one instant and poses along a motion are as far off as the run that they are of, until there.
TEST(Warnings, AreSaidOfInstantsAndPosesOfARun) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("coarse.yaml", coarse("method: explicit_euler\nstep: 0.02\n"));
  const auto said = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--warnings", "fail", "--quiet"});
    const ProgramResult run = run_program(words);
    EXPECT_EQ(run.status, run.err.find("the energy is off by") == std::string::npos ? 0 : 1) << run.err;
    return run.status;
  };
  EXPECT_EQ(said({"dynamics", scene, "--at", "2"}), 1);
  EXPECT_EQ(said({"dynamics", scene, "--at", "0"}), 0) << "nothing has moved";
  EXPECT_EQ(said({"ellipse", "--along", scene, "-o", folder.file("a.png")}), 1);
  EXPECT_EQ(said({"dynamics", scene, "--at", "2", "--set", "acknowledge=[energy]"}), 0);
}

TEST(Warnings, HaveARemedyThatCanBeTyped) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("coarse.yaml", coarse("method: explicit_euler\nstep: 0.02\n"));
  const ProgramResult better = run_program({"simulate", scene, "-o", folder.file("a.csv"), "--set", "method=auto", "--set",
                                            "step=null", "--set", "tolerance=null"});
  EXPECT_EQ(better.status, 0) << better.err;
  EXPECT_THAT(better.err, Not(HasSubstr("WARNING")));
}

// Words of a remedy up to its ", or", as a shell takes them.
Words typed(const std::string& remedy) {
  Words words;
  std::string word;
  char quote = 0;
  for (const char c : remedy.substr(0, remedy.find(", or")) + " ") {
    if (c == '\'') {
      quote = quote ? 0 : c;
    } else if (c == ' ' && !quote) {
      if (!word.empty()) words.push_back(std::exchange(word, ""));
    } else {
      word += c;
    }
  }
  return words;
}

TEST(Warnings, OfAPanelAdviseWhatChangesThatPanel) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("two.yaml", coarse("compare:\n  - {title: A, method: dop853, tolerance: 1e-9}\n  - {title: B, method: explicit_euler, step: 0.02}\n"));
  const Words command{"snapshot", scene, "--at", "2", "-o", folder.file("a.png"), "--json", "--force"};
  const ProgramResult run = run_program(command);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("--set compare.2.step="));
  EXPECT_THAT(run.err, HasSubstr("--set compare.2.method=auto --set compare.2.step=null"));
  const ProgramResult better = run_program(with(command, {"--set", "compare.2.method=auto", "--set", "compare.2.step=null", "--set", "compare.2.tolerance=null"}));
  EXPECT_EQ(better.status, 0) << better.err;
  EXPECT_THAT(better.err, Not(HasSubstr("WARNING")));
  EXPECT_THAT(run_program({"simulate", scene, "--panel", "2", "-o", folder.file("a.csv")}).err, HasSubstr("--set compare.2.step="));
}

TEST(Warnings, UnderAutoAdviseWhatHelpsThere) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("far.yaml", coarse("accuracy: 500 px\n"));
  const Words command{"simulate", scene, "-o", folder.file("a.csv"), "--json", "--force"};
  const ProgramResult run = run_program(command);
  ASSERT_EQ(run.status, 0) << run.err;
  const Json report = Json::parse(run.out);
  ASSERT_FALSE(report["warnings"].empty()) << run.out;
  for (const Json& warning : report["warnings"]) {
    const std::string remedy = warning["remedy"];
    const std::size_t other = remedy.find(", or ");
    ASSERT_NE(other, std::string::npos) << remedy;
    for (const std::string& one : {remedy, remedy.substr(other + 5)}) {
      const ProgramResult better = run_program(with(command, typed(one)));
      EXPECT_EQ(better.status, 0) << better.err;
      const Json finer = Json::parse(better.out);
      EXPECT_LT(finer["energy_error"].get<double>(), 0.1 * report["energy_error"].get<double>()) << one;
    }
  }
}

// The shape is what counts, not the frame in it.
TEST(Automatic, JudgesWheelsAsTheyAreDrawn) {
  const TemporaryFolder folder;
  const std::string inertial = "<inertial><mass value='0.5'/><inertia ixx='1e-6' iyy='1e-6' izz='2e-6' ixy='0' ixz='0' "
                               "iyz='0'/></inertial>";
  const std::string model = folder.write(
      "wheel.urdf", "<robot name='w'><link name='base'/><link name='wheel'>" + inertial +
                        "<visual><geometry><box size='0.8 0.6 0.02'/></geometry></visual></link><joint name='hub' "
                        "type='continuous'><parent link='base'/><child link='wheel'/><axis xyz='0 0 1'/></joint></robot>");
  const std::string scene =
      folder.write("wheel.yaml", "model: " + model + "\ngravity: [0, 0, 0]\nduration: 2\ntorque: ['1e-5*cos(9*t)']\n");
  const auto q_of = [&](const Words& more) {
    const ProgramResult run = run_program(with({"simulate", scene, "-o", folder.file("q.csv"), "--json", "--force"}, more));
    EXPECT_EQ(run.status, 0) << run.err;
    std::ifstream file(folder.file("q.csv"));
    std::vector<double> q;
    std::string line;
    for (std::getline(file, line); std::getline(file, line);) q.push_back(std::stod(line.substr(line.find(',') + 1)));
    return q;
  };
  const std::vector<double> chosen = q_of({}), exact = q_of({"--set", "method=dop853", "--set", "tolerance=1e-13"});
  ASSERT_EQ(chosen.size(), exact.size());
  double error = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) error = std::max(error, std::abs(chosen[k] - exact[k]));
  // 0.1 px of a picture that is at most 1 m high; its corners are 0.5 m away.
  EXPECT_LT(error, 0.1 * 1.12 / 1080 / 0.5);
  EXPECT_GT(error, 0);
}

TEST(Warnings, AreNoneWhereARunIsToDivergeOrIsSound) {
  const TemporaryFolder folder;
  for (const char* more : {"method: explicit_euler\nstep: 0.02\nexpect: diverge\n", "method: rk4\nstep: 0.002\n"}) {
    const std::string scene = folder.write("scene.yaml", coarse(more));
    const std::string torque = std::string(more).find("diverge") != std::string::npos ? "-500*qd1" : "0";
    const ProgramResult run =
        run_program({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--set", "torque.1=" + torque});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("WARNING"))) << more;
  }
}

TEST(Check, SaysThatFrictionLetsCreep) {
  const TemporaryFolder folder;
  const std::string model = folder.write("slider.urdf",
                                         "<robot name='slider'><link name='base'/><link name='cart'><inertial><mass "
                                         "value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
                                         "</link><joint name='rail' type='prismatic'><parent link='base'/><child "
                                         "link='cart'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='9' "
                                         "velocity='9'/><dynamics friction='2'/></joint></robot>");
  const ProgramResult check = run_program({"check", model});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("F tanh(qd / 0.01)"));
  EXPECT_THAT(check.out, HasSubstr("0.0097 rad/s or m/s"));
  // And so it does: 1.5 N against 2 N.
  const ProgramResult run = run_program({"simulate", folder.write("push.yaml", "model: slider.urdf\ntorque: [1.5]\nduration: 1\n"
                                                                             "method: radau5\ntolerance: 1e-9\n"),
                                         "-o", "-", "--columns", "t,q,qd"});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string last = run.out.substr(run.out.find_last_of(',') + 1);
  EXPECT_NEAR(std::stod(last), 0.00973, 1e-5) << run.out;
  const ProgramResult plain = run_program({"check", kRoot + "/models/rr.urdf"});
  EXPECT_THAT(plain.out, Not(HasSubstr("friction")));
}

// A pen at the end of its reach: the only pose there, where no step of a tolerance leads on.
TEST(Headway, OfARunThatMakesNoneIsAnErrorThatNamesThePose) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("stretched.yaml",
                                         "model: {links: [0.6, 0.5], masses: [2, 1]}\nstart: {q: [90deg, 0]}\n"
                                         "constraints: [{line: {frame: gripper, point: [0, 1.1], direction: [1, 0]}}]\nduration: 3\n");
  const ProgramResult result = run_program({"simulate", scene, "--set", "method=dop853", "--set", "torque=[1, 0]", "-o", folder.file("a.csv")},
                                           {.folder = "", .environment = {}, .timeout_s = 60});
  EXPECT_EQ(result.status, 5) << result.err;
  EXPECT_FALSE(result.timed_out);
  EXPECT_THAT(result.err, HasSubstr("the constraints are singular near this pose"));
  // Many short steps of a run that goes on are none: 400,000 of them.
  EXPECT_EQ(run_program({"simulate", "rr_free", "--set", "method=dop853", "--set", "step=null", "--set", "tolerance=1e-9", "--set", "duration=8000",
                         "--set", "video.fps=1", "--quiet", "-o", folder.file("b.csv")})
                .status,
            0);
}

// What a scene is about need not be said of it; the report keeps it, and all else is said.
TEST(Warnings, ThatAreAcknowledgedStandInReportsAlone) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nduration: 2\nmethod: explicit_euler\nstep: 0.02\n");
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"simulate", scene, "-o", folder.file("a.csv"), "--force", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  const ProgramResult loud = run({}), known = run({"--set", "acknowledge=[energy]"}), other = run({"--set", "acknowledge=[rest]"});
  EXPECT_THAT(loud.err, HasSubstr("the energy is off"));
  EXPECT_EQ(known.err.find("the energy is off"), std::string::npos) << known.err;
  EXPECT_THAT(other.err, HasSubstr("the energy is off"));
  EXPECT_EQ(Json::parse(known.out)["warnings"], Json::parse(loud.out)["warnings"]);
  const ProgramResult wrong = run({"--set", "acknowledge=[enrgy]"});
  EXPECT_EQ(wrong.status, 3) << wrong.err;
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'energy'"));
}

}  // namespace
}  // namespace chainreel

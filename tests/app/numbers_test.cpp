// `simulate` and `dynamics`: numbers that other programs read.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "core/format.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(SimulateCommand, WritesARowAFrameAndOneAtTheEnd) {
  const ProgramResult result = run_program({"simulate", "assets/scenes/pp_free.yaml", "-o", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::vector<std::string> lines = lines_of(result.out);
  ASSERT_EQ(lines.size(), 1u + 120 + 1);
  EXPECT_EQ(lines[0],
            "t [s],q1 [m],q2 [m],qd1 [m/s],qd2 [m/s],tau1 [N],tau2 [N],kinetic [J],potential [J],energy [J],"
            "x_G [m],y_G [m],xd_G [m/s],yd_G [m/s]");
  EXPECT_THAT(lines[1], testing::StartsWith("0,0,0,1.5,"));
  EXPECT_THAT(lines.back(), testing::StartsWith("2,"));
  // 17 significant digits: the frame at 1/60 s.
  EXPECT_THAT(lines[2], testing::StartsWith("0.016666666666666666,"));
}

// A torque that is known: 2 t exp(-4 t) is highest at 0.25 s, 0.5 / e, and sin(t - 2) lowest at 2 - pi / 2, -1.
TEST(SimulateCommand, TellsPeaksAndWhenTheyAre) {
  const TemporaryFolder folder;
  const Words words{"simulate", "assets/scenes/pp_free.yaml", "-o", folder.file("a.csv"), "--set", "torque=[2 * t * exp(-4 * t), sin(t - 2)]", "--set",
                    "duration=1.5", "--peaks", "tau,qd", "--force"};
  const Json peaks = Json::parse(run_program(with(words, {"--json"})).out)["peaks"];
  ASSERT_EQ(peaks.size(), 4u);
  EXPECT_EQ(peaks[0]["name"], "tau1");
  EXPECT_EQ(peaks[0]["unit"], "N");
  // Samples of 30 us about it: the instant to one of them, the value to its square.
  EXPECT_NEAR(peaks[0]["t"].get<double>(), 0.25, 5e-5);
  EXPECT_NEAR(peaks[0]["value"].get<double>(), 0.5 / std::exp(1), 1e-9);
  EXPECT_NEAR(peaks[1]["t"].get<double>(), 2 - std::acos(0.0), 5e-5);
  EXPECT_NEAR(peaks[1]["value"].get<double>(), -1, 1e-9);
  EXPECT_EQ(peaks[2]["name"], "qd1");
  EXPECT_EQ(peaks[2]["unit"], "m/s");
  EXPECT_THAT(run_program(words).out, AllOf(HasSubstr("peak of"), HasSubstr("0.18394"), HasSubstr("a.csv  91 rows")));
  // None that was not asked for; standard output has room for one of the two; of t there is none.
  EXPECT_EQ(Json::parse(run_program({"simulate", "assets/scenes/pp_free.yaml", "-o", folder.file("b.csv"), "--json"}).out)["peaks"], Json::array());
  EXPECT_EQ(run_program({"simulate", "assets/scenes/pp_free.yaml", "-o", "-", "--peaks", "qd"}).status, 2);
  EXPECT_EQ(run_program({"simulate", "assets/scenes/pp_free.yaml", "-o", folder.file("c.csv"), "--peaks", "t"}).status, 2);
  EXPECT_EQ(run_program({"simulate", "assets/scenes/pp_free.yaml", "-o", folder.file("c.csv"), "--peaks", "lambda"}).status, 2);
}

// Found in two ways: by `--peaks`, and by the audit at all steps.
TEST(SimulateCommand, HasThePeakOfAMultiplierThatTheAuditHas) {
  const TemporaryFolder folder;
  const Json json = Json::parse(
      run_program({"simulate", "assets/scenes/four_bar.yaml", "-o", folder.file("a.csv"), "--peaks", "lambda", "--json", "--quiet"}).out);
  const Json& largest = json["constraint_error"]["rows"][0];
  const double expected = largest["largest_lambda_signed"];
  EXPECT_NEAR(json["peaks"][0]["value"].get<double>(), expected, 1e-5 * std::abs(expected));
  EXPECT_NEAR(json["peaks"][0]["t"].get<double>(), largest["largest_lambda_time"].get<double>(), 1e-3);
}

// Forces may be no numbers behind the end: a first step that is tried out looks no farther, wherever the run begins.
// A pulse of torque between all stages of the steps is found by its peak, and is beyond the limit all the same.
TEST(SimulateCommand, HoldsPeaksAgainstLimits) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5], masses: [1], efforts: 10}\ntorque: ['12 * exp(-((t - 0.53) / 0.003)^2)']\nduration: 2\nexpect: within_limits\nmethod: rk4\nstep: 0.1\n");
  const ProgramResult found = run_program({"simulate", scene, "--peaks", "tau", "-o", folder.file("a.csv")});
  EXPECT_EQ(found.status, 7);
  EXPECT_THAT(found.err, HasSubstr("joint 'joint1' passed its effort limit 10 with 12 at t = 0.53 s"));
  EXPECT_EQ(run_program({"sweep", scene, "--over", "duration=1,2", "--peaks", "tau", "-o", folder.file("s.csv")}).status, 7);
  EXPECT_EQ(run_program({"simulate", scene, "--set", "torque=['9.9 * exp(-((t - 0.53) / 0.003)^2)']", "--peaks", "tau", "-o", folder.file("b.csv")}).status, 0) << "negative control";
}

// CI asks for the numbers of the run that fails, too.
TEST(SimulateCommand, TellsItsReportOfARunThatShouldHaveEndedOtherwise) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5, 0.5], masses: [1, 1], efforts: [1, 1]}\nstart: {q: [0, 0]}\ntorque: [3, 2]\nduration: 1\nexpect: within_limits\n"
                                                   "method: rk4\nstep: 1ms\n");
  const ProgramResult limit = run_program({"simulate", scene, "--peaks", "tau", "--json", "-o", folder.file("a.csv")});
  EXPECT_EQ(limit.status, 7);
  const Json json = Json::parse(limit.out);
  EXPECT_EQ(json["limits_passed"].size(), 2u);
  EXPECT_EQ(json["peaks"].size(), 2u);
  EXPECT_THAT(limit.err, testing::AllOf(testing::HasSubstr("joint1"), testing::HasSubstr("joint2"))) << "all that are passed";
  EXPECT_FALSE(read_whole_file(folder.file("a.csv")).empty());
  const ProgramResult lost = run_program({"simulate", scene, "--set", "expect=finish", "--set", "torque=[1e6 * q1, 1e6 * q2 + 1]", "--peaks", "tau", "--json", "-o", folder.file("b.csv")});
  EXPECT_EQ(lost.status, 5);
  const Json diverged = Json::parse(lost.out);
  EXPECT_EQ(diverged["status"], "diverged");
  EXPECT_FALSE(diverged["trouble"].is_null());
  EXPECT_EQ(diverged["peaks"].size(), 0u) << "what it grows to is no peak";
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.csv.json"))) << "no record of a table that is a part";
  EXPECT_EQ(run_program({"sweep", scene, "--over", "duration=0.1,0.2", "-o", folder.file("s.csv")}).status, 7);
}

TEST(SimulateCommand, AsksForNoTorqueBehindTheEnd) {
  const TemporaryFolder folder;
  for (const char* method : {"dop853", "radau5", "auto"})
    for (const char* start : {"0", "1", "1000"}) {
      const std::string scene = folder.write("a.yaml", std::string("model: {links: [1], masses: 1, joints: P, shape: point}\ngravity: [0, 0, 0]\n"
                                                                   "torque: [\"1e-9*exp(20*t)\"]\nduration: 1\nstart: {q: [") + start + "]}\nmethod: " + method + "\n");
      const ProgramResult result = run_program({"simulate", scene, "--quiet", "--force", "-o", folder.file("a.csv")});
      EXPECT_EQ(result.status, 0) << method << " from " << start << ": " << result.err;
    }
}

TEST(SimulateCommand, WritesARowAStepWhereAsked) {
  const TemporaryFolder folder;
  const std::string file = folder.file("steps.csv");
  ASSERT_EQ(run_program({"simulate", "assets/scenes/rrr_torque.yaml", "--every-step", "-o", file, "--set",
                         "duration=0.25", "--set", "method=semi_implicit_euler", "--set", "step=1ms"})
                .status,
            0);
  const std::vector<std::string> lines = lines_of(read_whole_file(file));
  EXPECT_EQ(lines.size(), 1u + 251);
  EXPECT_THAT(lines[0], testing::StartsWith("t [s],q1 [rad],q2 [rad],q3 [rad],qd1 [rad/s],qd2 [rad/s],qd3 [rad/s],tau1"));
}

Json dynamics(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "dynamics");
  arguments.push_back("--json");
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return Json::parse(result.out);
}

// A sharp peak of the multiplier between two frames, told by a run at 20 kHz: whatever the frames and the method, to 0.02 %.
TEST(SimulateCommand, FindsTheLargestMultiplierWhereverTheFramesAre) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("held.yaml",
                                         "model: {links: [0.6, 0.6], masses: [2, 1], joints: RR}\nstart: {q: [2.1654, -2.16044]}\n"
                                         "constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n"
                                         "torque: [\"6 * sin(2 * t) - 1 * qd1\", \"-1 * qd2\"]\nduration: 0.6\n");
  const auto largest = [&](const Words& more) {
    const ProgramResult run = run_program(with({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--json", "--quiet"}, more));
    EXPECT_EQ(run.status, 0) << run.err;
    return Json::parse(run.out)["constraint_error"]["rows"][0];
  };
  const Json dense = largest({"--set", "method=dop853", "--set", "tolerance=1e-12", "--set", "video.fps=20000"});
  const double truth = dense["largest_lambda"];
  EXPECT_NEAR(truth, 121.18, 0.01) << "RK4 of another's at 2e-5 s";
  for (const Words& more : {Words{}, {"--set", "video.fps=10"}, {"--set", "method=rk4", "--set", "step=0.001"}, {"--set", "method=rk4", "--set", "step=2e-5"}, {"--set", "method=dop853", "--set", "tolerance=1e-10"}}) {
    const Json found = largest(more);
    EXPECT_NEAR(found["largest_lambda"].get<double>(), truth, 2e-4 * truth) << joined(more, " ");
    EXPECT_NEAR(found["largest_lambda_time"].get<double>(), 0.45706, 3e-4) << joined(more, " ");
  }
}

TEST(DynamicsCommand, GivesTheClosedFormOfRr) {
  // Modern Robotics 8.9 at q = (0.3, 0.7), qd = (0.5, -1), tau = (1, 2), unit links and masses.
  const double q1 = 0.3, q2 = 0.7, w1 = 0.5, w2 = -1, g = 9.81;
  const Json json = dynamics({"models/rr.urdf", "--q", "0.3,0.7", "--qd", "0.5,-1", "--tau", "1,2"});
  const double m11 = 3 + 2 * std::cos(q2), m12 = 1 + std::cos(q2), m22 = 1;
  const double c1 = -std::sin(q2) * (2 * w1 * w2 + w2 * w2), c2 = std::sin(q2) * w1 * w1;
  const double g1 = 2 * g * std::cos(q1) + g * std::cos(q1 + q2), g2 = g * std::cos(q1 + q2);
  const double det = m11 * m22 - m12 * m12, r1 = 1 - c1 - g1, r2 = 2 - c2 - g2;
  const double kTolerance = 1e-13;  // some ten roundings of numbers up to 40
  EXPECT_NEAR(json["M"][0][0].get<double>(), m11, kTolerance);
  EXPECT_NEAR(json["M"][0][1].get<double>(), m12, kTolerance);
  EXPECT_NEAR(json["M"][1][1].get<double>(), m22, kTolerance);
  EXPECT_NEAR(json["nle"][0].get<double>(), c1 + g1, kTolerance);
  EXPECT_NEAR(json["nle"][1].get<double>(), c2 + g2, kTolerance);
  EXPECT_NEAR(json["tau_g"][0].get<double>(), g1, kTolerance);
  EXPECT_NEAR(json["qdd"][0].get<double>(), (m22 * r1 - m12 * r2) / det, kTolerance);
  EXPECT_NEAR(json["qdd"][1].get<double>(), (m11 * r2 - m12 * r1) / det, kTolerance);
  EXPECT_NEAR(json["x"][0].get<double>(), std::cos(q1) + std::cos(q1 + q2), kTolerance);
  EXPECT_NEAR(json["J"][1][1].get<double>(), std::cos(q1 + q2), kTolerance);
  EXPECT_NEAR(json["potential"].get<double>(), g * (2 * std::sin(q1) + std::sin(q1 + q2)), kTolerance);
  EXPECT_NEAR(json["kinetic"].get<double>(), (m11 * w1 * w1 + 2 * m12 * w1 * w2 + m22 * w2 * w2) / 2,
              kTolerance);
  EXPECT_GT(std::abs(json["qdd"][0].get<double>() - (m22 * r1 + m12 * r2) / det),
            0.1);  // negative control: a sign
}

TEST(DynamicsCommand, GivesTheSameByLagrangeAndByNewtonAndEuler) {
  const std::vector<std::string> state{"models/rrr.urdf", "--q",   "0.3,0.7,-1", "--qd",
                                       "0.5,-1,2",        "--tau", "1,2,3"};
  std::vector<std::string> by_lagrange = state;
  by_lagrange.insert(by_lagrange.end(), {"--formulation", "lagrange"});
  const Json one = dynamics(state), other = dynamics(by_lagrange);
  EXPECT_EQ(other["formulation"], "lagrange");
  for (const char* key : {"nle", "tau_g", "qdd"})
    for (std::size_t i = 0; i < 3; ++i) {
      // Two algorithms on numbers up to 50, some thirty roundings each.
      EXPECT_NEAR(one[key][i].get<double>(), other[key][i].get<double>(), 1e-11) << key;
      EXPECT_NEAR(one["C_qd"][i].get<double>() + one["tau_g"][i].get<double>(), one["nle"][i].get<double>(),
                  1e-11);
    }
  ASSERT_EQ(one["bodies"].size(), 3u);
  double kinetic = 0;
  for (const Json& body : one["bodies"]) kinetic += body["kinetic"].get<double>();
  EXPECT_NEAR(kinetic, one["kinetic"].get<double>(), 1e-12);
}

// A joint held at 90 degrees to gravity needs m g l / 2; what was recorded is asked for its limits, too.
TEST(InverseCommand, TellsLimitsThatAMotionPasses) {
  const TemporaryFolder folder;
  folder.write("log.csv", "t,q1\n0,0\n0.1,0\n0.2,0\n0.3,0\n");
  const auto asked = [&](const char* effort) {
    const std::string scene = folder.write("log.yaml", std::string("model: {links: [1], masses: [2], efforts: ") + effort + "}\nmotion: log.csv\nexpect: within_limits\n");
    return run_program({"inverse", scene, "--json", "--force", "-o", folder.file("tau.csv")});
  };
  const double needed = 2 * 9.81 / 2;
  const ProgramResult passed = asked("9.8");
  EXPECT_EQ(passed.status, 7);
  EXPECT_THAT(passed.err, HasSubstr("passed its effort limit 9.8 with 9.81"));
  const Json limits = Json::parse(passed.out)["limits_passed"];
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_NEAR(limits[0]["value"].get<double>(), needed, 1e-12);
  const ProgramResult within = asked("9.82");
  EXPECT_EQ(within.status, 0) << within.err;
  EXPECT_EQ(Json::parse(within.out)["limits_passed"].size(), 0u);
}

TEST(InverseCommand, UndoesForwardDynamics) {
  const TemporaryFolder folder;
  const std::string motion = folder.file("q.csv"), torques = folder.file("tau.csv");
  ASSERT_EQ(run_program({"simulate", "assets/scenes/rr_torque.yaml", "-o", motion, "--set", "duration=1",
                         "--set", "method=rk4", "--set", "video.fps=200"})
                .status,
            0);
  const ProgramResult result =
      run_program({"inverse", "models/rr.urdf", "--trajectory", motion, "-o", torques});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::vector<std::string> lines = lines_of(read_whole_file(torques));
  ASSERT_EQ(lines.size(), 1u + 201);
  EXPECT_EQ(lines[0], "t [s],tau1 [N m],tau2 [N m]");
  double t, tau1, tau2;
  ASSERT_EQ(std::sscanf(lines[100].c_str(), "%lf,%lf,%lf", &t, &tau1, &tau2), 3);
  // What is told of them is what stands in the table.
  double largest = 0, when = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    ASSERT_EQ(std::sscanf(lines[i].c_str(), "%lf,%lf,%lf", &t, &tau1, &tau2), 3);
    if (std::abs(tau2) > std::abs(largest)) largest = tau2, when = t;
  }
  const Json peak = Json::parse(run_program({"inverse", "models/rr.urdf", "--trajectory", motion, "-o", torques, "--force", "--json"}).out)["peaks"][1];
  EXPECT_EQ(peak, (Json{{"name", "tau2"}, {"unit", "N m"}, {"value", largest}, {"t", when}}));
  EXPECT_THAT(result.out, HasSubstr("peak of"));
  ASSERT_EQ(std::sscanf(lines[100].c_str(), "%lf,%lf,%lf", &t, &tau1, &tau2), 3);
  // qd is in the file and its spline at 5 ms gives qdd to h^3 of its fourth derivative (some 1e5 x 1e-7 /
  // 24).
  EXPECT_NEAR(tau1, 1, 1e-3);
  EXPECT_NEAR(tau2, 1, 1e-3);
}

TEST(DynamicsCommand, HasNoLambdaAtASingularPoseButItsDirection) {
  const Json json = dynamics({"models/rr.urdf"});
  EXPECT_TRUE(json["Lambda"].is_null());
  ASSERT_EQ(json["singular_directions"].size(), 1u);
  EXPECT_NEAR(std::abs(json["singular_directions"][0][0].get<double>()), 1, 1e-12);
  EXPECT_NEAR(json["singular_directions"][0][1].get<double>(), 0, 1e-12);
  EXPECT_FALSE(dynamics({"models/rr.urdf", "--q", "0,1"})["Lambda"].is_null());
}

// A straight chain moves its end along itself by rounding alone, however long it is.
TEST(DynamicsCommand, HasNoLambdaOfAStraightLongChain) {
  const TemporaryFolder folder;
  for (const int n : {3, 20, 100}) {
    std::string links, masses, q = "0.7", bent = "0.7";
    for (int i = 0; i < n; ++i) links += i == 0 ? "0.1" : ", 0.1", masses += i == 0 ? "1" : ", 1";
    for (int i = 1; i < n; ++i) q += ", 0", bent += i == n / 2 ? ", 1e-3" : ", 0";
    const auto report = [&](const std::string& pose) {
      const std::string scene = folder.write("s.yaml", "model: {links: [" + links + "], masses: [" + masses + "]}\nstart: {q: [" + pose + "]}\nduration: 0.1\nmethod: rk4\n");
      return Json::parse(run_program({"dynamics", scene, "--json"}).out);
    };
    EXPECT_TRUE(report(q)["Lambda"].is_null()) << n;
    EXPECT_EQ(report(q)["singular_directions"].size(), 1u) << n;
    EXPECT_FALSE(report(bent)["Lambda"].is_null()) << n << ": negative control";
  }
}

TEST(DynamicsCommand, TakesGravity) {
  const Json json = dynamics({"models/rr.urdf", "--gravity", "0,0,0"});
  EXPECT_EQ(json["tau_g"][0], 0);
  EXPECT_EQ(dynamics({"models/rr.urdf"})["gravity"][1], -9.81);
}

TEST(DynamicsCommand, SaysWhichNumberIsWrong) {
  const ProgramResult result = run_program({"dynamics", "models/rr.urdf", "--q", "0,ninety"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--q 0,ninety"));
}

}  // namespace
}  // namespace chainreel

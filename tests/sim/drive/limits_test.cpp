#include "sim/drive/limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "model/read_chain.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

// PP falling freely, its second joint limited.
Simulation falling(LimitPolicy policy) {
  Simulation run = run_of("pp", {"0", "0"}, 1);
  run.chain.bodies[2].joint.limit.lower = -1;
  run.chain.bodies[2].joint.limit.upper = 1;
  run.limit = policy;
  return run;
}

TEST(Limits, AreReportedOnceWithTimeAndValue) {
  const Trajectory trajectory = simulate(falling(LimitPolicy::report), instants(1, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::finished);
  ASSERT_EQ(trajectory.limits.size(), 1u);
  EXPECT_EQ(trajectory.limits[0].quantity, "position");
  EXPECT_EQ(trajectory.limits[0].limit, -1);
  // It falls 1 m in sqrt(2 / g), a parabola, which the method has exactly.
  EXPECT_NEAR(trajectory.limits[0].t, std::sqrt(2 / 9.81), 3e-12);
  EXPECT_NEAR(trajectory.limits[0].value, -1, 1e-10);
}

TEST(Limits, StopTheRunWhereTheSceneSaysSo) {
  const Trajectory trajectory = simulate(falling(LimitPolicy::stop), instants(1, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::stopped);
  EXPECT_NEAR(trajectory.end_time, std::sqrt(2 / 9.81), 3e-12);
  EXPECT_THAT(trajectory.trouble, testing::HasSubstr("passed its position limit -1"));
  ASSERT_EQ(trajectory.size(), 6) << "the last sample stands at the stop";
  EXPECT_EQ(trajectory.t.back(), trajectory.end_time);
  EXPECT_NEAR(trajectory.q_at(5)[1], -1, 1e-10);
}

TEST(Limits, AreFoundWithinTheLongStepsOfAdaptiveMethodsToo) {
  for (const char* method : {"dop853", "radau5"}) {
    Simulation run = falling(LimitPolicy::report);
    run.chain.bodies[2].joint.limit.velocity = 3;
    run.chain.bodies[1].joint.limit.effort = 2;
    run.torque = make_torque_law(run.chain, {{"4*t", {}, {}}, {"0", {}, {}}}, {});
    run.method = &find_method(method);
    run.step = 0;
    run.options.tolerance = 1e-9;
    const Trajectory trajectory = simulate(run, instants(1, 1));
    ASSERT_EQ(trajectory.limits.size(), 3u) << method;
    EXPECT_NEAR(trajectory.limits[0].t, 3 / 9.81, 1e-10) << trajectory.limits[0].quantity;
    EXPECT_NEAR(trajectory.limits[1].t, std::sqrt(2 / 9.81), 1e-10) << trajectory.limits[1].quantity;
    EXPECT_NEAR(trajectory.limits[2].t, 0.5, 1e-10) << trajectory.limits[2].quantity;
  }
}

// q2 = A sin t on a spring of 1 N/m with 1 kg, borne: it passes 1 at asin(1 / A), for 2 sqrt(2 (A - 1)) s, and so does its rate at acos(1 / A) behind the start, and the
// spring's force. The top lies at pi / 2, between the ends of steps.
Simulation swinging(double A, const std::string& method, double step) {
  Simulation run = run_of("pp", {"0", "9.81 - q2"}, 5, method, step);
  if (step == 0) run.options.tolerance = 1e-11;
  run.qd0 = {0, A};
  return run;
}

TEST(Limits, AreFoundWhereTheyArePassedBetweenLooks) {
  for (const auto& [method, step] : {std::pair("rk4", 1e-3), std::pair("rk4", 0.05), std::pair("gauss6", 0.5), std::pair("dop853", 0.0), std::pair("radau5", 0.0)}) {
    for (const double A : {1.0001, 1.00001}) {
      Simulation run = swinging(A, method, step);
      run.chain.bodies[2].joint.limit.upper = 1;
      const Trajectory trajectory = simulate(run, instants(5, 1));
      ASSERT_EQ(trajectory.limits.size(), 1u) << method << step << " " << A;
      // Of long steps the method's own error moves the instant: by its part of what lies beyond.
      EXPECT_NEAR(trajectory.limits[0].t, std::asin(1 / A), step > 0.01 ? 2e-3 : 1e-6) << method << step << " " << A;
      run.limit = LimitPolicy::stop;
      EXPECT_EQ(simulate(run, instants(5, 1)).status, RunStatus::stopped) << method << step;
    }
    Simulation within = swinging(0.9999, method, step);
    within.chain.bodies[2].joint.limit.upper = 1;
    within.chain.bodies[2].joint.limit.velocity = 1;
    within.chain.bodies[2].joint.limit.lower = -1;
    EXPECT_TRUE(simulate(within, instants(5, 1)).limits.empty()) << "negative control, " << method << step;
  }
}

// What touches a limit passes it by rounding at most: q2 = cos t between 1 and -1, of a method that gains nothing.
TEST(Limits, ThatAreTouchedAreNotPassed) {
  for (const auto& [method, step] : {std::pair("rk4", 1e-3), std::pair("gauss6", 0.05)}) {
    Simulation run = swinging(0, method, step);
    run.q0 = {0, 1};
    run.chain.bodies[2].joint.limit.lower = -1;
    run.chain.bodies[2].joint.limit.upper = 1;
    EXPECT_TRUE(simulate(run, instants(5, 1)).limits.empty()) << method;
  }
}

// The rate's peak at half a period, -A at pi, and an effort's: A force that peaks at 2.5 s for a hundredth of that.
TEST(Limits, OfRatesAndEffortsAreFoundBetweenLooksToo) {
  for (const auto& [method, step] : {std::pair("rk4", 0.05), std::pair("gauss6", 0.5), std::pair("dop853", 0.0)}) {
    Simulation run = swinging(1, method, step);
    run.q0 = {0, 1.0001};
    run.qd0 = {0, 0};
    run.chain.bodies[2].joint.limit.velocity = 1;
    const Trajectory rates = simulate(run, instants(5, 1));
    ASSERT_EQ(rates.limits.size(), 1u) << method << step;
    EXPECT_EQ(rates.limits[0].quantity, "velocity");
    EXPECT_NEAR(rates.limits[0].t, std::asin(1 / 1.0001), step > 0.01 ? 2e-3 : 1e-6) << method << step;
  }
  for (const auto& [method, step] : {std::pair("rk4", 0.05), std::pair("dop853", 0.0)}) {
    Simulation run = run_of("pp", {"2.0001 * sin(3 * t)", "9.81"}, 2, method, step);
    if (step == 0) run.options.tolerance = 1e-9;
    run.chain.bodies[1].joint.limit.effort = 2;
    const Trajectory efforts = simulate(run, instants(2, 1));
    ASSERT_EQ(efforts.limits.size(), 1u) << method;
    EXPECT_EQ(efforts.limits[0].quantity, "effort");
    EXPECT_NEAR(efforts.limits[0].t, std::asin(2 / 2.0001) / 3, 1e-6) << method;
    run.chain.bodies[1].joint.limit.effort = 2.0002;
    EXPECT_TRUE(simulate(run, instants(2, 1)).limits.empty()) << "negative control, " << method;
  }
}

TEST(Limits, ThatTheStartIsBeyondStopTheRunThere) {
  Simulation run = run_of("pp", {"10", "0"}, 1);
  run.chain.bodies[1].joint.limit.effort = 4;
  run.limit = LimitPolicy::stop;
  const Trajectory trajectory = simulate(run, instants(1, 0.5));
  EXPECT_EQ(trajectory.status, RunStatus::stopped);
  EXPECT_EQ(trajectory.end_time, 0);
  EXPECT_EQ(trajectory.size(), 1);
  ASSERT_EQ(trajectory.limits.size(), 1u);
  EXPECT_EQ(trajectory.limits[0].quantity, "effort");
  EXPECT_EQ(trajectory.limits[0].t, 0);
}

TEST(Limits, ClampTorquesAtTheEffortAndTheAuditFollows) {
  const auto pushed = [](LimitPolicy policy) {
    Simulation run = run_of("pp", {"10", "0"}, 1);
    run.chain.bodies[1].joint.limit.effort = 4;
    run.limit = policy;
    return run;
  };
  const Simulation clamped = pushed(LimitPolicy::clamp);
  const Trajectory cut = simulate(clamped, instants(1, 1));
  const Trajectory whole = simulate(pushed(LimitPolicy::report), instants(1, 1));
  // x = f t^2 / (2 m): in the ratio of the forces.
  EXPECT_NEAR(cut.q_at(1)[0] / whole.q_at(1)[0], 0.4, 1e-12);
  ASSERT_EQ(cut.limits.size(), 1u);
  EXPECT_EQ(cut.limits[0].quantity, "effort");
  EXPECT_EQ(cut.limits[0].value, 10);
  EXPECT_LT(audit_of(clamped, cut).largest_error, 1e-10);
}

TEST(Limits, HoldOnBothSides) {
  // Thrown upward with 5 m/s: through 1 m on the way up, through -6 m/s on the way down.
  Simulation run = run_of("pp", {"0", "0"}, 1.5);
  run.qd0[1] = 5;
  JointLimit& limit = run.chain.bodies[2].joint.limit;
  limit.lower = -1;
  limit.upper = 1;
  limit.velocity = 6;
  const Trajectory trajectory = simulate(run, instants(1.5, 0.1));
  ASSERT_EQ(trajectory.limits.size(), 2u);
  EXPECT_EQ(trajectory.limits[0].quantity, "position");
  EXPECT_EQ(trajectory.limits[0].limit, 1);
  EXPECT_NEAR(trajectory.limits[0].t, (5 - std::sqrt(25 - 2 * 9.81)) / 9.81, 3e-12);
  EXPECT_NEAR(trajectory.limits[0].value, 1, 1e-10);
  EXPECT_EQ(trajectory.limits[1].quantity, "velocity");
  EXPECT_NEAR(trajectory.limits[1].t, 11 / 9.81, 3e-12);
  EXPECT_NEAR(trajectory.limits[1].value, -6, 1e-10);
}

TEST(Limits, ClampNegativeTorquesToNegativeOnes) {
  Simulation run = run_of("pp", {"-10", "0"}, 1);
  run.chain.bodies[1].joint.limit.effort = 4;
  run.limit = LimitPolicy::clamp;
  const Trajectory trajectory = simulate(run, instants(1, 1));
  // x = f t^2 / (2 m) with both links on the first joint, 1 kg each.
  EXPECT_NEAR(trajectory.q_at(1)[0], -1, 1e-12);
  ASSERT_EQ(trajectory.limits.size(), 1u);
  EXPECT_EQ(trajectory.limits[0].value, -10);
  EXPECT_EQ(trajectory.limits[0].limit, 4);
}

// A slide that carries another, which follows it: 1 kg each, pushed without gravity.
Simulation followed(const std::string& mimic) {
  const auto slide = [](const std::string& name, const std::string& parent, const std::string& more) {
    return "<link name='" + name + "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>" +
           "</inertial></link><joint name='to_" + name + "' type='prismatic'><parent link='" + parent + "'/><child link='" +
           name + "'/><axis xyz='1 0 0'/>" + more + "</joint>";
  };
  const TemporaryFolder folder;
  Simulation run = run_of("pp", {}, 2);
  run.chain = read_chain(folder.write(
      "m.urdf", "<robot name='r'><link name='base'/>" + slide("a", "base", "<limit lower='-9' upper='9' effort='99' velocity='99'/>") +
                    slide("b", "a", "<limit lower='-2' upper='2' effort='1' velocity='3'/><mimic joint='to_a' " + mimic + "/>") +
                    "</robot>"));
  run.chain.gravity.setZero();
  run.q0 = run.qd0 = {0};
  run.torque = make_torque_law(run.chain, {{"10", {}, {}}}, {});
  return run;
}

TEST(Limits, OfAJointThatFollowsAreOnItsOwnMotionAndOnNoTorque) {
  // b = 2 a + 0.5, so that a moves 1 kg and, three times as fast, another: 10 N give 1 m/s^2.
  const Trajectory trajectory = simulate(followed("multiplier='2' offset='0.5'"), instants(2, 0.1));
  ASSERT_EQ(trajectory.limits.size(), 2u) << "its effort of 1 N bounds nothing";
  EXPECT_EQ(trajectory.limits[0].joint, "to_b");
  EXPECT_EQ(trajectory.limits[0].quantity, "position");
  EXPECT_NEAR(trajectory.limits[0].t, std::sqrt(1.5), 3e-12) << "t^2 + 0.5 = 2";
  EXPECT_EQ(trajectory.limits[1].quantity, "velocity");
  EXPECT_NEAR(trajectory.limits[1].t, 1.5, 3e-12) << "2 t = 3";
  // One that moves just as the other has no torque either.
  Simulation same = followed("");
  same.limit = LimitPolicy::clamp;
  const Trajectory equal = simulate(same, instants(1, 1));
  EXPECT_NEAR(equal.q_at(1)[0], 10.0 / 5 / 2, 1e-12);
  for (const LimitEvent& one : equal.limits) EXPECT_NE(one.quantity, "effort");
}

TEST(Limits, AreSilentWhereNothingIsPassed) {
  EXPECT_TRUE(simulate(run_of("rr", {"0", "0"}, 1), instants(1, 1)).limits.empty());
}

TEST(LimitPolicy, NamesTheNearestOne) {
  EXPECT_EQ(require_named<LimitPolicy>("'limit'", "clamp"), LimitPolicy::clamp);
  try {
    require_named<LimitPolicy>("'limit'", "clmp");
    FAIL() << "an unknown policy was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'clamp'?"));
  }
}

}  // namespace
}  // namespace chainreel

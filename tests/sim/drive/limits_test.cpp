#include "sim/drive/limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"

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

TEST(Limits, AreSilentWhereNothingIsPassed) {
  EXPECT_TRUE(simulate(run_of("rr", {"0", "0"}, 1), instants(1, 1)).limits.empty());
}

TEST(LimitPolicy, NamesTheNearestOne) {
  EXPECT_EQ(limit_policy_of("clamp"), LimitPolicy::clamp);
  try {
    limit_policy_of("clmp");
    FAIL() << "an unknown policy was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'clamp'?"));
  }
}

}  // namespace
}  // namespace chainreel

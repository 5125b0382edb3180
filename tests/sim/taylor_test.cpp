// The Taylor method on chains: how exact it is, how it chooses its step, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sim/audit.hpp"
#include "sim/drive/control.hpp"
#include "sim/drive/torque.hpp"
#include "sim/runs.hpp"
#include "sim/simulate.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

Simulation series_run(const std::string& model, const std::vector<std::string>& torque, double duration,
                      double tolerance, int order = 20) {
  Simulation run = run_of(model, torque, duration, "taylor", 0);
  run.options = {tolerance, order};
  return run;
}

Trajectory end_of(const Simulation& run) {
  return simulate(run, std::vector{run.duration});
}

double apart(const Trajectory& a, const Trajectory& b) {
  EXPECT_EQ(a.status, RunStatus::finished) << a.trouble;
  EXPECT_EQ(b.status, RunStatus::finished) << b.trouble;
  double largest = 0;
  for (std::size_t i = 0; i < a.q.size(); ++i) largest = std::max(largest, std::abs(a.q[i] - b.q[i]));
  return largest;
}

// rk4 shares nothing with the series but the model.
Trajectory by_rk4(Simulation& run, double step) {
  run.method = &find_method("rk4");
  run.step = step;
  return end_of(run);
}

class Torques : public ::testing::TestWithParam<std::vector<std::string>> {};
INSTANTIATE_TEST_SUITE_P(
    Affine, Torques,
    ::testing::Values(std::vector<std::string>{"0", "0", "0"}, std::vector<std::string>{"10", "10", "10"},
                    std::vector<std::string>{"3*t - t^2", "1 - 2*t^3", "0"},
                    std::vector<std::string>{"-20*q1 - 2*qd1", "5*(q1 - q2)", "-0.5*qd3 + 4*t"}));

TEST_P(Torques, MoveTheChainAsTheyDoWithAnotherMethod) {
  Simulation run = series_run("rrr", GetParam(), 0.5, 1e-12);
  const Trajectory series = end_of(run);
  const Trajectory rk4 = by_rk4(run, 1e-4);
  // rk4 leaves about 1e-10 here; 10 % less of the first torque or 1 % less gravity is far from that.
  EXPECT_LT(apart(series, rk4), 1e-9);
  run.chain.gravity *= 0.99;
  EXPECT_GT(apart(series, by_rk4(run, 1e-4)), 1e-3);
}

TEST(TaylorMethod, TakesTheDampingOfJoints) {
  Simulation run = series_run("rr", {"1", "0"}, 1, 1e-12);
  const Trajectory free = end_of(run);
  run.chain.bodies[1].joint.damping = 0.5;
  run.chain.has_dissipation = true;
  const Trajectory damped = end_of(run);
  EXPECT_GT(apart(free, damped), 0.01);
  EXPECT_LT(apart(damped, by_rk4(run, 1e-4)), 1e-10);
}

// kp (q* - q) + kd (qd* - qd) with q* a polynomial in t, of all joints, of one beside an expression, and with rates of its own.
TEST(TaylorMethod, TakesFeedbackThatFollowsAPolynomial) {
  const auto pd = [](const std::vector<std::string>& q, const std::vector<std::string>& qd) {
    Control control;
    control.pd = Feedback{{30}, {4}, {}, {}, {}, ""};
    for (const std::string& one : q) control.pd->q.push_back({one, {}});
    for (const std::string& one : qd) control.pd->qd.push_back({one, {}});
    return control;
  };
  Simulation run = series_run("rr", {"0", "0"}, 1, 1e-12);
  const auto expect_as_by_rk4 = [&](std::unique_ptr<TorqueLaw> law) {
    run.torque = std::move(law);
    run.method = &find_method("taylor");
    run.options = {1e-12, 20};
    const Trajectory series = end_of(run);
    EXPECT_LT(apart(series, by_rk4(run, 1e-4)), 1e-9);  // rk4 leaves about 1e-11 here
    return series;
  };
  const Trajectory plain = expect_as_by_rk4(make_control(run.chain, pd({"1 - t^2", "0.5 * t"}, {}), {}));
  const Trajectory own_rates = expect_as_by_rk4(make_control(run.chain, pd({"1 - t^2", "0.5 * t"}, {"0", "t"}), {}));
  EXPECT_GT(apart(plain, own_rates), 0.01) << "rates of its own change the motion";
  std::vector<TorqueEntry> entries(2);
  entries[0].control = pd({"0.3"}, {});
  entries[1].text = "2 * t - q2";
  expect_as_by_rk4(make_torque_law(run.chain, entries, {}));
  EXPECT_FALSE(make_control(run.chain, pd({"sin(t)", "0"}, {}), {})->affine());
  Control gravity = pd({"1", "0"}, {});
  gravity.gravity_compensation = true;
  EXPECT_FALSE(make_control(run.chain, gravity, {})->affine());
}

class Orders : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(TwelveToThirty, Orders, ::testing::Values(12, 13, 14, 15, 16, 20, 25, 30));

// From rest along the horizontal only the terms of orders 2, 6, 10, .. are there.
TEST_P(Orders, AreNotDeceivedByReleaseFromTheHorizontal) {
  const Trajectory exact = end_of(series_run("rr", {"0", "0"}, 2, 1e-15, 20));
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Trajectory run = end_of(series_run("rr", {"0", "0"}, 2, tolerance, GetParam()));
    // Errors of steps grow about tenfold over these 2 s, and some ten to a hundred of them add up.
    EXPECT_LT(apart(run, exact), 100 * tolerance) << tolerance;
    EXPECT_GT(run.steps, 2) << tolerance;
  }
}

// Without gravity, t^4 on the first joint from rest: the terms of orders 6, 18, .. are there, and of order 16
// the last four are all missing.
TEST_P(Orders, AreNotDeceivedByWideGaps) {
  Simulation run = series_run("rr", {"t^4", "-2*t^4"}, 2, 1e-9, GetParam());
  run.chain.gravity.setZero();
  const Trajectory series = end_of(run);
  EXPECT_GT(std::abs(series.q[1]), 1);  // a motion that is far from its first term
  EXPECT_LT(apart(series, by_rk4(run, 2e-4)), 1e-7);
}

TEST(TaylorMethod, StaysAtAnEquilibrium) {
  Simulation run = series_run("rr", {"0", "0"}, 100, 1e-9);
  run.q0 = {-1.57079632679489656, 0};
  const Trajectory hanging = end_of(run);
  EXPECT_EQ(hanging.status, RunStatus::finished);
  EXPECT_NEAR(hanging.q[0], run.q0[0], 1e-9);
  EXPECT_NEAR(hanging.q[1], 0, 1e-9);

  run.chain.gravity.setZero();
  run.q0 = {0.3, 0.4};
  const Trajectory weightless = end_of(run);
  EXPECT_THAT(weightless.q, testing::ElementsAre(0.3, 0.4));
  EXPECT_EQ(weightless.steps, 1);
}

TEST(TaylorMethod, TurnsUniformlyWhereNothingPulls) {
  Simulation run = series_run("rr", {"0", "0"}, 50, 1e-9);
  run.chain.gravity.setZero();
  run.q0 = {0, 0};
  run.qd0 = {2, 0};  // stretched: the outer link is held by nothing but the symmetry of the motion
  const Trajectory turning = end_of(run);
  EXPECT_EQ(turning.status, RunStatus::finished);
  EXPECT_NEAR(turning.q[0], 100, 1e-6);
}

TEST(TaylorMethod, KeepsTheEnergyForAThousandSeconds) {
  Simulation run = series_run("rr", {"0", "0"}, 1000, 1e-16);
  const auto energy_error = [&run] {
    const Trajectory trajectory = simulate(run, instants(1000, 1));
    EXPECT_EQ(trajectory.size(), 1001) << trajectory.trouble;
    return audit_of(run, trajectory).largest_error;
  };
  EXPECT_LE(energy_error(), 1e-10);  // J, of 40 J that go to and fro
  run.options.tolerance = 1e-9;
  EXPECT_GT(energy_error(), 1e-10);
}

TEST(TaylorMethod, ShowsTheSameMotionBetweenItsSteps) {
  const Simulation run = series_run("rr", {"1", "1"}, 2, 1e-10);
  const std::vector<double> times = instants(2, 0.01);
  const Trajectory frames = simulate(run, times);
  ASSERT_EQ(frames.size(), int(times.size()));
  EXPECT_LT(frames.steps, 60);
  Simulation exact = series_run("rr", {"1", "1"}, 2, 1e-15);
  for (int k = 25; k < frames.size(); k += 25) {
    exact.duration = times[std::size_t(k)];
    const Trajectory end = end_of(exact);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(frames.q_at(k)[i], end.q[i], 1e-8) << times[std::size_t(k)];
      EXPECT_NEAR(frames.qd_at(k)[i], end.qd[i], 1e-8) << times[std::size_t(k)];
    }
  }
}

TEST(TaylorMethod, TakesAFixedStepToo) {
  Simulation run = series_run("rr", {"0", "0"}, 1, 0);
  run.step = 0.02;
  const Trajectory fixed = end_of(run);
  EXPECT_EQ(fixed.steps, 50);
  // A third of the step that 1e-9 asks for: 3^-20 of that.
  EXPECT_LT(apart(fixed, end_of(series_run("rr", {"0", "0"}, 1, 1e-15))), 1e-13);
}

TEST(TaylorMethod, RefusesWhatHasNoSeriesAndSaysWhy) {
  const auto refusal = [](const Simulation& run) -> std::string {
    try {
      check_method(run);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      EXPECT_THAT(error.what(), HasSubstr("dop853"));
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(series_run("rr", {"-q1*2", "t"}, 1, 1e-9)), "");
  EXPECT_THAT(refusal(series_run("rr", {"sin(q1)", "0"}, 1, 1e-9)), HasSubstr("polynomial"));
  EXPECT_THAT(refusal(series_run("rr", {"q1*q2", "0"}, 1, 1e-9)), HasSubstr("polynomial"));
  EXPECT_THAT(refusal(series_run("rr", {"x_G", "0"}, 1, 1e-9)), HasSubstr("polynomial"));
  EXPECT_THAT(refusal(series_run("pp", {"0", "0"}, 1, 1e-9)), HasSubstr("not revolute"));
  Simulation clamped = series_run("rr", {"0", "0"}, 1, 1e-9);
  clamped.limit = LimitPolicy::clamp;
  EXPECT_EQ(refusal(clamped), "");
  clamped.chain.bodies[1].joint.limit.effort = 5;
  EXPECT_THAT(refusal(clamped), HasSubstr("effort"));
}

TEST(TaylorMethod, StillReportsEffortBeyondItsLimit) {
  Simulation run = series_run("rr", {"-30*q1", "0"}, 1, 1e-9);
  run.chain.bodies[1].joint.limit.effort = 5;
  const Trajectory trajectory = end_of(run);
  ASSERT_EQ(trajectory.limits.size(), 1u);
  EXPECT_EQ(trajectory.limits[0].quantity, "effort");
}

}  // namespace
}  // namespace chainreel

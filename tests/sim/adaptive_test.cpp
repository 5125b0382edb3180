// Runs whose steps come from a tolerance: where they cannot go on they say so, with time and joint.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/runs.hpp"
#include "sim/system/chain_system.hpp"
#include "support/allocation_count.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

Simulation adaptive_run(const std::string& model, const std::vector<std::string>& torque, double duration,
                        const std::string& method, double tolerance) {
  Simulation run = run_of(model, torque, duration, method, 0);
  run.options.tolerance = tolerance;
  return run;
}

class Adaptive : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, Adaptive, ::testing::Values("dop853", "radau5"),
                         [](const auto& p) { return p.param; });

TEST_P(Adaptive, EndsWithStatusTimeAndJointWhereATorqueBlowsUp) {
  // Stronger than gravity and growing with exp(q1^2): infinite after a finite time. Depending on which comes
  // first, the torque is no number any more, no step is small enough, or the bound of divergence is passed.
  const Simulation run = adaptive_run("rr", {"50 * exp(q1^2)", "0"}, 100, GetParam(), 1e-6);
  const Trajectory trajectory = simulate(run, instants(100, 0.1));
  EXPECT_NE(trajectory.status, RunStatus::finished);
  EXPECT_LT(trajectory.end_time, 100);
  EXPECT_LT(trajectory.steps, 100000);
  EXPECT_GT(trajectory.size(), 1);
  EXPECT_THAT(trajectory.trouble, HasSubstr("joint '" + run.chain.coordinate_names[0] + "'"));
  EXPECT_THAT(trajectory.trouble, HasSubstr(" at t = "));
  for (int k = 0; k < trajectory.size(); ++k) EXPECT_TRUE(std::isfinite(trajectory.q_at(k)[0])) << k;
}

TEST_P(Adaptive, FinishesWhereTheSameTorqueIsHeldDown) {
  // Negative control: with a bound on the exponent there is nothing to blow up.
  const Simulation run = adaptive_run("rr", {"50 * exp(min(q1^2, 1))", "-qd2"}, 3, GetParam(), 1e-6);
  EXPECT_EQ(simulate(run, instants(3, 0.1)).status, RunStatus::finished);
}

TEST_P(Adaptive, TakesNoHarmFromATorqueThatWasNoNumberInARejectedAttempt) {
  // Thrown at a wall that is felt close by and behind which there are no numbers: long steps look behind it.
  struct Wall final : TorqueLaw {
    double price(const Chain&) const override { return 0; }
    int beyond = 0;
    void evaluate(const Chain&, Workspace&, double, ConstVec q, ConstVec, Vec tau) override {
      const double gap = 1 - q[0];
      beyond += gap < 0;
      tau[0] = -0.001 / (gap * std::sqrt(gap));
    }
  };
  auto law = std::make_unique<Wall>();
  const Wall& wall = *law;
  Simulation run = adaptive_run("p", {"0"}, 4, GetParam(), 1e-4);
  run.torque = std::move(law);
  run.chain.gravity.setZero();
  run.qd0 = {1};
  const Trajectory trajectory = simulate(run, instants(4, 0.5));
  EXPECT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  EXPECT_NEAR(trajectory.qd_at(trajectory.size() - 1)[0], -1, 0.01);  // thrown back
  EXPECT_GT(wall.beyond, 0);                                          // else this test has shown nothing
}

TEST_P(Adaptive, StopsAtOnceWhereATorqueIsNoNumberAtTheStart) {
  const Simulation run = adaptive_run("rr", {"0", "1 / t"}, 1, GetParam(), 1e-6);
  const Trajectory trajectory = simulate(run, instants(1, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::torque_not_finite);
  EXPECT_THAT(trajectory.trouble, HasSubstr("joint '" + run.chain.coordinate_names[1] + "' is not"));
  EXPECT_EQ(trajectory.end_time, 0);
}

TEST_P(Adaptive, MeetsAnotherMethodsRunWithinTheTolerance) {
  const std::vector<double> times = instants(2, 0.1);
  const Trajectory one = simulate(adaptive_run("rr", {"1", "1"}, 2, GetParam(), 1e-8), times);
  const Trajectory other = simulate(run_of("rr", {"1", "1"}, 2, "rk4", 2e-4), times);
  ASSERT_EQ(one.size(), other.size());
  // In 2 s RR multiplies errors by some ten; samples lie between the steps.
  for (int k = 0; k < one.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(one.q_at(k)[i], other.q_at(k)[i], 1e-6) << k;
}

TEST_P(Adaptive, FeelsItsWayToAJumpOfATorque) {
  // At an instant that the method is not told: q1 = F / m (t - 0.3)^2 / 2, against the same without a jump.
  const std::vector<double> end{1};
  const Trajectory jump = simulate(adaptive_run("pp", {"(t > 0.3) * 2", "0"}, 1, GetParam(), 1e-8), end);
  const Trajectory whole = simulate(adaptive_run("pp", {"2", "0"}, 1, GetParam(), 1e-8), end);
  ASSERT_EQ(jump.status, RunStatus::finished) << jump.trouble;
  EXPECT_GT(whole.q_at(0)[0], 0.1);
  EXPECT_NEAR(jump.q_at(0)[0], 0.49 * whole.q_at(0)[0], 1e-6);
}

TEST(StiffJoint, MovesAsWithShortStepsAtATenthOfTheirCost) {
  // A second joint held by 1e6 N m/rad and 1e3 N m s/rad, released 0.1 rad away: RR becomes one rigid
  // pendulum.
  const auto run = [](const std::string& method, double tolerance, double duration) {
    Simulation made = adaptive_run("rr", {"0", "-1e6 * q2 - 1e3 * qd2"}, duration, method, tolerance);
    made.q0 = {0, 0.1};
    return made;
  };
  const std::vector<double> end{1};
  const Trajectory radau = simulate(run("radau5", 1e-7, 1), end), dop = simulate(run("dop853", 1e-9, 1), end);
  ASSERT_EQ(radau.status, RunStatus::finished) << radau.trouble;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(radau.q_at(0)[i], dop.q_at(0)[i], 1e-6);
  EXPECT_LT(10 * radau.evaluations, dop.evaluations);
}

TEST(StiffJoint, IsTheSameRunWhateverIsSampled) {
  const auto end = [](double dt) {
    Simulation run = adaptive_run("rr", {"0", "-1e6 * q2 - 1e3 * qd2"}, 1, "radau5", 1e-5);
    run.q0 = {0, 0.1};
    const Trajectory trajectory = simulate(run, instants(1, dt));
    return trajectory.q_at(trajectory.size() - 1)[0];
  };
  EXPECT_EQ(end(0.25), end(0.0625));
}

// Allocations of a whole run, from the start of a method that has been made to its end.
long allocations(const std::string& method, double tolerance) {
  const Simulation run = run_of("rrr", {"1", "-y_G", "-0.1 * qd3"}, 1);
  ChainSystem system(run);
  Forms forms;
  forms.second_order = &system;
  const auto integrator = make_integrator(find_method(method), forms, {.tolerance = tolerance, .order = 0});
  std::vector<double> q(3), qd(3);
  const long before = allocation_count();
  integrator->start(0, run.q0, run.qd0);
  while (integrator->time() < 1) {
    if (tolerance > 0)
      integrator->step(1, 1 - integrator->time());
    else
      integrator->step(integrator->time() + 0.125, 0.125);
    integrator->interpolate(0.5 * (integrator->begin_time() + integrator->time()), q, qd);
  }
  return allocation_count() - before;
}

TEST_P(Adaptive, AllocatesNothingOnceMade) {
  EXPECT_EQ(allocations(GetParam(), 1e-6), 0);
  EXPECT_EQ(allocations(GetParam(), 0), 0);
}

}  // namespace
}  // namespace chainreel

// Runs under torques with corners: against closed forms, against integration by hand from corner to corner,
// and against other methods.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "support/battery.hpp"

namespace chainreel {
namespace {

using ::testing::HasSubstr;

// Adaptive: its step is 0.
Simulation with(Simulation run, const std::string& method, double tolerance) {
  run.method = &find_method(method);
  run.step = 0;
  run.options.tolerance = tolerance;
  return run;
}

// The first joint of PP slides across gravity; the second falls beside it and takes no part.
Simulation slider(const std::string& torque, double duration, const std::string& method = "rk4",
                  double step = 0.01) {
  return run_of("pp", {torque, "0"}, duration, method, step);
}

std::vector<double> end_of(const Simulation& run) {
  const double end[] = {run.duration};
  const Trajectory trajectory = simulate(run, end);
  EXPECT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  if (trajectory.size() != 1) return {};
  std::vector<double> state(trajectory.q.begin(), trajectory.q.end());
  state.insert(state.end(), trajectory.qd.begin(), trajectory.qd.end());
  return state;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.empty()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double mass_of_slider() {
  const Simulation run = slider("1", 1);
  return 0.5 / end_of(run)[0];  // x = f t^2 / (2 m)
}

class EveryMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         ::testing::Values("rk4", "dop853", "radau5", "verlet", "gauss4", "implicit_midpoint"),
                         [](const auto& p) { return p.param; });

TEST_P(EveryMethod, FollowsAPushOfTwoMillisecondsExactly) {
  // Piecewise a parabola, which all of these have exactly: x(1) = v (1 - 0.507 - 0.001), v = f 0.002 / m.
  Simulation run = slider("1000*(t>0.507)*(t<0.509)", 1, GetParam(), 0.05);
  if (run.method->adaptive) run = with(std::move(run), GetParam(), 1e-9);
  const double m = mass_of_slider();
  EXPECT_NEAR(end_of(run)[2], 2 / m, 1e-12);
  EXPECT_NEAR(end_of(run)[0], 2 / m * (1 - 0.508), 1e-12);
}

TEST_P(EveryMethod, HoldsASliderThatSignFrictionHasStopped) {
  // 2 N against 1 m/s: it stops at t = m / 2 after m / 4, and rests there.
  Simulation run = slider("-2*((qd1>0)-(qd1<0))", 3, GetParam(), 0.05);
  if (run.method->adaptive) run = with(std::move(run), GetParam(), 1e-9);
  run.qd0[0] = 1;
  const double m = mass_of_slider();
  EXPECT_NEAR(end_of(run)[0], m / 4, 1e-11);
  EXPECT_NEAR(end_of(run)[2], 0, 1e-11);
  const Trajectory trajectory = simulate(run, instants(3, 0.1));
  ASSERT_EQ(trajectory.holds.size(), 1u);
  EXPECT_NEAR(trajectory.holds[0].begin, m / 2, 1e-11);
  EXPECT_LT(trajectory.steps, 1000);
}

TEST(Corners, FrictionLetsGoWhereThePushOutgrowsIt) {
  // A push of t N against 2 N: at rest until 2 s, then x = (t - 2)^3 / (6 m).
  for (const char* method : {"dop853", "radau5", "rk4"}) {
    Simulation run = slider("t - 2*((qd1>0)-(qd1<0))", 4, method, 0.05);
    if (run.method->adaptive) run = with(std::move(run), method, 1e-10);
    const double m = mass_of_slider();
    EXPECT_NEAR(end_of(run)[0], 8 / (6 * m), 1e-10) << method;
    EXPECT_NEAR(end_of(run)[2], 2 / m, 1e-10) << method;
  }
}

Simulation arm_with_dry_friction() {
  Simulation run = run_of("rr", {"-30*((qd1>0)-(qd1<0))", "-30*((qd2>0)-(qd2<0))"}, 4);
  run.q0 = {-1, 0.5};
  run.qd0 = {2, -3};
  return run;
}

TEST(Corners, DryFrictionOfBothJointsHoldsAnArmInTheEnd) {
  const std::vector<double> one = end_of(with(arm_with_dry_friction(), "dop853", 1e-11));
  const std::vector<double> other = end_of(with(arm_with_dry_friction(), "radau5", 1e-11));
  EXPECT_LT(apart(one, other), 1e-8);
  EXPECT_NEAR(one[2], 0, 1e-10);
  EXPECT_NEAR(one[3], 0, 1e-10);
}

}  // namespace
}  // namespace chainreel

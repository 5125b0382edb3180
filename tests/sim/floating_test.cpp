// Adaptive and fixed steps of a chain with quaternions among its coordinates.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sim/runs.hpp"
#include "support/chains.hpp"

namespace chainreel::testing {
namespace {

// A tree of three bodies that floats and tumbles.
Simulation tumbling(const std::string& method, double step, double tolerance) {
  Simulation run;
  run.chain = random_tree(11, {.bodies = 3, .floating_base = true, .prismatic = 0});
  run.q0 = zero_configuration(run.chain);
  run.qd0.assign(std::size_t(run.chain.nv), 0.7);
  run.torque = make_torque_law(run.chain, std::vector<TorqueEntry>(std::size_t(run.chain.nv)), {});
  run.method = &find_method(method);
  run.options.tolerance = tolerance;
  run.step = step;
  run.duration = 1;
  return run;
}

double distance(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (int k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < std::size_t(a.nq); ++i)
      largest = std::max(largest, std::abs(a.q_at(k)[i] - b.q_at(k)[i]));
  return largest;
}

TEST(FloatingBase, MovesWithDop853AsWithShortSteps) {
  const std::vector<double> times = instants(1, 0.0625);
  const Trajectory truth = simulate(tumbling("rk4", 5e-4, 0), times);
  const Trajectory one = simulate(tumbling("dop853", 0, 1e-10), times);
  ASSERT_EQ(one.size(), int(times.size()));
  // The tolerance of some ten steps; that of rk4, h^4 times rates of some 3 /s to the fifth, is no larger.
  EXPECT_LT(distance(one, truth), 1e-9);
  EXPECT_GT(distance(simulate(tumbling("dop853", 0, 1e-3), times), truth), 1e-9);  // negative control
}

TEST(FloatingBase, IsInterpolatedByDop853WithItsDenseOrder) {
  const auto error = [](int steps) {
    std::vector<double> times;
    for (int k = 0; k < steps; ++k) times.push_back((k + 1.0 / 3) / steps);
    return distance(simulate(tumbling("dop853", 1.0 / steps, 0), times),
                    simulate(tumbling("dop853", 0, 1e-14), times));
  };
  // A local error of order 7 + 1; the next term is a tenth of it.
  EXPECT_NEAR(std::log2(error(6) / error(12)), 8, 0.3);
}

TEST(FloatingBase, IsRefusedByRadau5WhichNamesAnother) {
  try {
    check_method(tumbling("radau5", 0, 1e-6));
    FAIL() << "radau5 took a quaternion";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("take dop853"), std::string::npos);
  }
  check_method(tumbling("dop853", 0, 1e-6));
}

}  // namespace
}  // namespace chainreel::testing

// The loop allocates nothing after the first step.

#include <algorithm>

#include <gtest/gtest.h>

#include "sim/runs.hpp"
#include "support/allocation_count.hpp"

namespace chainreel {
namespace {

// Allocations from the second request on; requests come every few thousand steps.
long allocations_in_loop(const Simulation& run, std::span<const double> times) {
  long at_first = -1, at_last = 0;
  simulate(run, times, [&](double t) {
    if (t > 0 && at_first < 0) at_first = allocation_count();
    at_last = allocation_count();
    return false;
  });
  return at_last - at_first;
}

class Loop : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, Loop,
                         ::testing::Values("explicit_euler", "semi_implicit_euler", "rk4", "symplectic_euler",
                                         "verlet", "implicit_midpoint", "gauss6"),
                         [](const auto& p) { return p.param; });

TEST_P(Loop, AllocatesNothingAfterTheFirstStep) {
  const std::vector<double> times = instants(20, 1.0 / 60);
  EXPECT_EQ(allocations_in_loop(run_of("rr", {"1", "1"}, 20, GetParam(), 0.0005), times), 0);
  EXPECT_EQ(allocations_in_loop(run_of("rrr", {"1", "-y_G", "-0.1 * qd3"}, 20, GetParam(), 0.0005), times),
            0);
  EXPECT_EQ(allocations_in_loop(run_of("pp", {"0", "-100 * y_G"}, 20, GetParam(), 0.0005), times), 0);
}

TEST(RattlesLoop, AllocatesNothingAfterTheFirstStep) {
  const std::vector<double> times = instants(20, 1.0 / 60);
  EXPECT_EQ(allocations_in_loop(run_of("rr", {"1", "1"}, 20, "rattle4", 0.002), times), 0);
  EXPECT_EQ(allocations_in_loop(run_of("rrr", {"1", "-y_G", "-0.1 * qd3"}, 20, "rattle2", 0.002), times), 0);
}

TEST(Counter, SeesALawThatAllocates) {
  struct Wasteful final : TorqueLaw {
    double price(const Chain&) const override { return 0; }
    void evaluate(const Chain&, Workspace&, double, ConstVec, ConstVec, Vec tau) override {
      const std::vector<double> fresh(tau.size(), 0.0);
      std::copy(fresh.begin(), fresh.end(), tau.begin());
    }
  };
  Simulation run = run_of("rr", {"0", "0"}, 100, "semi_implicit_euler");
  run.torque = std::make_unique<Wasteful>();
  EXPECT_GT(allocations_in_loop(run, {}), 1000);
}

}  // namespace
}  // namespace chainreel

// Where fixed steps stop being stable, measured by long runs: theory in, measurement must agree. The
// oscillator is q'' = -omega^2 q - 2 z omega v with omega = 1, started at (1, 0); stable is what has not
// grown after many steps. A row that is added to a table below adds a test.
//
// Sources of the theory: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), IV.2
// (explicit Runge-Kutta methods); the eigenvalues of the 2 x 2 map of a step for the others.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "started.hpp"

namespace chainreel {
namespace {

struct Damped final : SecondOrder {
  double stiffness = 1, damping = 0;  // omega^2, 2 z omega
  Damped(double stiffness_, double damping_) : stiffness(stiffness_), damping(damping_) {}
  int nq() const override { return 1; }
  int nv() const override { return 1; }
  void acceleration(double, std::span<const double> q, std::span<const double> v,
                    std::span<double> vd) override {
    vd[0] = -stiffness * q[0] - damping * v[0];
  }
};

// A motion that starts with amplitude 1 has grown when it passes this; the Euler methods' own orbits reach
// 1 / sqrt(1 - omega h / 2), 45 at 0.1 % below their limit.
constexpr double kGrown = 1e3;
// An unstable step 0.1 % beyond the limit multiplies by 1 + 1e-3 or more, 1e3 in 7000 steps.
constexpr int kSteps = 20000;

bool grows(const std::string& method, Damped system, double h, double q0, double v0, int steps = kSteps) {
  Started integrator(system, method, 0, 0, q0, v0);
  for (int k = 0; k < steps; ++k) {
    if (integrator->step((k + 1) * h, h) != StepResult::ok) return true;
    if (!(std::abs(integrator.q()) < kGrown && std::abs(integrator.v()) < kGrown)) return true;
  }
  return false;
}

// By halving between a stable and an unstable step, to a part in 10,000.
double limit(const std::string& method, Damped system, double stable, double unstable, double q0 = 1,
             double v0 = 0, int steps = kSteps) {
  EXPECT_FALSE(grows(method, system, stable, q0, v0, steps)) << stable;
  EXPECT_TRUE(grows(method, system, unstable, q0, v0, steps)) << unstable;
  while (unstable - stable > 1e-4 * stable) {
    const double middle = 0.5 * (stable + unstable);
    (grows(method, system, middle, q0, v0, steps) ? unstable : stable) = middle;
  }
  return 0.5 * (stable + unstable);
}

struct StableMethod {
  const char* method;
  double limit;  // of omega h, or of rate times h
  friend void PrintTo(const StableMethod& row, std::ostream* out) { *out << row.method; }
};
std::string name_of(const ::testing::TestParamInfo<StableMethod>& p) {
  return p.param.method;
}

class Undamped : public ::testing::TestWithParam<StableMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, Undamped,
                         ::testing::Values(StableMethod{"semi_implicit_euler", 2}, StableMethod{"symplectic_euler", 2},
                                         StableMethod{"verlet", 2}, StableMethod{"rk4", 2.828427}, StableMethod{"dop853", 5.960360}),
                         name_of);

TEST_P(Undamped, EndsItsStabilityWhereTheorySays) {
  const double expected = GetParam().limit;
  const double measured = limit(GetParam().method, {1, 0}, 0.8 * expected, 1.2 * expected);
  EXPECT_NEAR(measured, expected, 1e-3 * expected);
  // Negative control: a spring twice as stiff has another limit.
  const double stiffer = limit(GetParam().method, {2, 0}, 0.5 * expected, 1.2 * expected);
  EXPECT_NEAR(stiffer, expected / std::sqrt(2), 1e-3 * expected);
}

class RealAxis : public ::testing::TestWithParam<StableMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, RealAxis,
                         ::testing::Values(StableMethod{"explicit_euler", 2}, StableMethod{"rk4", 2.785294},
                                         StableMethod{"dop853", 6.393652}),
                         name_of);

TEST_P(RealAxis, EndsItsStabilityWhereTheorySays) {
  // v' = -v: no spring, so that no other eigenvalue is in the way.
  const double expected = GetParam().limit;
  EXPECT_NEAR(limit(GetParam().method, {0, 1}, 0.8 * expected, 1.2 * expected, 0, 1), expected,
              1e-3 * expected);
}

TEST(ExplicitEuler, IsUnstableAtAnyStepWithoutDamping) {
  // |1 + i h|^n passes a thousand for h = 0.03 after 7.7 / h^2 = 15,000 steps.
  for (const double h : {0.03, 0.1, 1.0}) EXPECT_TRUE(grows("explicit_euler", {1, 0}, h, 1, 0)) << h;
  EXPECT_FALSE(grows("semi_implicit_euler", {1, 0}, 1.0, 1, 0));
}

TEST(ExplicitEuler, IsStableUpToTwiceTheDampingRatio) {
  // Beyond its limit by a part d a step multiplies by 1 + 2 z^2 d only: d = 1e-3 shows in 350,000 steps.
  for (const double z : {0.1, 0.3, 0.7, 1.0}) {
    const double measured = limit("explicit_euler", {1, 2 * z}, 1.6 * z, 2.4 * z, 1, 0, 500000);
    EXPECT_NEAR(measured, 2 * z, 1e-3 * 2 * z) << z;
  }
}

TEST(SemiImplicitEuler, LosesStabilityToADamperSeenBeforeItMoves) {
  for (const double z : {0.01, 0.1, 0.5, 1.0, 2.0}) {
    const double expected = 2 * (std::sqrt(1 + z * z) - z);
    EXPECT_NEAR(limit("semi_implicit_euler", {1, 2 * z}, 0.8 * expected, 1.2 * expected), expected,
                1e-3 * expected)
        << z;
  }
}

TEST(SemiImplicitEuler, KeepsTheEnergyOfAnOscillatorReleasedFromRestWithinItsBounds) {
  for (const double h : {0.01, 0.1, 0.5, 1.1, 1.5}) {
    Oscillator system(1);
    Started integrator(system, "semi_implicit_euler", 0, 0, 1, 0);
    double least = 1, most = 1;
    for (int k = 1; k <= 20000; ++k) {
      integrator->step(k * h, h);
      const double E = integrator.q() * integrator.q() + integrator.v() * integrator.v();
      least = std::min(least, E);
      most = std::max(most, E);
    }
    // The orbit is an ellipse; its bounds hold within round-off of 20,000 steps and are nearly reached, since
    // the steps come around to every part of it (which they would not at h = 1, a sixth of a turn).
    const double low = 1 / (1 + h / 2), high = 1 / (1 - h / 2), round_off = 20000 * 2.3e-16 * high;
    EXPECT_GE(least, low - round_off) << h;
    EXPECT_LE(most, high + round_off) << h;
    EXPECT_LT(least, low + 0.05 * (high - low)) << h;
    EXPECT_GT(most, high - 0.05 * (high - low)) << h;
  }
}

class Implicit : public ::testing::TestWithParam<StableMethod> {};
// What is left of an oscillation after one step at omega h = 1e6: 0 where L-stable, 1 where only A-stable.
INSTANTIATE_TEST_SUITE_P(Methods, Implicit,
                         ::testing::Values(StableMethod{"radau5", 0}, StableMethod{"implicit_midpoint", 1}, StableMethod{"gauss4", 1},
                                         StableMethod{"gauss6", 1}),
                         name_of);

TEST_P(Implicit, IsStableFarBeyondEveryExplicitMethod) {
  for (const double omega : {10.0, 1e3, 1e6}) {
    Oscillator system(omega);
    Started integrator(system, GetParam().method, 0, 0, 1, 0);
    const auto amplitude = [&] { return std::hypot(integrator.q(), integrator.v() / omega); };
    ASSERT_EQ(integrator->step(1, 1), StepResult::ok) << omega;
    // |R(i omega h)| differs from its limit by less than 10 / (omega h).
    EXPECT_NEAR(amplitude(), GetParam().limit, 10 / omega) << omega;
    for (int k = 2; k <= 100; ++k) ASSERT_EQ(integrator->step(k, 1), StepResult::ok) << omega;
    EXPECT_LE(amplitude(), 1 + 1e-9) << omega;
  }
  EXPECT_TRUE(grows("dop853", {100, 0}, 1, 1, 0));  // negative control
}

}  // namespace
}  // namespace chainreel

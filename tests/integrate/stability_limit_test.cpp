#include "integrate/stability_limit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace chainreel {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;

// Limits are found by halving to 1e-10 of themselves, and growth is told from none at 1e-9 and 1e-7: rk4's
// behind its limit is steep, that of semi-implicit Euler a square root, with damping of slope 1 or so.
constexpr double kTolerance = 1e-6;

// q'' = -omega^2 q - 2 z omega q'
LinearMotion oscillator(double omega, double z) {
  return {MatrixXd::Constant(1, 1, -omega * omega), MatrixXd::Constant(1, 1, -2 * z * omega)};
}

double limit(const std::string& method, const LinearMotion& motion) {
  const auto found = stability_limit(find_method(method), motion);
  EXPECT_TRUE(found) << method;
  return found.value_or(NAN);
}

// Whether a state of size 1 has not grown after so many steps of length h, stepped one by one.
bool stays(const std::string& method, const LinearMotion& motion, double h, int steps) {
  const MatrixXd map = step_map(find_method(method), motion, h).value();
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(map.rows(), 0.3, 1);
  for (int k = 0; k < steps; ++k) x = map * x;
  return x.norm() < 1e3;
}

TEST(StabilityLimit, IsTheTheorysForTheFixedSteps) {
  EXPECT_NEAR(limit("semi_implicit_euler", oscillator(1, 0)), 2, kTolerance);
  EXPECT_NEAR(limit("symplectic_euler", oscillator(1, 0)), 2, kTolerance);
  EXPECT_NEAR(limit("verlet", oscillator(1, 0)), 2, kTolerance);
  EXPECT_NEAR(limit("rk4", oscillator(1, 0)), 2 * std::sqrt(2), kTolerance);
  EXPECT_EQ(limit("explicit_euler", oscillator(1, 0)), 0);
  EXPECT_NEAR(limit("rk4", oscillator(10, 0)), 0.2 * std::sqrt(2), kTolerance);
}

TEST(StabilityLimit, FallsWithDampingForSemiImplicitEulerAndRisesForExplicit) {
  for (const double z : {1e-4, 0.05, 0.2, 0.5, 0.9}) {
    EXPECT_NEAR(limit("semi_implicit_euler", oscillator(1, z)), 2 * (std::sqrt(1 + z * z) - z), kTolerance);
    EXPECT_NEAR(limit("explicit_euler", oscillator(1, z)), 2 * z, 10 * kTolerance * z);
  }
}

TEST(StabilityLimit, IsNoneForWhatIsStableAtEveryStep) {
  for (const char* method : {"implicit_midpoint", "gauss4", "gauss6", "radau5"})
    for (const double omega : {10.0, 1e4})
      for (const double z : {0.0, 0.05, 30.0})
        EXPECT_EQ(limit(method, oscillator(omega, z)), HUGE_VAL) << method << " " << omega << " " << z;
  EXPECT_LT(limit("dop853", oscillator(10, 0)), 0.6);  // negative control
}

// k = 100 N/m, 1 kg: rk4's polynomial leaves the real axis at 2.785293563, where 1 + x/2 + x^2/6 + x^3/24 =
// 0.
TEST(StabilityLimit, CountsWhatDecaysWithoutSwinging) {
  for (const double d : {20.0, 30.0, 60.0, 1e3}) {
    const double fastest = d / 2 + std::sqrt(d * d / 4 - 100);
    const LinearMotion slider = oscillator(10, d / 20);
    EXPECT_NEAR(limit("rk4", slider) * fastest, 2.785293563, kTolerance) << d;
    EXPECT_NEAR(limit("explicit_euler", slider) * fastest, 2, kTolerance) << d;
    EXPECT_NEAR(limit("semi_implicit_euler", slider), 0.2 * (std::sqrt(1 + d * d / 400) - d / 20),
                kTolerance * limit("explicit_euler", slider))
        << d;
    // Dampers are implicit in symplectic Euler: x = q_1 / q_0 = -1 where h^2 k = 4 + 2 h d.
    EXPECT_NEAR(limit("symplectic_euler", slider), 0.2 * (std::sqrt(1 + d * d / 400) + d / 20),
                kTolerance * d)
        << d;
  }
  EXPECT_NEAR(limit("rk4", oscillator(10, 1.5)), 0.106, 5e-4);
  EXPECT_NEAR(limit("rk4", oscillator(10, 3.0)), 0.048, 5e-4);
}

// A damper on one of two coupled masses: semi-implicit Euler mixes what the springs and the damper do.
TEST(StabilityLimit, IsThatOfTheWholeStepWhereDampersMixTheModes) {
  LinearMotion motion{Matrix2d{{-200, 100}, {100, -150}}, Matrix2d{{-25, 0}, {0, 0}}};
  for (const char* method : {"semi_implicit_euler", "symplectic_euler", "verlet", "rk4", "dop853"}) {
    const double h = limit(method, motion);
    // Growth of 1e-3 a step or more behind the limit: 1e3 is passed in some 7000 steps.
    EXPECT_TRUE(stays(method, motion, 0.999 * h, 50000)) << method;
    EXPECT_FALSE(stays(method, motion, 1.001 * h, 50000)) << method;
    EXPECT_TRUE(is_stable(find_method(method), motion, 0.999 * h).value());
    EXPECT_FALSE(is_stable(find_method(method), motion, 1.001 * h).value());
  }
}

TEST(StabilityLimit, LosesNoSlowMotionBesideAFastOne) {
  // An undamped swing of 1 rad/s beside a damper of 1e4 /s: explicit Euler is unstable at any step.
  const LinearMotion motion{Matrix2d{{-1, 0}, {0, 0}}, Matrix2d{{0, 0}, {0, -1e4}}};
  EXPECT_EQ(limit("explicit_euler", motion), 0);
  EXPECT_NEAR(limit("rk4", motion), 2.785293563e-4, 1e-9);
  // What turns a velocity aside is no spring: semi-implicit Euler treats it as explicit Euler does.
  const LinearMotion gyroscope{-Matrix2d::Identity(), Matrix2d{{0, 5}, {-5, 0}}};
  EXPECT_EQ(limit("semi_implicit_euler", gyroscope), 0);
  EXPECT_FALSE(stays("semi_implicit_euler", gyroscope, 0.01, 50000));
  EXPECT_TRUE(stays("rk4", gyroscope, 0.01, 50000));
}

TEST(StabilityLimit, LetsGrowWhatGrowsInTheMotionItself) {
  // An inverted pendulum beside a spring.
  const LinearMotion motion{Matrix2d{{4, 0}, {0, -100}}, Matrix2d::Zero()};
  EXPECT_NEAR(limit("semi_implicit_euler", motion), 0.2, kTolerance);
  EXPECT_NEAR(limit("rk4", motion), 0.2 * std::sqrt(2), kTolerance);
  // Alone it also falls back, with exp(-2 t): that part is to stay within bounds.
  EXPECT_NEAR(limit("rk4", {MatrixXd::Constant(1, 1, 4), MatrixXd::Zero(1, 1)}), 2.785293563 / 2, kTolerance);
}

// A slow swing that grows by a hair must not lend its growth to the fast one, which the step breaks first: the limit is that
// of the same motion without it.
TEST(StabilityLimit, LendsTheGrowthOfTheMotionToNothingElse) {
  for (const double growth : {1e-6, 1e-3, 0.1}) {
    const LinearMotion motion{Matrix2d{{-6, 0.5}, {0, -4900}}, Matrix2d{{2 * growth, 0}, {0, -5}}};
    const LinearMotion fast{MatrixXd::Constant(1, 1, -4900), MatrixXd::Constant(1, 1, -5)};
    for (const char* method : {"semi_implicit_euler", "symplectic_euler", "verlet"}) {
      EXPECT_NEAR(limit(method, motion) / limit(method, fast), 1, 1e-3) << method << " " << growth;
      EXPECT_FALSE(is_stable(find_method(method), motion, 3 * limit(method, fast)).value()) << method << " " << growth;
    }
  }
}

TEST(StabilityLimit, IsNotKnownForPointsAndRodsNorWhereNothingMovesByItself) {
  EXPECT_FALSE(stability_limit(find_method("rattle4"), oscillator(1, 0)));
  EXPECT_FALSE(stability_limit(find_method("rk4"), {MatrixXd::Zero(2, 2), MatrixXd::Zero(2, 2)}));
  EXPECT_FALSE(is_stable(find_method("rk4"), {MatrixXd::Zero(2, 2), MatrixXd::Zero(2, 2)}, 0.1));
}

TEST(StabilityLimit, OfTheSeriesIsWhereItsPolynomialGrows) {
  // Of order 20, with a damper alone: terms up to (-x)^20 / 20! of the exponential.
  const auto polynomial = [](double x) {
    double term = 1, sum = 1;
    for (int k = 1; k <= 20; ++k) sum += term *= -x / k;
    return std::abs(sum);
  };
  const double h = limit("taylor", {MatrixXd::Zero(1, 1), MatrixXd::Constant(1, 1, -1)});
  EXPECT_LE(polynomial(0.9999 * h), 1);
  EXPECT_GT(polynomial(1.0001 * h), 1);
}

TEST(RatesOf, AreThoseOfSpringsAndDampers) {
  const auto rates = rates_of({Matrix2d{{-100, 0}, {0, 0}}, Matrix2d{{0, 0}, {0, -7}}});
  ASSERT_EQ(rates.size(), 2u);  // the second mass is free but for its damper
  EXPECT_NEAR(std::abs(rates[0] - std::complex<double>(-7, 0)), 0, 1e-12);
  EXPECT_NEAR(std::abs(rates[1] - std::complex<double>(0, 10)), 0, 1e-12);
}

// Negative control: no method has another's limit.
TEST(StabilityLimit, TellsMethodsApart) {
  EXPECT_GT(std::abs(limit("rk4", oscillator(1, 0)) - limit("semi_implicit_euler", oscillator(1, 0))), 0.5);
  EXPECT_FALSE(*is_stable(find_method("rk4"), oscillator(10, 0), 0.29));
  EXPECT_TRUE(*is_stable(find_method("rk4"), oscillator(10, 0), 0.28));
}

}  // namespace
}  // namespace chainreel

// DoubleDouble against Quad, whose 113 bits leave 9 to judge 104 by.
#include "core/double_double.hpp"

#include <gtest/gtest.h>

#include <quadmath.h>

#include "core/ulps.hpp"

namespace chainreel {
namespace {

using test::Numbers;

// Of an operation, relative: Hida, Li, Bailey prove a few units of 2^-104 for sum, product and quotient.
constexpr double kFewUnits = 0x1p-102;

// Two doubles that do not overlap, the lower one anywhere below.
DoubleDouble random_value(Numbers& numbers) {
  const double hi = numbers.between(-1, 1) * std::ldexp(1.0, int(numbers.below(60)) - 30);
  const Quad lo = Quad(hi) * numbers.between(-0.5, 0.5) * scalbnq(1, -53 - int(numbers.below(20)));
  return DoubleDouble(Quad(hi) + lo);
}

double error_of(const DoubleDouble& x, Quad exact) { return double(fabsq((Quad(x) - exact) / exact)); }

TEST(DoubleDouble, OperationsHaveTwiceTheDigitsOfADouble) {
  Numbers numbers(5);
  double worst_of_doubles = 0;
  for (int i = 0; i < 100000; ++i) {
    const DoubleDouble a = random_value(numbers), b = random_value(numbers);
    ASSERT_LT(error_of(a * b, Quad(a) * Quad(b)), kFewUnits);
    ASSERT_LT(error_of(a / b, Quad(a) / Quad(b)), kFewUnits);
    // Where terms cancel the bound is of the larger one, for Quad too.
    const double scale = std::max(std::abs(double(a)), std::abs(double(b)));
    ASSERT_LT(std::abs(double(Quad(a + b) - (Quad(a) + Quad(b)))), kFewUnits * scale);
    ASSERT_LT(std::abs(double(Quad(a - b) - (Quad(a) - Quad(b)))), kFewUnits * scale);
    worst_of_doubles = std::max(worst_of_doubles, error_of(double(a) * double(b), Quad(a) * Quad(b)));
  }
  EXPECT_GT(worst_of_doubles, 0x1p-54) << "what the bound tells apart";
}

TEST(DoubleDouble, WhatCancelsLeavesItsLowerPart) {
  const DoubleDouble one = 1, near = one + DoubleDouble(0x1p-90);
  EXPECT_EQ(double(near - one), 0x1p-90);
  EXPECT_EQ(double(near) - double(one), 0) << "doubles know nothing of it";
  EXPECT_TRUE(one < near && near > one && near >= one && !(near == one));
}

TEST(DoubleDouble, SineAndCosineToo) {
  Numbers numbers(6);
  for (int i = 0; i < 2000; ++i) {
    const DoubleDouble x = random_value(numbers);
    const SinCos<DoubleDouble> ours = sin_cos(x);
    ASSERT_LT(error_of(ours.s, sinq(Quad(x))), kFewUnits);
    ASSERT_LT(error_of(ours.c, cosq(Quad(x))), kFewUnits);
  }
}

TEST(DoubleDouble, WhatIsNoNumberStaysNone) {
  const DoubleDouble none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(double(none + 1)) && std::isnan(double(none * 2)) && std::isnan(double(DoubleDouble(1) / 0)));
}

}  // namespace
}  // namespace chainreel

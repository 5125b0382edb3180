// What an expression is worth, over each scalar.
#include "expr/expression.hpp"

#include <gtest/gtest.h>
#include <quadmath.h>

#include <bit>
#include <functional>
#include <numbers>
#include <random>

#include "core/format.hpp"
#include "support/allocation_count.hpp"

namespace chainreel {
namespace {

const std::vector<std::string> kExpressionNames = {"t", "q1", "q2", "qd1", "y_G", "k"};

Expression parsed(const std::string& text) {
  return Expression::parse(text, kExpressionNames, {"scene.yaml", 1, 1});
}

double constant_of(const std::string& text) {
  return parsed(text).constant().value();
}

template <class T>
T value_at(const std::string& text, const std::vector<T>& values) {
  return parsed(text).evaluate(std::span<const T>(values));
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(Values, NumbersAreReadAsTheNearestDouble) {
  EXPECT_EQ(constant_of("0"), 0);
  EXPECT_EQ(constant_of("10"), 10);
  EXPECT_EQ(constant_of("0.1"), 0.1);
  EXPECT_EQ(constant_of(".5"), 0.5);
  EXPECT_EQ(constant_of("5."), 5);
  EXPECT_EQ(constant_of("2e-3"), 2e-3);
  EXPECT_EQ(constant_of("2E+3"), 2000);
  EXPECT_EQ(constant_of("5e-324"), 5e-324);
  EXPECT_EQ(constant_of("123456789012345678901234567890"), 123456789012345678901234567890.0);
  EXPECT_NE(constant_of("0.1"), std::nextafter(0.1, 1));
}

TEST(Values, OperatorsBindAsInAlgebra) {
  EXPECT_EQ(constant_of("1+2*3"), 7);
  EXPECT_EQ(constant_of("(1+2)*3"), 9);
  EXPECT_EQ(constant_of("10-4-3"), 3);
  EXPECT_EQ(constant_of("100/10/2"), 5);
  EXPECT_EQ(constant_of("2*3^2"), 18);
  EXPECT_EQ(constant_of("-2^2"), -4);
  EXPECT_EQ(constant_of("(-2)^2"), 4);
  EXPECT_EQ(constant_of("2^-1"), 0.5);
  EXPECT_EQ(constant_of("2^3^2"), 512);
  EXPECT_EQ(constant_of("-2*-3"), 6);
  EXPECT_EQ(constant_of("2--3"), 5);
  EXPECT_EQ(constant_of("+-+2"), -2);
  EXPECT_EQ(constant_of("1+2 < 2*2"), 1);
  EXPECT_EQ(constant_of("  ( ( 7 ) )\n\t"), 7);
}

TEST(Values, ComparisonsAreOneOrZero) {
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{{"1<2", 1},
                                                                               {"2<2", 0},
                                                                               {"2<=2", 1},
                                                                               {"3<=2", 0},
                                                                               {"2>1", 1},
                                                                               {"2>2", 0},
                                                                               {"2>=2", 1},
                                                                               {"1>=2", 0},
                                                                               {"2==2", 1},
                                                                               {"1==2", 0},
                                                                               {"1!=2", 1},
                                                                               {"2!=2", 0}})
    EXPECT_EQ(constant_of(text), value) << text;
  EXPECT_EQ(value_at<double>("(t > 1) * 5 + (t <= 1) * 7", {2, 0, 0, 0, 0, 0}), 5);
  EXPECT_EQ(value_at<double>("(t > 1) * 5 + (t <= 1) * 7", {1, 0, 0, 0, 0, 0}), 7);
}

TEST(Values, FunctionsHaveTheirClosedForms) {
  // One rounding of the argument and one of the result.
  const double tolerance = 4e-16;
  EXPECT_NEAR(constant_of("sin(pi/6)"), 0.5, tolerance);
  EXPECT_NEAR(constant_of("cos(pi/3)"), 0.5, tolerance);
  EXPECT_NEAR(constant_of("tan(pi/4)"), 1, tolerance);
  EXPECT_NEAR(constant_of("exp(1)"), 2.718281828459045, tolerance);
  EXPECT_NEAR(constant_of("log(exp(2))"), 2, tolerance);
  EXPECT_NEAR(constant_of("4 * atan2(1, 1) - pi"), 0, tolerance);
  EXPECT_NEAR(constant_of("atan2(1, -1)"), 2.356194490192345, tolerance);
  EXPECT_EQ(constant_of("sqrt(2.25)"), 1.5);
  EXPECT_EQ(constant_of("abs(-3)"), 3);
  EXPECT_TRUE(std::isnan(constant_of("sign(0/0)"))) << "what is no number has no sign";
  EXPECT_EQ(constant_of("min(2, 1)"), 1);
  EXPECT_EQ(constant_of("max(2, 1)"), 2);
  EXPECT_EQ(constant_of("min(3, 2, 5, 1, 4)"), 1);
  EXPECT_EQ(constant_of("max(3, 2, 5, 1, 4)"), 5);
  EXPECT_EQ(constant_of("min(1, max(2, 3)) + max(min(4, 5), 1, 2)"), 5);
}

// Each a few roundings beside the library's; the cosine keeps its digits near 1, where 1 - x^2 would lose half of them.
TEST(Values, AnglesOfSinesCosinesAndTangents) {
  for (const double x : {-1.0, -0.999999999, -0.5, 0.0, 1e-9, 0.3, 0.9999999999, 1.0}) {
    EXPECT_NEAR(value_at<double>("asin(q1)", {0, x, 0, 0, 0, 0}), std::asin(x), 1e-15) << x;
    EXPECT_NEAR(value_at<double>("acos(q1)", {0, x, 0, 0, 0, 0}), std::acos(x), 1e-15) << x;
    EXPECT_NEAR(value_at<double>("atan(10*q1)", {0, x, 0, 0, 0, 0}), std::atan(10 * x), 1e-15) << x;
  }
  EXPECT_TRUE(std::isnan(constant_of("acos(1.5)")));
  EXPECT_NEAR(constant_of("2*acos(asin(0.5) - 0.1)^2"), 2 * std::pow(std::acos(std::asin(0.5) - 0.1), 2), 1e-14);
  const auto slope = [](const std::string& text) {
    return value_at<Dual<double>>(text, {{0, 0}, {0.3, 1}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}).du;
  };
  EXPECT_NEAR(slope("asin(q1)"), 1 / std::sqrt(1 - 0.09), 1e-15);
  EXPECT_NEAR(slope("acos(q1)"), -1 / std::sqrt(1 - 0.09), 1e-15);
  EXPECT_NEAR(slope("atan(q1)"), 1 / 1.09, 1e-15);
}

// Oracle: the C library; beyond 20 it is 1 to the last digit, and no range is left.
TEST(Expression, HyperbolicTangentAndSign) {
  for (const double x : {-1e300, -800.0, -40.0, -3.0, -0.2, 0.0, 1e-9, 0.5, 2.0, 19.5, 41.0, 360.0, 1e300}) {
    EXPECT_NEAR(value_at<double>("tanh(q1)", {0, x, 0, 0, 0, 0}), std::tanh(x), 3e-16) << x;
    EXPECT_EQ(value_at<double>("sign(q1)", {0, x, 0, 0, 0, 0}), double(x > 0) - double(x < 0)) << x;
  }
  EXPECT_EQ(value_at<double>("2*tanh(sin(q1) - 1) + sign(-q1)", {0, 0.3, 0, 0, 0, 0}), 2 * value_at<double>("tanh(sin(q1) - 1)", {0, 0.3, 0, 0, 0, 0}) - 1);
}

TEST(Values, WhatHasNoValueIsNotANumberOrInfinite) {
  EXPECT_TRUE(std::isnan(constant_of("log(-1)")));
  EXPECT_TRUE(std::isnan(constant_of("sqrt(-1)")));
  EXPECT_TRUE(std::isnan(constant_of("0/0")));
  EXPECT_TRUE(std::isnan(constant_of("(-8)^(1/3)")));
  EXPECT_TRUE(std::isinf(constant_of("1/0")));
  EXPECT_TRUE(std::isnan(constant_of("max(1, log(-1))")));
}

TEST(Values, VariablesAreReadFromTheirSlots) {
  const std::vector<double> values = {1, 2, 3, 5, 7, 11};
  for (std::size_t i = 0; i < kExpressionNames.size(); ++i) EXPECT_EQ(value_at(kExpressionNames[i], values), values[i]);
  EXPECT_EQ(value_at("q2 - q1 * k", values), 3 - 2 * 11);
}

TEST(Values, KnowWhichVariablesTheyUse) {
  EXPECT_EQ(parsed("q2 + q1*q2 - sin(k)").used_variables(), (std::vector<int>{1, 2, 5}));
  EXPECT_FALSE(parsed("0*q1").is_constant());
  EXPECT_EQ(parsed("0*q1").constant(), std::nullopt);
  EXPECT_TRUE(parsed("2*pi").is_constant());
  EXPECT_TRUE(parsed("45deg").is_constant());
  EXPECT_TRUE(parsed("2*pi").used_variables().empty());
  EXPECT_EQ(parsed(" 2 * pi").text(), " 2 * pi");
}

// The same formulas written in C++ over the project's scalars.
struct Twin {
  const char* text;
  std::function<double(double t, double q1, double q2)> formula;
};

const Twin kTwins[] = {
    {"10*sin(2*t)", [](double t, double, double) { return 10 * sine(2 * t); }},
    {"cos(q1)+cos(q1+q2)", [](double, double q1, double q2) { return cosine(q1) + cosine(q1 + q2); }},
    {"tan(q1)*exp(-t^2)", [](double t, double q1, double) { return tangent(q1) * exponential(-(t * t)); }},
    {"log(abs(q1))-sqrt(t)",
     [](double t, double q1, double) { return logarithm(absolute(q1)) - square_root(t); }},
    {"atan2(q1, q2)/pi",
     [](double, double q1, double q2) { return arc_tangent2(q1, q2) / 0x1.921fb54442d18p+1; }},
    {"t^0.3-q1^3", [](double t, double q1, double) { return power(t, 0.3) - q1 * q1 * q1; }},
};

TEST(Values, HaveTheBitsOfTheScalarsOwnFunctions) {
  std::mt19937_64 random(41);
  for (int i = 0; i < 500; ++i) {
    const auto number = [&] { return double(random() >> 11) * 0x1p-50 - 2; };
    const double t = number() + 2, q1 = number(), q2 = number();
    for (const Twin& twin : kTwins)
      ASSERT_TRUE(same_bits(value_at<double>(twin.text, {t, q1, q2, 0, 0, 0}), twin.formula(t, q1, q2)))
          << twin.text << " at " << t << ", " << q1 << ", " << q2;
  }
  // In another order of operations the bits differ, and that is seen.
  EXPECT_FALSE(same_bits(value_at<double>("(t + q1) + q2", {0.1, 0.2, 0.3, 0, 0, 0}), 0.1 + (0.2 + 0.3)));
}

// 45deg is a number, which binds closer than any operator, with the bits that an angle of a scene has.
TEST(Values, DegreesBelongToTheNumberBeforeThem) {
  const double degree = std::numbers::pi / 180;
  for (const double angle : {45.0, 0.1, 7.0, 1e-3, 359.99}) EXPECT_TRUE(same_bits(constant_of(format_shortest(angle) + "deg"), angle * degree)) << angle;
  EXPECT_TRUE(same_bits(constant_of("90/2deg"), 90 / (2 * degree)));
  EXPECT_TRUE(same_bits(constant_of("-45\u00b0"), -(45 * degree)));
  EXPECT_TRUE(same_bits(constant_of("1e2deg+.5deg"), 100 * degree + 0.5 * degree));
  // As deep as text may nest, and there the stack holds what it needs.
  const std::string deep = std::string(200, '(') + "45deg" + std::string(200, ')');
  EXPECT_TRUE(same_bits(constant_of(deep), 45 * degree));
  const std::vector<Quad> values(6, 0);
  EXPECT_LT(fabsq(value_at("sin(30deg)", values) - 0.5Q), 0x1p-110Q);
}

TEST(Values, OverQuadAreExactToQuadsDigits) {
  const std::vector<Quad> values = {0.3Q, 1, 2, 0, 0, 0};
  EXPECT_LT(fabsq(value_at("sin(pi/6)", values) - 0.5Q), 0x1p-110Q);
  EXPECT_LT(fabsq(value_at("exp(t)*exp(-t)", values) - 1), 0x1p-110Q);
  EXPECT_LT(fabsq(value_at("t/3", values) - 0.1Q), 0x1p-114Q);
  // A number stays the double that a scene means by it.
  EXPECT_TRUE(value_at("0.1", values) == Quad(0.1));
  EXPECT_FALSE(value_at("0.1", values) == 0.1Q);
}

TEST(Values, OverDualCarryTheDerivative) {
  using D = Dual<double>;
  const double t = 0.7, q = 1.3;
  const std::vector<D> values = {{t, 1}, {q, 0}, 0, 0, 0, 0};
  const double s = std::sin(q * t), c = std::cos(q * t);
  const double tolerance = 4e-15;  // ten roundings of numbers below 5
  EXPECT_NEAR(value_at("sin(q1*t)", values).du, q * c, tolerance);
  EXPECT_NEAR(value_at("cos(q1*t)^2", values).du, -2 * q * c * s, tolerance);
  EXPECT_NEAR(value_at("t^3", values).du, 3 * t * t, tolerance);
  EXPECT_NEAR(value_at("q1^t", values).du, std::pow(q, t) * std::log(q), tolerance);
  EXPECT_NEAR(value_at("exp(-t)/t", values).du, -std::exp(-t) * (1 / t + 1 / (t * t)), tolerance);
  EXPECT_NEAR(value_at("atan2(t, q1)", values).du, q / (t * t + q * q), tolerance);
  EXPECT_NEAR(value_at("max(t, q1) - min(t, q1)", values).du, -1, tolerance);
  EXPECT_EQ(value_at("(t > 0.5) + pi + 3", values).du, 0);
  EXPECT_GT(std::fabs(value_at("sin(q1*t)", values).du - 1.001 * q * c), tolerance);
}

TEST(Values, OverNestedDualCarryTheSecondDerivative) {
  using DD = Dual<Dual<double>>;
  const DD t({0.7, 1}, {1, 0});
  EXPECT_NEAR(value_at<DD>("sin(t)*t", {t, 0, 0, 0, 0, 0}).du.du, 2 * std::cos(0.7) - 0.7 * std::sin(0.7),
              1e-15);
  using DQ = Dual<Quad>;
  EXPECT_LT(fabsq(value_at<DQ>("t^5", {{2, 1}, 0, 0, 0, 0, 0}).du - 80), 1e-30Q);
}

TEST(Values, EvaluationAllocatesNothing) {
  std::string deep = "t";
  for (int i = 0; i < 150; ++i) deep = "1+(" + deep + ")";
  const std::vector<double> values(kExpressionNames.size(), 0.5);
  for (const std::string& text : {std::string("k*(1-q1)-2*sqrt(k)*qd1"), deep}) {
    const Expression expression = parsed(text);
    const long before = allocation_count();
    double sum = 0;
    for (int i = 0; i < 100; ++i) sum += expression.evaluate(std::span<const double>(values));
    EXPECT_EQ(allocation_count(), before) << text;
    EXPECT_TRUE(std::isfinite(sum));
  }
  const long before = allocation_count();
  parsed(deep);
  EXPECT_GT(allocation_count(), before) << "parsing does allocate: the counter counts";
}

}  // namespace
}  // namespace chainreel

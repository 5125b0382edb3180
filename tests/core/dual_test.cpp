// Derivatives by Dual against central differences in Quad: with a step of 1e-10 those err by some 1e-20 by
// truncation and 1e-24 by rounding, far below the round-off of the double they are compared with.
#include <gtest/gtest.h>

#include <functional>

#include "core/ulps.hpp"

namespace chainreel {
namespace {

using test::Numbers;

// Every function and operator, each as a template over the scalar.
template <class T>
const std::vector<std::pair<const char*, std::function<T(T, T)>>>& functions() {
  static const std::vector<std::pair<const char*, std::function<T(T, T)>>> list = {
      {"sum", [](T x, T y) { return x + 2 * y; }},
      {"difference", [](T x, T y) { return x * 3 - y; }},
      {"product", [](T x, T y) { return x * y * x; }},
      {"quotient", [](T x, T y) { return x / (y * y + 1); }},
      {"sin", [](T x, T y) { return sine(x * y); }},
      {"cos", [](T x, T y) { return cosine(x * y); }},
      {"sin and cos", [](T x, T y) { return sin_cos(x + y).s * sin_cos(x - y).c; }},
      {"tan", [](T x, T y) { return tangent(x * y / 9); }},
      {"exp", [](T x, T y) { return exponential(-x * y); }},
      {"log", [](T x, T y) { return logarithm(x + y * y); }},
      {"sqrt", [](T x, T y) { return square_root(x * y + 1); }},
      {"atan2", [](T x, T y) { return arc_tangent2(x - 2 * y, y - x); }},
      {"pow with constant exponent", [](T x, T y) { return power(x, T(2.5)) + power(y, T(-2)); }},
      {"square, cube", [](T x, T y) { return power(-x, T(3)) + power(y, T(2)); }},
      {"pow with constant base", [](T x, T y) { return power(T(1.7), x * y); }},
      {"pow", [](T x, T y) { return power(x, y); }},
      {"abs", [](T x, T y) { return absolute(x - y) + absolute(y); }},
      {"min", [](T x, T y) { return minimum(x * x, y); }},
      {"max", [](T x, T y) { return maximum(x * x, y); }},
  };
  return list;
}

Quad central_difference(const std::function<Quad(Quad, Quad)>& f, Quad x, Quad y, Quad x_rate, Quad y_rate) {
  const Quad step = 1e-10Q;
  return (f(x + step * x_rate, y + step * y_rate) - f(x - step * x_rate, y - step * y_rate)) / (2 * step);
}

// Round-off: a dozen operations on terms up to 10^3 times the result's scale of 1.
constexpr double kRoundOff = 1e-12;

double scaled_error(double value, Quad truth) {
  return std::fabs(double(value - truth)) / (1 + std::fabs(double(truth)));
}

TEST(Dual, DerivativesAreThoseOfCentralDifferences) {
  Numbers numbers(21);
  for (std::size_t i = 0; i < functions<Quad>().size(); ++i) {
    const auto& [name, f] = functions<Dual<double>>()[i];
    for (int trial = 0; trial < 50; ++trial) {
      const double x = numbers.between(0.2, 3), y = numbers.between(0.2, 3);
      const double x_rate = numbers.between(-1, 1), y_rate = numbers.between(-1, 1);
      const Quad truth = central_difference(functions<Quad>()[i].second, x, y, x_rate, y_rate);
      EXPECT_LT(scaled_error(f({x, x_rate}, {y, y_rate}).du, truth), kRoundOff) << name;
    }
  }
}

TEST(Dual, ADifferentDirectionGivesADifferentDerivative) {
  for (std::size_t i = 0; i < functions<Quad>().size(); ++i) {
    const Quad truth = central_difference(functions<Quad>()[i].second, 1.3, 0.7, 1, 0.5);
    const auto& [name, f] = functions<Dual<double>>()[i];
    EXPECT_GT(scaled_error(f({1.3, 1.01}, {0.7, 0.51}).du, truth), kRoundOff) << name;
  }
}

TEST(Dual, ValuesAreThoseOfTheScalarToTheBit) {
  for (std::size_t i = 0; i < functions<double>().size(); ++i) {
    const auto& [name, f] = functions<double>()[i];
    const Dual<double> dual = functions<Dual<double>>()[i].second({1.3, 1}, {0.7, -2});
    EXPECT_TRUE(test::same_bits(dual.re, f(1.3, 0.7))) << name;
  }
}

// d/de of d/dx, inner direction (1, 0), outer (0, 1): the mixed second derivative.
TEST(Dual, NestsToMixedSecondDerivatives) {
  using Second = Dual<Dual<double>>;
  for (std::size_t i = 0; i < functions<Quad>().size(); ++i) {
    const auto& f = functions<Quad>()[i].second;
    const auto slope = [&](Quad, Quad y) { return central_difference(f, 1.3, y, 1, 0); };
    const Quad step = 1e-8Q;  // the inner quotient carries a rounding error of 1e-23, here divided by 1e-8
    const Quad truth = (slope(0, 0.7 + step) - slope(0, 0.7 - step)) / (2 * step);
    const Second x{{1.3, 1}, {0, 0}}, y{{0.7, 0}, {1, 0}};
    const Second result = functions<Second>()[i].second(x, y);
    EXPECT_LT(scaled_error(result.du.du, truth), kRoundOff) << functions<Second>()[i].first;
  }
}

TEST(Dual, WorksOverQuad) {
  const Dual<Quad> result = sine(Dual<Quad>(2, 3));
  EXPECT_LT(fabsq(result.du - 3 * cosq(2)), 0x1p-110Q);
  EXPECT_LT(fabsq((Dual<Quad>(0.1Q) - Quad(0.1)).re), 1e-17Q);
  EXPECT_NE((Dual<Quad>(0.1Q) - 0.1).re, 0);
}

TEST(Dual, FunctionsOfConstantsAreConstantAlsoWhereTheSlopeIsInfinite) {
  using D = Dual<double>;
  EXPECT_EQ(square_root(D(0)).du, 0);
  EXPECT_EQ(square_root(D(0, 1)).du, std::numeric_limits<double>::infinity());
  EXPECT_EQ(logarithm(D(0)).du, 0);
  EXPECT_EQ(power(D(0), D(0.5)).du, 0);
  EXPECT_EQ(arc_tangent2(D(0), D(0)).du, 0);
}

TEST(Dual, PowersOfZeroAndOfNegativeNumbersHaveTheirDerivatives) {
  using D = Dual<double>;
  EXPECT_EQ(power(D(0, 1), D(0)).du, 0);
  EXPECT_EQ(power(D(0, 1), D(1)).du, 1);
  EXPECT_EQ(power(D(0, 1), D(2)).du, 0);
  EXPECT_EQ(power(D(-3, 1), D(2)).du, -6);
  EXPECT_EQ(power(D(-2, 1), D(3)).du, 12);
}

TEST(Dual, ComparisonsLookAtTheValueAlone) {
  using D = Dual<double>;
  EXPECT_TRUE(D(1, 5) == D(1, 7));
  EXPECT_FALSE(D(1, 5) != 1);
  EXPECT_TRUE(D(1, 5) < D(2, 0));
  EXPECT_TRUE(D(1, 5) <= 1 && D(1, 5) >= 1);
  EXPECT_TRUE(2 > D(1, 5));
  EXPECT_EQ(value_of(Dual<D>(D(4, 5), D(6, 7))), 4);
}

TEST(Dual, CompoundAssignmentsAreTheirOperators) {
  Dual<double> a(3, 1);
  a += 1;
  a *= a;
  a -= {6, 2};
  a /= 2;
  EXPECT_EQ(a.re, 5);
  EXPECT_EQ(a.du, 3);
}

// A Quad would lose digits in silence.
static_assert(std::is_convertible_v<double, Dual<double>> && std::is_convertible_v<int, Dual<Dual<double>>>);
static_assert(std::is_convertible_v<Quad, Dual<Quad>> && std::is_convertible_v<double, Dual<Quad>>);
static_assert(!std::is_convertible_v<Quad, Dual<double>> && !std::is_convertible_v<Quad, Dual<Dual<double>>>);
static_assert(!std::is_convertible_v<Dual<double>, double>);

}  // namespace
}  // namespace chainreel

#include "integrate/implicit_equation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace chainreel {
namespace {

constexpr std::array<double, 2> kWeight{1, 1};
constexpr double kEquationRoundOff = 0x1p-52;

TEST(ImplicitEquation, SolvesAContractionByRepetition) {
  ImplicitEquation equation(2);
  std::array<double, 2> x{0, 0};
  const auto g = [](std::span<const double> at, std::span<double> next) {
    next[0] = 0.3 * std::cos(at[1]);
    next[1] = 0.3 * std::sin(at[0]) + 0.1;
  };
  ASSERT_TRUE(equation.solve(g, kWeight, x));
  EXPECT_FALSE(equation.is_steep());
  std::array<double, 2> again;
  g(x, again);
  EXPECT_NEAR(again[0], x[0], kEquationRoundOff);
  EXPECT_NEAR(again[1], x[1], kEquationRoundOff);
}

TEST(ImplicitEquation, SolvesASteepOneByNewton) {
  // x = 1 - s y - s x^2, y = s x: g' is of size s, far from a contraction.
  for (const double s : {3.0, 1e3, 1e6}) {
    ImplicitEquation equation(2);
    std::array<double, 2> x{0, 0};
    const auto g = [s](std::span<const double> at, std::span<double> next) {
      next[0] = 1 - s * at[1] - s * at[0] * at[0];
      next[1] = s * at[0];
    };
    ASSERT_TRUE(equation.solve(g, kWeight, x)) << s;
    EXPECT_TRUE(equation.is_steep());
    // x (1 + s^2 + s x) = 1
    EXPECT_NEAR(x[0] * (1 + s * s + s * x[0]), 1, 10 * kEquationRoundOff) << s;
    EXPECT_NEAR(x[1] / (s * x[0]), 1, 10 * kEquationRoundOff) << s;
  }
}

TEST(ImplicitEquation, SaysWhereThereIsNoSolution) {
  ImplicitEquation equation(1);
  std::array<double, 1> x{0.3}, weight{1};
  const auto g = [](std::span<const double> at, std::span<double> next) {
    next[0] = at[0] + 1 + at[0] * at[0];  // x = g(x) has complex solutions only
  };
  EXPECT_FALSE(equation.solve(g, weight, x));
  const auto nothing = [](std::span<const double>, std::span<double> next) { next[0] = std::nan(""); };
  equation.forget();
  EXPECT_FALSE(equation.solve(nothing, weight, x));
}

TEST(ImplicitEquation, ForgetsThatItWasSteep) {
  ImplicitEquation equation(1);
  std::array<double, 1> x{0}, weight{1};
  const auto steep = [](std::span<const double> at, std::span<double> next) { next[0] = 1 - 5 * at[0]; };
  const auto mild = [](std::span<const double> at, std::span<double> next) { next[0] = 1 - 0.5 * at[0]; };
  ASSERT_TRUE(equation.solve(steep, weight, x));
  EXPECT_NEAR(x[0], 1.0 / 6, kEquationRoundOff);
  // Newton's matrix is another equation's: it is found anew where it does not serve.
  ASSERT_TRUE(equation.solve(mild, weight, x));
  EXPECT_NEAR(x[0], 2.0 / 3, 4 * kEquationRoundOff);
  EXPECT_TRUE(equation.is_steep());
  equation.forget();
  ASSERT_TRUE(equation.solve(mild, weight, x));
  EXPECT_FALSE(equation.is_steep());
}

}  // namespace
}  // namespace chainreel

// tan, exp, log, atan2 and pow: against libquadmath where it is smooth, against the C standard's table (F.10)
// at the ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "core/ulps.hpp"

namespace chainreel {
namespace {

using test::error_in_ulps;
using test::Numbers;
using test::same_bits;

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Half an ulp of the last rounding; a tenth for what a pair of doubles and a series leave.
constexpr double kOneRounding = 0.65;
// A result below 2^-1022 is rounded a second time.
constexpr double kTwoRoundings = 1.0;

struct Case {
  const char* name;
  double (*ours)(double, double);
  Quad (*oracle)(Quad, Quad);
  std::function<std::array<double, 2>(Numbers&)> arguments;
  double bound;
};

double exp_of(double x, double) {
  return exponential(x);
}
Quad exp_oracle(Quad x, Quad) {
  return expq(x);
}
double log_of(double x, double) {
  return logarithm(x);
}
Quad log_oracle(Quad x, Quad) {
  return logq(x);
}
double tan_of(double x, double) {
  return tangent(x);
}
Quad tan_oracle(Quad x, Quad) {
  return tanq(x);
}

const Case kCases[] = {
    {"exp", exp_of, exp_oracle,
     [](Numbers& n) {
       return std::array{n.between(-40, 40), 0.0};
     },
     kOneRounding},
    {"exp near 0", exp_of, exp_oracle,
     [](Numbers& n) {
       return std::array{n.between(-1e-8, 1e-8), 0.0};
     },
     kOneRounding},
    {"exp over its range", exp_of, exp_oracle,
     [](Numbers& n) {
       return std::array{n.between(-750, 712), 0.0};
     },
     kTwoRoundings},
    {"log over its range", log_of, log_oracle,
     [](Numbers& n) {
       return std::array{std::fabs(n.any()), 0.0};
     },
     kOneRounding},
    {"log near 1", log_of, log_oracle,
     [](Numbers& n) {
       return std::array{1 + n.between(-0.5, 0.5) * n.between(0, 1), 0.0};
     },
     kOneRounding},
    // Two tails, each with the rounding of a term a tenth as large as its function.
    {"tan", tan_of, tan_oracle,
     [](Numbers& n) {
       return std::array{n.between(-20, 20), 0.0};
     },
     kTwoRoundings},
    {"tan over its range", tan_of, tan_oracle,
     [](Numbers& n) {
       return std::array{n.any(), 0.0};
     },
     kTwoRoundings},
    {"atan2", arc_tangent2, atan2q,
     [](Numbers& n) {
       return std::array{n.between(-2, 2), n.between(-2, 2)};
     },
     kOneRounding},
    {"atan2 over its range", arc_tangent2, atan2q,
     [](Numbers& n) {
       return std::array{n.any(), n.any()};
     },
     kOneRounding},
    {"atan2 of like exponents", arc_tangent2, atan2q,
     [](Numbers& n) {
       const double y = n.any();
       return std::array{y, y * n.between(-9, 9)};
     },
     kOneRounding},
    {"pow", power, powq,
     [](Numbers& n) {
       return std::array{n.between(0, 10), n.between(-9, 9)};
     },
     kOneRounding},
    {"pow near overflow", power, powq,
     [](Numbers& n) {
       const double x = std::fabs(n.any());
       return std::array{x, double(n.between(-720, 720) / logq(x))};
     },
     kTwoRoundings},
    {"pow of negative numbers", power, powq,
     [](Numbers& n) {
       return std::array{n.between(-9, 0), double(n.below(60)) - 25};
     },
     2.0},  // exponents 3 and 4 multiply: up to 1.5
};

TEST(ElementaryFunctions, AreWithinTheirErrorOverTheirWholeRange) {
  for (const Case& c : kCases) {
    Numbers numbers(11);
    double worst = 0;
    for (int i = 0; i < 40000; ++i) {
      const auto [x, y] = c.arguments(numbers);
      const double error = error_in_ulps(c.ours(x, y), c.oracle(x, y));
      ASSERT_LT(error, c.bound) << c.name << std::hexfloat << " of " << x << ", " << y;
      worst = std::max(worst, error);
    }
    EXPECT_GT(worst, 0.45) << c.name << ": random arguments must come near half an ulp, or nothing was tried";
  }
}

TEST(ElementaryFunctions, ResultsAFewUlpsOffAreSeen) {
  for (const Case& c : kCases) {
    Numbers numbers(12);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto [x, y] = c.arguments(numbers);
      worst = std::max(worst, error_in_ulps(c.ours(x, y) * (1 + 0x1p-50), c.oracle(x, y)));
    }
    EXPECT_GT(worst, 2 * c.bound) << c.name;
  }
}

TEST(ElementaryFunctions, ExponentialEndsInZeroAndInfinity) {
  EXPECT_EQ(exponential(0.0), 1);
  EXPECT_EQ(exponential(-0.0), 1);
  EXPECT_EQ(exponential(-kEndless), 0);
  EXPECT_EQ(exponential(kEndless), kEndless);
  EXPECT_TRUE(std::isnan(exponential(kNaN)));
  EXPECT_TRUE(std::isfinite(exponential(0x1.62e42fefa39efp+9)));
  EXPECT_EQ(exponential(0x1.62e42fefa39f0p+9), kEndless);
  EXPECT_EQ(exponential(-745.13), 5e-324);
  EXPECT_EQ(exponential(-745.14), 0);
}

TEST(ElementaryFunctions, LogarithmHasAPoleAndADomain) {
  EXPECT_TRUE(same_bits(logarithm(1.0), 0.0));
  EXPECT_EQ(logarithm(0.0), -kEndless);
  EXPECT_EQ(logarithm(-0.0), -kEndless);
  EXPECT_EQ(logarithm(kEndless), kEndless);
  EXPECT_TRUE(std::isnan(logarithm(-1.0)));
  EXPECT_TRUE(std::isnan(logarithm(-kEndless)));
  EXPECT_TRUE(std::isnan(logarithm(kNaN)));
  EXPECT_LT(error_in_ulps(logarithm(5e-324), logq(5e-324)), kOneRounding);
}

TEST(ElementaryFunctions, TangentOfInfinityIsNotANumber) {
  EXPECT_TRUE(std::isnan(tangent(kEndless)));
  EXPECT_TRUE(std::isnan(tangent(kNaN)));
  EXPECT_TRUE(same_bits(tangent(-0.0), -0.0));
  EXPECT_EQ(tangent(5e-324), 5e-324);
  EXPECT_LT(error_in_ulps(tangent(double(M_PI_2q)), tanq(double(M_PI_2q))), kTwoRoundings);
}

TEST(ElementaryFunctions, SquareRootOfANegativeNumberIsNotANumber) {
  EXPECT_EQ(square_root(2.25), 1.5);
  EXPECT_TRUE(std::isnan(square_root(-1.0)));
}

// Every pair of special values must give what the C library's function gives, to the bit where that is 0,
// infinite or NaN.
constexpr double kSpecial[] = {0.0,  -0.0,        1,           -1,         2,      -2,        0.5,
                               -0.5, 3,           -3,          7,          -7,     1e308,     1e20,
                               1e-9, -1e308,      5e-324,      -5e-324,    1e-310, kEndless, -kEndless,
                               kNaN, 1 - 0x1p-53, 1 + 0x1p-52, 0x1p53 + 2, -0x1p53};

void expect_like(double ours, double theirs, const char* name, double a, double b) {
  const bool plain = std::isfinite(theirs) && theirs != 0;
  EXPECT_TRUE(plain ? error_in_ulps(ours, theirs) <= 2 : same_bits(ours, theirs))
      << name << "(" << a << ", " << b << ") is " << ours << ", not " << theirs;
}

TEST(ElementaryFunctions, PowerFollowsTheCStandardAtSpecialValues) {
  for (double x : kSpecial)
    for (double y : kSpecial) expect_like(power(x, y), std::pow(x, y), "pow", x, y);
}

TEST(ElementaryFunctions, ArcTangentFollowsTheCStandardAtSpecialValues) {
  for (double y : kSpecial)
    for (double x : kSpecial) expect_like(arc_tangent2(y, x), std::atan2(y, x), "atan2", y, x);
}

TEST(ElementaryFunctions, SmallPowersAreTheirProductsToTheBit) {
  Numbers numbers(13);
  for (int i = 0; i < 1000; ++i) {
    const double x = i % 2 == 0 ? numbers.between(-9, 9) : numbers.any();
    const double square = x * x;
    EXPECT_TRUE(same_bits(power(x, -1), 1 / x));
    EXPECT_TRUE(same_bits(power(x, 0), 1));
    EXPECT_TRUE(same_bits(power(x, 1), x));
    EXPECT_TRUE(same_bits(power(x, 2), square));
    EXPECT_TRUE(same_bits(power(x, 3), square * x));
    EXPECT_TRUE(same_bits(power(x, 4), square * square));
  }
}

TEST(ElementaryFunctions, MinimumAndMaximumPassNaNOn) {
  EXPECT_EQ(minimum(2.0, -1.0), -1);
  EXPECT_EQ(maximum(2.0, -1.0), 2);
  EXPECT_TRUE(std::isnan(minimum(kNaN, 1.0)));
  EXPECT_TRUE(std::isnan(minimum(1.0, kNaN)));
  EXPECT_TRUE(std::isnan(maximum(kNaN, 1.0)));
  EXPECT_TRUE(std::isnan(maximum(1.0, kNaN)));
}

}  // namespace
}  // namespace chainreel

// sin and cos against libquadmath, whose 113 bits leave 60 to judge a double by.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/hash.hpp"
#include "core/ulps.hpp"

namespace chainreel {
namespace {

using test::error_in_ulps;
using test::Numbers;
using test::same_bits;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double sin_cos_error(double x) {
  Quad s, c;
  sincosq(x, &s, &c);
  const SinCos<double> ours = sin_cos(x);
  return std::max(error_in_ulps(ours.s, s), error_in_ulps(ours.c, c));
}

// Half an ulp of the last rounding, and what the polynomial's last terms and their rounding add where |r|
// nears pi/4.
constexpr double kBound = 0.85;

TEST(SinCos, OrdinaryAnglesAreWithinOneUlp) {
  Numbers numbers(1);
  for (int i = 0; i < 200000; ++i) {
    const double x = numbers.between(-20, 20);
    ASSERT_LT(sin_cos_error(x), kBound) << std::hexfloat << x;
  }
}

TEST(SinCos, AnglesOfManyTurnsAreWithinOneUlp) {
  Numbers numbers(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = numbers.between(-0x1p21, 0x1p21);  // half of them beyond the fast reduction
    ASSERT_LT(sin_cos_error(x), kBound) << std::hexfloat << x;
  }
}

TEST(SinCos, NeighboursOfMultiplesOfAQuarterTurnAreWithinOneUlp) {
  Numbers numbers(3);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t k = numbers.below(i % 2 == 0 ? 64 : 4000000);
    double x = double(Quad(k) * M_PI_2q);
    for (int neighbour = 0; neighbour < 4; ++neighbour, x = std::nextafter(x, kInfinity)) {
      ASSERT_LT(sin_cos_error(x), kBound) << std::hexfloat << x;
      ASSERT_LT(sin_cos_error(-x), kBound) << std::hexfloat << -x;
    }
  }
}

// The double that comes nearest to a multiple of pi/2, W. Kahan, Minimizing q*m-n (1983).
TEST(SinCos, TheWorstCancellationOfAllDoublesIsWithinOneUlp) {
  EXPECT_LT(sin_cos_error(0x1.6ac5b262ca1ffp+849), kBound);
  EXPECT_LT(std::fabs(cosine(0x1.6ac5b262ca1ffp+849)), 0x1p-60);
}

TEST(SinCos, HugeAndTinyAnglesAreWithinOneUlp) {
  Numbers numbers(4);
  for (int i = 0; i < 100000; ++i) {
    const double x = numbers.any();
    ASSERT_LT(sin_cos_error(x), kBound) << std::hexfloat << x;
  }
  for (double x : {1e15, 1e22, std::numeric_limits<double>::max(), 5e-324, 1e-310, 0x1p-27, 0x1p20})
    EXPECT_LT(sin_cos_error(x), kBound) << x;
}

TEST(SinCos, TheirErrorBoundIsNotMetByResultsOneUlpOff) {
  const double x = 0.7;
  EXPECT_LT(error_in_ulps(sine(x), sinq(x)), kBound);
  EXPECT_GT(error_in_ulps(std::nextafter(std::nextafter(sine(x), 1), 1), sinq(x)), kBound);
  EXPECT_GT(error_in_ulps(sine(std::nextafter(std::nextafter(0.1, 1), 1)), sinq(0.1)), kBound);
}

TEST(SinCos, BothReductionsGiveTheSameAngle) {
  Numbers numbers(5);
  for (int i = 0; i < 50000; ++i) {
    const double x = numbers.between(1, 0x1p20);
    detail::ReducedAngle fast;
    ASSERT_TRUE(detail::reduce(x, fast)) << std::hexfloat << x;
    const detail::ReducedAngle slow = detail::reduce_with_many_digits(x);
    // At the seams, odd multiples of pi/4, either neighbour is right.
    const auto turns = static_cast<std::int64_t>(fast.quadrant - slow.quadrant) << 62 >> 62;
    const Quad difference =
        (Quad(fast.r) + fast.r_tail) - (Quad(slow.r) + slow.r_tail) + Quad(turns) * M_PI_2q;
    // A tail is a double beside an r below 1: 2^-53 2^-53, and the fast one omits k 2^-118.
    ASSERT_LT(double(fabsq(difference)), 0x1p-97) << std::hexfloat << x;
    ASSERT_LT(std::fabs(fast.r), 0.7854) << std::hexfloat << x;
    ASSERT_LT(std::fabs(slow.r), 0.7854) << std::hexfloat << x;
  }
}

TEST(SinCos, SineIsOddAndCosineIsEvenToTheBit) {
  Numbers numbers(6);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? numbers.between(0, 100) : std::fabs(numbers.any());
    ASSERT_TRUE(same_bits(sine(-x), -sine(x))) << x;
    ASSERT_TRUE(same_bits(cosine(-x), cosine(x))) << x;
  }
}

TEST(SinCos, ZeroKeepsItsSign) {
  EXPECT_TRUE(same_bits(sine(0.0), 0.0));
  EXPECT_TRUE(same_bits(sine(-0.0), -0.0));
  EXPECT_EQ(cosine(-0.0), 1.0);
}

TEST(SinCos, InfinityAndNaNGiveNaN) {
  for (double x : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(sine(x)));
    EXPECT_TRUE(std::isnan(cosine(x)));
  }
}

// Recorded, because only a run on another processor can fail it: same bits on every machine.
std::string hash_of_results(double first) {
  Sha256 hash;
  Numbers numbers(7);
  for (int i = 0; i < 20000; ++i) {
    const double x = i == 0 ? first : i % 3 == 0 ? numbers.any() : numbers.between(-30, 30);
    const double y = numbers.between(-30, 30);
    const SinCos<double> angle = sin_cos(x);
    hash.add(std::array{angle.s, angle.c, tangent(x), exponential(y), logarithm(std::fabs(x)),
                        arc_tangent2(x, y), power(std::fabs(x), y / 100), square_root(std::fabs(y))});
  }
  return hash.finish();
}

TEST(Scalars, BitsOfAllFunctionsAreTheRecordedOnes) {
  EXPECT_EQ(hash_of_results(1.0), "9478f7f9f464c0e1bc1c3b6f9924209b2a0f0f4e6d76fc4a5286f46a2f0b6edf");
  EXPECT_NE(hash_of_results(std::nextafter(1.0, 2.0)), hash_of_results(1.0));
}

TEST(QuadScalars, AgreeWithDoubleAndAreFarMoreExact) {
  Numbers numbers(8);
  for (int i = 0; i < 200; ++i) {
    const double x = numbers.between(0.1, 9), y = numbers.between(-5, 5);
    const SinCos<Quad> angle = sin_cos(Quad(x));
    // libquadmath's functions err by an ulp, 2^-112, or two.
    EXPECT_LT(fabsq(angle.s * angle.s + angle.c * angle.c - 1), 0x1p-109Q);
    EXPECT_LT(fabsq(tangent(Quad(x)) * angle.c - angle.s), 0x1p-109Q);
    EXPECT_LT(fabsq(exponential(logarithm(Quad(x))) - x), 0x1p-104Q);
    EXPECT_LT(fabsq(square_root(Quad(x)) * square_root(Quad(x)) - x), 0x1p-108Q);
    EXPECT_LT(fabsq(power(Quad(x), Quad(y)) / exponential(y * logarithm(Quad(x))) - 1), 0x1p-106Q);
    EXPECT_LT(fabsq(sine(arc_tangent2(Quad(y), Quad(x))) * hypotq(x, y) - y), 0x1p-107Q);
    EXPECT_LT(error_in_ulps(sine(x), sine(Quad(x))), 1);
    EXPECT_LT(error_in_ulps(power(x, y), power(Quad(x), Quad(y))), 1);
  }
  EXPECT_EQ(value_of(absolute(Quad(-2.5))), 2.5);
  EXPECT_EQ(power(Quad(3), Quad(-1)), 1 / Quad(3));
  // What a double holds of sin(1) is not sin(1) in Quad.
  EXPECT_NE(sine(Quad(1)), Quad(sine(1.0)));
}

}  // namespace
}  // namespace chainreel

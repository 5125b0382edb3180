// The rare angles of sin_cos, and the functions of Quad.
//
// M. Payne, R. Hanek, Radian reduction for trigonometric functions, SIGNUM Newsletter 18 (1983): x = m 2^e
// with an integer m. Bits of 2/pi whose product with x is a multiple of 4 change no quadrant and are skipped;
// the next 192 bits times m, as an integer, hold the quadrant and its fraction to far below an ulp however
// closely x meets a multiple.
#include "core/scalar.hpp"

#include <quadmath.h>

#include <algorithm>
#include <array>
#include <limits>

namespace chainreel {
namespace {

using Word = std::uint64_t;
__extension__ using DoubleWord = unsigned __int128;
__extension__ using SignedDoubleWord = __int128;

// The binary digits of 2/pi behind the point; the largest double needs the first 1161.
constexpr std::array<Word, 19> kTwoOverPiDigits = {
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561, 0xb7246e3a424dd2e0,
    0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41, 0x3991d639835339f4,
    0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d,
    0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab};

// 64 digits from behind the first `skipped` ones.
Word digits_of_two_over_pi(int skipped) {
  const auto word = static_cast<std::size_t>(skipped / 64);
  const int shift = skipped % 64;
  const Word head = kTwoOverPiDigits[word] << shift;
  return shift == 0 ? head : head | kTwoOverPiDigits[word + 1] >> (64 - shift);
}

}  // namespace

namespace detail {

ReducedAngle reduce_with_many_digits(double x) {
  const auto bits = std::bit_cast<Word>(x);
  const int e = int(bits >> 52 & 0x7ff) - 1075;
  const Word m = (bits & 0xfffffffffffff) | 0x10000000000000;

  // product = m * (192 digits), four words, lowest first
  const int skipped = std::max(0, e - 2);
  std::array<Word, 4> product{};
  for (int i = 0; i < 3; ++i) {
    const DoubleWord sum =
        DoubleWord(m) * digits_of_two_over_pi(skipped + 64 * (2 - i)) + product[std::size_t(i)];
    product[std::size_t(i)] = Word(sum);
    product[std::size_t(i) + 1] = Word(sum >> 64);
  }

  // Shift so that 190 digits stand behind the point.
  const int shift = std::max(0, 2 - e);
  if (shift > 0)
    for (std::size_t i = 0; i < 3; ++i) product[i] = product[i] >> shift | product[i + 1] << (64 - shift);

  // Two digits of quadrant, then 128 of the fraction read as a signed number: to the nearest multiple of
  // pi/2.
  Word quadrant = product[2] >> 62;
  const DoubleWord digits = (DoubleWord(product[2]) << 64 | product[1]) << 2 | product[0] >> 62;
  const auto fraction = static_cast<SignedDoubleWord>(digits);
  if (fraction < 0) ++quadrant;
  Quad r = Quad(fraction) * (0x1p-128Q * M_PI_2q);

  if (x < 0) {
    r = -r;
    quadrant = -quadrant;
  }
  const double head = double(r);
  return {head, double(r - head), quadrant};
}

SinCos<double> sin_cos_of_rare_angle(double x) {
  if (x == 0) return {x, 1.0};
  if (!std::isfinite(x)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  const ReducedAngle angle = reduce_with_many_digits(x);
  const SinCosParts parts = sin_cos_parts(angle.r, angle.r_tail);
  return turned(parts.s + parts.s_tail, parts.c + parts.c_tail, angle.quadrant);
}

}  // namespace detail

SinCos<Quad> sin_cos(Quad x) {
  SinCos<Quad> result;
  sincosq(x, &result.s, &result.c);
  return result;
}

Quad sine(Quad x) {
  return sinq(x);
}

Quad cosine(Quad x) {
  return cosq(x);
}

Quad tangent(Quad x) {
  return tanq(x);
}

Quad exponential(Quad x) {
  return expq(x);
}

Quad logarithm(Quad x) {
  return logq(x);
}

Quad arc_tangent2(Quad y, Quad x) {
  return atan2q(y, x);
}

Quad power(Quad x, Quad y) {
  if (y == -1) return 1 / x;
  if (y == 0) return 1;
  if (y == 1) return x;
  if (y == 2) return x * x;
  if (y == 3) return x * x * x;
  if (y == 4) return (x * x) * (x * x);
  return powq(x, y);
}

Quad square_root(Quad x) {
  return sqrtq(x);
}

}  // namespace chainreel

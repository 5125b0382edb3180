// tan, exp, log, atan2 and pow in double, each to well below one unit in the last place (pow: two), from +,
// -, *, / in a fixed order. Where one double is not enough a number is carried as the unevaluated sum of two.
//
// Sums and products with their rounding errors: T. Dekker, A floating-point technique for extending the
// available precision, Numer. Math. 18 (1971); D. Knuth, The Art of Computer Programming 2, 4.2.2. The series
// are Taylor's, on arguments made small first:
//
//   exp    x = k ln 2 + r, |r| <= ln(2) / 2         e^x = 2^k e^r
//   log    x = 2^k m, m in [sqrt(1/2), sqrt(2)]     log x = k ln 2 + 2 artanh s,  s = (m - 1) / (m + 1)
//   pow    x^y = exp(y log x), log x and the product carried as pairs
//   atan   a / b in [0, 1], c = i / 16 nearest      atan(a / b) = atan c + atan u,  u = (a - c b) / (b + c a)
//   tan    sin / cos from the parts of both
#include <array>
#include <limits>

#include "core/scalar.hpp"

namespace chainreel {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Pair {
  double hi, lo;
};

Pair fast_two_sum(double a, double b) {  // |a| >= |b| or a = 0
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

Pair two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

// Factors below 2^996 whose product's last digits lie above 2^-1074.
Pair two_product(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1;
  const double a_big = a * kSplit, a_hi = a_big - (a_big - a), a_lo = a - a_hi;
  const double b_big = b * kSplit, b_hi = b_big - (b_big - b), b_lo = b - b_hi;
  const double product = a * b;
  return {product, ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

Pair operator+(Pair a, Pair b) {
  const Pair sum = two_sum(a.hi, b.hi);
  return fast_two_sum(sum.hi, sum.lo + (a.lo + b.lo));
}

Pair operator-(Pair a) {
  return {-a.hi, -a.lo};
}

Pair operator*(Pair a, Pair b) {
  const Pair product = two_product(a.hi, b.hi);
  return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

Pair operator/(Pair a, Pair b) {
  const double quotient = a.hi / b.hi;
  const Pair back = two_product(quotient, b.hi);
  const double rest = ((a.hi - back.hi) - back.lo) + (a.lo - quotient * b.lo);
  return fast_two_sum(quotient, rest / b.hi);
}

// c[0] + c[1] x + c[2] x^2 + ..
template <std::size_t n>
double polynomial(const std::array<double, n>& c, double x) {
  double sum = c[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

double power_of_two(int k) {  // -1022 <= k <= 1023
  return std::bit_cast<double>(std::uint64_t(k + 1023) << 52);
}

double with_sign_of(double magnitude, double sign) {
  return std::signbit(sign) ? -magnitude : magnitude;
}

constexpr double kLn2Hi = 0x1.62e42fefa3800p-1;  // 42 bits: exact times any exponent
constexpr double kLn2Lo = 0x1.ef35793c76730p-45;
constexpr Pair kPi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Pair kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

// e^(hi + lo), |lo| far below 1.
double exponential_of(Pair x) {
  if (!(x.hi <= 710)) return x.hi > 710 ? kInfinity : x.hi;
  if (x.hi < -746) return 0;
  const double k = (x.hi * 0x1.71547652b82fep+0 + detail::kRoundToInteger) - detail::kRoundToInteger;
  const Pair r = Pair{x.hi - k * kLn2Hi, 0} + Pair{-(k * kLn2Lo), x.lo};

  // 1/2!, 1/3!, .. 1/14!; the next term is below 2^-62.
  static constexpr std::array kTerms = [] {
    std::array<double, 13> terms{};
    double factorial = 1;
    for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = 1 / (factorial *= double(i + 2));
    return terms;
  }();
  const Pair linear = fast_two_sum(1, r.hi);
  const double result = linear.hi + (linear.lo + (r.lo * linear.hi + r.hi * r.hi * polynomial(kTerms, r.hi)));

  // In two steps, since 2^k may be no double where the result is one.
  const int half = int(k) / 2;
  return result * power_of_two(half) * power_of_two(int(k) - half);
}

// log x for finite x > 0, to about 2^-70 of itself.
Pair logarithm_of(double x) {
  int k = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    k = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  k += int(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xfffffffffffff) | 0x3ff0000000000000);
  if (m > 0x1.6a09e667f3bcdp+0) {
    m *= 0.5;
    ++k;
  }
  const Pair s = Pair{m - 1, 0} / two_sum(1, m);
  const Pair z = s * s;

  // artanh s / s - 1 = z (1/3 + z (1/5 + z (1/7 + ..))), |z| < 0.0295: the first two terms as pairs, the sum
  // of the rest as one double; what is left out is below 2^-73.
  static constexpr std::array kTerms = [] {
    std::array<double, 11> terms{};
    for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = 1.0 / double(2 * i + 7);
    return terms;
  }();
  const Pair fifth = {0x1.999999999999ap-3, -0x1.999999999999ap-57};
  const Pair third = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
  const Pair series = third + z * (fifth + Pair{z.hi * polynomial(kTerms, z.hi), 0});
  const Pair s2 = {2 * s.hi, 2 * s.lo};
  return Pair{k * kLn2Hi, k * kLn2Lo} + (s2 + s2 * (z * series));
}

bool is_integer(double y) {
  return std::floor(y) == y;  // exact, like the next one
}

bool is_odd(double y) {
  return is_integer(y) && !is_integer(0.5 * y);
}

// |x|^y where that is neither 0, 1, infinite nor NaN by the arguments alone.
double power_of_magnitude(double x, double y) {
  if (std::fabs(y) > 0x1p66) return (x > 1) == (y > 0) ? kInfinity : 0;  // |log x| >= 2^-53
  if (std::fabs(y) < 0x1p-66) return 1;                                  // |log x| < 2^10
  return exponential_of(Pair{y, 0} * logarithm_of(x));
}

// atan(i / 16)
constexpr Pair kArcTangents[] = {
    {0x0.0000000000000p+0, 0x0.0000000000000p+0},   {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59}, {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},  {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56}, {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},  {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58}, {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},  {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56}, {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

// atan(a / b), 0 < a <= b, both far from the ends of the range.
Pair arc_tangent_of_ratio(double a, double b) {
  const auto i = static_cast<std::size_t>(16 * (a / b) + 0.5);
  const double c = double(i) / 16;
  const Pair u = (Pair{a, 0} + -two_product(c, b)) / (Pair{b, 0} + two_product(c, a));
  // atan u / u - 1 in w = u^2 < 2^-10; the next term is below 2^-73.
  static constexpr std::array kTerms = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13};
  const double w = u.hi * u.hi;
  return kArcTangents[i] + fast_two_sum(u.hi, u.lo + u.hi * (w * polynomial(kTerms, w)));
}

// The angle of (x, y) in the first quadrant, coordinates finite and not zero; the angle of y / x itself must
// not be tiny.
Pair angle_of(double y, double x) {
  const double larger = x > y ? x : y;
  const double scale = larger > 0x1p500 ? 0x1p-600 : larger < 0x1p-500 ? 0x1p600 : 1;
  x *= scale;
  y *= scale;
  return y <= x ? arc_tangent_of_ratio(y, x) : kHalfPi + -arc_tangent_of_ratio(x, y);
}

}  // namespace

double tangent(double x) {
  if (std::fabs(x) < 0x1p-27) return x;  // the next term, x^3 / 3, is below an ulp's third
  detail::ReducedAngle angle;
  if (!detail::reduce(x, angle)) {
    if (!std::isfinite(x)) return kNaN;
    angle = detail::reduce_with_many_digits(x);
  }
  const detail::SinCosParts parts = detail::sin_cos_parts(angle.r, angle.r_tail);
  const Pair s = fast_two_sum(parts.s, parts.s_tail);
  const Pair c = fast_two_sum(parts.c, parts.c_tail);
  return angle.quadrant & 1 ? -(c / s).hi : (s / c).hi;
}

double exponential(double x) {
  return exponential_of({x, 0});
}

double logarithm(double x) {
  if (x == 0) return -kInfinity;
  if (!(x > 0)) return kNaN;
  if (x == kInfinity) return x;
  return logarithm_of(x).hi;
}

double arc_tangent2(double y, double x) {
  if (x != x || y != y) return kNaN;
  const double ax = std::fabs(x), ay = std::fabs(y);
  Pair angle;
  if (ay == kInfinity && ax == kInfinity) {
    angle = kArcTangents[16];
  } else if (ay == kInfinity || ay > ax * 0x1p60) {
    angle = kHalfPi;
  } else if (ax == kInfinity || ay == 0 || ax > ay * 0x1p60) {
    if (!std::signbit(x)) return ay == 0 ? y : y / x;
    angle = {0, 0};
  } else {
    angle = angle_of(ay, ax);
  }
  return with_sign_of(std::signbit(x) ? (kPi + -angle).hi : angle.hi, y);
}

double power(double x, double y) {
  if (y == -1) return 1 / x;
  if (y == 0) return 1;
  if (y == 1) return x;
  if (y == 2) return x * x;
  if (y == 3) return x * x * x;
  if (y == 4) return (x * x) * (x * x);

  const double magnitude = std::fabs(x);
  if (x == 1) return 1;
  if (x != x || y != y) return kNaN;
  if (std::fabs(y) == kInfinity) return magnitude == 1 ? 1 : (magnitude > 1) == (y > 0) ? kInfinity : 0;

  const double sign = std::signbit(x) && is_odd(y) ? -1 : 1;
  if (magnitude == 0) return sign * (y > 0 ? 0 : kInfinity);
  if (magnitude == kInfinity) return sign * (y > 0 ? kInfinity : 0);
  if (x < 0 && !is_integer(y)) return kNaN;
  return magnitude == 1 ? sign : sign * power_of_magnitude(magnitude, y);
}

}  // namespace chainreel

// Scalars and their elementary functions with the same bits on every x86-64 machine: double, Quad (113-bit)
// and Dual<T> (a value with its derivative along one direction; nests).
//
// The C library picks other instructions on other processors, so its sin, exp, .. differ in the last bit.
// What stands here uses +, -, *, / and sqrt in double, in a fixed order (the build forbids contraction to
// fused operations), and integers. Rounding must be to nearest, as it is unless a program changes it.
//
//   sin_cos            both at once; inline for double, since dynamics calls it for every joint
//   sine cosine tangent exponential logarithm square_root arc_tangent2 power absolute minimum maximum
//   value_of(x)        the double nearest to x, all derivatives dropped
//
// Errors for double, in units in the last place: below 1, power below 2; results below 2^-1022 lose digits as
// they must. Outside a function's domain the result is NaN; at poles it is an infinity, as in C.
//
// Conversions: every arithmetic type converts to Dual<T> by itself (derivative zero), and so does T; nothing
// converts back but value_of. A Quad converts to a Dual only if that is built on Quad.
//
// sin and cos: W. Cody, W. Waite, Software Manual for the Elementary Functions (1980), ch. 8: x = k pi/2 + r
// with pi/2 in parts whose products with k are exact, then one polynomial each in z = r^2. The coefficients
// are minimax fits on |r| <= pi/4: errors of r + r z P(z) and 1 - z/2 + z^2 Q(z) below 2^-57 and 2^-61.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace chainreel {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Quad = __float128;

template <class T>
struct SinCos {
  T s, c;
};

namespace detail {

// |k| <= 2^20 below this limit, so that k * kHalfPi1 and k * kHalfPi2 (33 bits each) are exact.
inline constexpr double kReductionLimit = 0x1p20;
inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
inline constexpr double kHalfPi1 = 0x1.921fb54400000p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a600000p-34;
inline constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
// What the three parts leave out, k 2^-118 with rounding, must stay below 2^-57 of r.
inline constexpr double kCancellation = 0x1p-61;
// Adding it rounds to an integer, which is then found in the lowest bits.
inline constexpr double kRoundToInteger = 0x1.8p52;

inline constexpr double kSin[] = {-0x1.5555555555549p-3, 0x1.111111110f8abp-7,   -0x1.a01a019c16bd0p-13,
                                  0x1.71de357b32ca0p-19, -0x1.ae5e6843c9dbap-26, 0x1.5d936edc70c1ep-33};
inline constexpr double kCos[] = {0x1.555555555554bp-5,   -0x1.6c16c16c15038p-10, 0x1.a01a019c9493bp-16,
                                  -0x1.27e4f7f47fe13p-22, 0x1.1ee9dbc682956p-29,  -0x1.8fa505637e4bcp-37};

// x = quadrant pi/2 + r + r_tail, |r| <= pi/4 (a little more at the seams); the quadrant counts modulo 4.
struct ReducedAngle {
  double r, r_tail;
  std::uint64_t quadrant;
};

// Each result is the sum of its two parts, |tail| below an ulp or so.
struct SinCosParts {
  double s, s_tail, c, c_tail;
};

// sin and cos of r + r_tail, |r| <= pi/4.
inline SinCosParts sin_cos_parts(double r, double r_tail) {
  const double z = r * r;
  const double z2 = z * z;
  // Pairs of terms first: shorter chains of dependent operations than Horner's rule.
  const double P = (kSin[0] + z * kSin[1]) + z2 * ((kSin[2] + z * kSin[3]) + z2 * (kSin[4] + z * kSin[5]));
  const double Q = (kCos[0] + z * kCos[1]) + z2 * ((kCos[2] + z * kCos[3]) + z2 * (kCos[4] + z * kCos[5]));
  const double half_z = 0.5 * z;
  const double w = 1.0 - half_z;
  return {r, r * z * P + r_tail * w, w, ((1.0 - w) - half_z) + (z2 * Q - r * r_tail)};
}

inline double flip_sign_if(double x, std::uint64_t odd) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (odd << 63));
}

// sin and cos after `quadrant` further quarter turns.
inline SinCos<double> turned(double s, double c, std::uint64_t quadrant) {
  const bool swapped = quadrant & 1;
  return {flip_sign_if(swapped ? c : s, (quadrant >> 1) & 1),
          flip_sign_if(swapped ? s : c, ((quadrant + 1) >> 1) & 1)};
}

// False for the rare angles, which the other two take: zero, angles beyond kReductionLimit or so near k pi/2
// that too few digits remain, infinities and NaN.
inline bool reduce(double x, ReducedAngle& angle) {
  if (!(std::fabs(x) <= kReductionLimit)) return false;
  const double shifted = x * kTwoOverPi + kRoundToInteger;
  const double k = shifted - kRoundToInteger;
  const double r1 = x - k * kHalfPi1;  // exact
  const double p2 = k * kHalfPi2;      // exact
  const double p3 = k * kHalfPi3;
  const double r2 = r1 - p2;
  const double r = r2 - p3;
  angle = {r, ((r1 - r2) - p2) + ((r2 - r) - p3), std::bit_cast<std::uint64_t>(shifted)};
  return std::fabs(r) > std::fabs(k) * kCancellation;
}

// Any finite x from 0.7 up, exactly, at many times the cost.
ReducedAngle reduce_with_many_digits(double x);

SinCos<double> sin_cos_of_rare_angle(double x);

}  // namespace detail

inline SinCos<double> sin_cos(double x) {
  detail::ReducedAngle angle;
  if (!detail::reduce(x, angle)) [[unlikely]]
    return detail::sin_cos_of_rare_angle(x);
  const detail::SinCosParts parts = detail::sin_cos_parts(angle.r, angle.r_tail);
  return detail::turned(parts.s + parts.s_tail, parts.c + parts.c_tail, angle.quadrant);
}

inline double sine(double x) {
  return sin_cos(x).s;
}
inline double cosine(double x) {
  return sin_cos(x).c;
}
double tangent(double x);
double exponential(double x);
double logarithm(double x);
double arc_tangent2(double y, double x);
// pow of C. Exponents -1, 0, 1, 2, 3, 4 are 1/x, 1, x, x*x, (x*x)*x and (x*x)*(x*x) rounded operation by
// operation.
double power(double x, double y);
inline double square_root(double x) {
  return std::sqrt(x);  // one correctly rounded instruction
}
inline double absolute(double x) {
  return std::fabs(x);
}
inline double value_of(double x) {
  return x;
}

SinCos<Quad> sin_cos(Quad x);
Quad sine(Quad x);
Quad cosine(Quad x);
Quad tangent(Quad x);
Quad exponential(Quad x);
Quad logarithm(Quad x);
Quad arc_tangent2(Quad y, Quad x);
Quad power(Quad x, Quad y);  // the same exponents by multiplication as for double
Quad square_root(Quad x);
inline Quad absolute(Quad x) {
  return x < 0 ? -x : x + 0;  // x + 0 makes -0 positive
}
inline double value_of(Quad x) {
  return double(x);
}

template <class T>
concept Arithmetic = std::is_arithmetic_v<T> || std::same_as<T, Quad>;

// Forward-mode automatic differentiation: re + du e with e^2 = 0. Comparisons look at re alone.
template <class T>
struct Dual {
  T re{};
  T du{};

  constexpr Dual() = default;
  constexpr Dual(const T& value, const T& derivative) : re(value), du(derivative) {}
  constexpr Dual(const T& value) requires(!Arithmetic<T>) : re(value) {}
  template <Arithmetic U>
  requires std::same_as<U, T> ||(!Arithmetic<T> && std::convertible_to<U, T>) ||
      (!std::same_as<U, Quad> && Arithmetic<T>)constexpr Dual(U value) : re(T(value)) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator+(const Dual& a) { return a; }
  friend Dual operator-(const Dual& a) { return {-a.re, -a.du}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.re + b.re, a.du + b.du}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.re - b.re, a.du - b.du}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.re * b.re, a.du * b.re + a.re * b.du}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T quotient = a.re / b.re;
    return {quotient, (a.du - quotient * b.du) / b.re};
  }

  friend bool operator==(const Dual& a, const Dual& b) { return a.re == b.re; }
  friend bool operator!=(const Dual& a, const Dual& b) { return !(a.re == b.re); }
  friend bool operator<(const Dual& a, const Dual& b) { return a.re < b.re; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.re > b.re; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.re <= b.re; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.re >= b.re; }
};

template <class T>
double value_of(const Dual<T>& x) {
  return value_of(x.re);
}

namespace detail {

inline bool is_constant(double x) {
  return x == 0;
}
inline bool is_constant(Quad x) {
  return x == 0;
}
template <class T>
bool is_constant(const Dual<T>& derivative) {
  return is_constant(derivative.re) && is_constant(derivative.du);
}

// f(x) with f'(x) = slope. Where x does not vary neither does f(x), even if the slope is infinite (sqrt at
// 0).
template <class T>
Dual<T> chain_rule(const T& value, const T& slope, const T& du) {
  return {value, is_constant(du) ? T(0) : slope * du};
}

}  // namespace detail

template <class T>
SinCos<Dual<T>> sin_cos(const Dual<T>& x) {
  const SinCos<T> re = sin_cos(x.re);
  return {{re.s, re.c * x.du}, {re.c, -re.s * x.du}};
}

template <class T>
Dual<T> sine(const Dual<T>& x) {
  return sin_cos(x).s;
}

template <class T>
Dual<T> cosine(const Dual<T>& x) {
  return sin_cos(x).c;
}

template <class T>
Dual<T> tangent(const Dual<T>& x) {
  const T re = tangent(x.re);
  return {re, (T(1) + re * re) * x.du};
}

template <class T>
Dual<T> exponential(const Dual<T>& x) {
  const T re = exponential(x.re);
  return {re, re * x.du};
}

template <class T>
Dual<T> logarithm(const Dual<T>& x) {
  return detail::chain_rule(logarithm(x.re), T(1) / x.re, x.du);
}

template <class T>
Dual<T> square_root(const Dual<T>& x) {
  const T re = square_root(x.re);
  return detail::chain_rule(re, T(0.5) / re, x.du);
}

template <class T>
Dual<T> arc_tangent2(const Dual<T>& y, const Dual<T>& x) {
  const T square = x.re * x.re + y.re * y.re;
  return detail::chain_rule(arc_tangent2(y.re, x.re), T(1) / square, x.re * y.du - y.re * x.du);
}

template <class T>
Dual<T> power(const Dual<T>& x, const Dual<T>& y) {
  const T re = power(x.re, y.re);
  T du = T(0);
  if (!detail::is_constant(x.du) && !(y.re == T(0))) du += y.re * power(x.re, y.re - T(1)) * x.du;
  if (!detail::is_constant(y.du)) du += re * logarithm(x.re) * y.du;
  return {re, du};
}

// At 0, where there is no slope, that of the right-hand side.
template <class T>
Dual<T> absolute(const Dual<T>& x) {
  return x.re < T(0) ? -x : Dual<T>{absolute(x.re), x.du};
}

// The first one wherever they are equal; NaN if one of them is.
template <class T>
T minimum(const T& a, const T& b) {
  return a <= b || a != a ? a : b;
}

template <class T>
T maximum(const T& a, const T& b) {
  return a >= b || a != a ? a : b;
}

}  // namespace chainreel

// DoubleDouble: a number as the unevaluated sum of two doubles, hi the one nearest to it; some 104 bits at the price of ten or
// twenty operations each. T. J. Dekker, A floating-point technique for extending the available precision, Numerische
// Mathematik 18 (1971) 224-242; Y. Hida, X. Li, D. Bailey, Algorithms for quad-double precision floating point arithmetic
// (2001), for the sum that is exact to both parts.
//
// No operation is fused and each is rounded to nearest, as in core/scalar.hpp, so that the bits are the same on every machine.
// A value is one of two doubles; what is beyond 2^996 has no product (NaN).
//
// The text works on doubles and on vectors of them alike: Pack is a double, or a GCC vector.
#pragma once

#include <type_traits>

#include "core/scalar.hpp"

namespace chainreel {

namespace detail {

// a + b = sum + error, exactly.
template <class Pack>
inline void two_sum(const Pack& a, const Pack& b, Pack& sum, Pack& error) {
  sum = a + b;
  const Pack part = sum - a;
  error = (a - (sum - part)) + (b - part);
}

// The same where |a| >= |b| or a = 0.
template <class Pack>
inline void two_sum_of_sorted(const Pack& a, const Pack& b, Pack& sum, Pack& error) {
  const Pack total = a + b;
  error = b - (total - a);
  sum = total;
}

// x = upper + lower of 26 bits each, so that their products are exact.
template <class Pack>
inline void split(const Pack& x, Pack& upper, Pack& lower) {
  const Pack scaled = x * 0x1.0000002p27;  // 2^27 + 1
  upper = scaled - (scaled - x);
  lower = x - upper;
}

// a b = product + error, exactly.
template <class Pack>
inline void two_product(const Pack& a, const Pack& b, Pack& product, Pack& error) {
  Pack a_upper, a_lower, b_upper, b_lower;
  split(a, a_upper, a_lower);
  split(b, b_upper, b_lower);
  product = a * b;
  error = ((a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower;
}

template <class Pack>
struct HiLo {
  Pack hi, lo;
};

template <class Pack>
inline HiLo<Pack> sum_of(const HiLo<Pack>& a, const HiLo<Pack>& b) {
  Pack hi, lo, hi_of_lo, rest;
  two_sum(a.hi, b.hi, hi, lo);
  two_sum(a.lo, b.lo, hi_of_lo, rest);
  lo = lo + hi_of_lo;
  two_sum_of_sorted(hi, lo, hi, lo);
  lo = lo + rest;
  two_sum_of_sorted(hi, lo, hi, lo);
  return {hi, lo};
}

template <class Pack>
inline HiLo<Pack> product_of(const HiLo<Pack>& a, const HiLo<Pack>& b) {
  Pack hi, lo;
  two_product(a.hi, b.hi, hi, lo);
  lo = lo + (a.hi * b.lo + a.lo * b.hi);
  two_sum_of_sorted(hi, lo, hi, lo);
  return {hi, lo};
}

}  // namespace detail

struct DoubleDouble {
  double hi = 0, lo = 0;

  constexpr DoubleDouble() = default;
  template <class N>
  requires std::is_integral_v<N> || std::same_as<N, double>
  constexpr DoubleDouble(N x) : hi(double(x)) {}  // integers below 2^53
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  explicit DoubleDouble(Quad x) : hi(double(x)), lo(double(x - Quad(hi))) {}

  explicit operator double() const { return hi; }
  explicit operator Quad() const { return Quad(hi) + Quad(lo); }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) { return of(detail::sum_of(a.parts(), b.parts())); }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) { return of(detail::product_of(a.parts(), b.parts())); }
  // By long division: three digits of the quotient, each a double.
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.hi / b.hi;
    DoubleDouble rest = a - b * first;
    const double second = rest.hi / b.hi;
    rest -= b * second;
    return DoubleDouble(first) + second + rest.hi / b.hi;
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }

  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) { return a.hi == b.hi && a.lo == b.lo; }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b < a || a == b; }

 private:
  detail::HiLo<double> parts() const { return {hi, lo}; }
  static DoubleDouble of(const detail::HiLo<double>& x) { return {x.hi, x.lo}; }
};

// Through Quad: exact to a few units of a DoubleDouble's last place.
inline SinCos<DoubleDouble> sin_cos(const DoubleDouble& x) {
  const SinCos<Quad> exact = sin_cos(Quad(x));
  return {DoubleDouble(exact.s), DoubleDouble(exact.c)};
}
inline double value_of(const DoubleDouble& x) {
  return x.hi;
}

}  // namespace chainreel

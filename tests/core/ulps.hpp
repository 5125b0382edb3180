// How far a double lies from the true value, in units in the last place of the true value; and seeded numbers
// to try.
#pragma once

#include <quadmath.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "core/scalar.hpp"

namespace chainreel::test {

inline double ulp_of(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  return std::ldexp(1.0, std::max(exponent - 53, -1074));
}

// Infinite where one is a number, infinity or NaN and the other is not the same.
inline double error_in_ulps(double result, Quad truth) {
  const auto rounded = double(truth);
  if (std::isnan(rounded) && std::isnan(result)) return 0;
  if (!std::isfinite(rounded) || !std::isfinite(result))
    return rounded == result ? 0 : std::numeric_limits<double>::infinity();
  return double(fabsq(truth - result) / ulp_of(rounded));
}

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : bits_(seed) {}

  double between(double a, double b) { return a + (b - a) * (double(bits_() >> 11) * 0x1p-53); }
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  // Any finite double, all exponents alike.
  double any() {
    double value = 0;
    do value = std::bit_cast<double>(bits_());
    while (!std::isfinite(value));
    return value;
  }

 private:
  std::mt19937_64 bits_;  // its sequence is fixed by the standard, unlike that of the distributions
};

}  // namespace chainreel::test

// The instant at which something happens, between one at which it has not and one at which it has.
//
// The root finder is ITP: I. F. D. Oliveira, R. H. C. Takahashi, An Enhancement of the Bisection Method
// Average Performance Preserving Minmax Optimality, ACM Trans. Math. Softw. 47 (2020) 5, with kappa_1 = 0.2 /
// (b - a), kappa_2 = 2, n_0 = 1. It takes one look more than bisection at worst, whatever the function does
// between the ends, and converges as fast as the secant method where that is smooth.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace chainreel {

inline constexpr double kInstantTolerance = 1e-12;  // s, or four units in the last place of t

namespace detail {

inline double itp_estimate(double a, double b, double ya, double yb, double truncation, double radius) {
  const double half = 0.5 * (a + b);
  // Regula falsi, where it means something.
  const bool brackets = (ya < 0) != (yb < 0) && ya != 0 && yb != 0 && std::isfinite(ya) && std::isfinite(yb);
  const double secant = brackets ? (yb * a - ya * b) / (yb - ya) : half;
  const double sigma = secant < half ? 1 : -1;
  const double truncated = truncation <= std::abs(half - secant) ? secant + sigma * truncation : half;
  const double x = std::abs(truncated - half) <= radius ? truncated : half - sigma * radius;
  return x > a && x < b ? x : half;
}

}  // namespace detail

// A value that decides, at an instant.
struct Look {
  double t, value;
};

// The first instant found at which it has happened; within the tolerance before it, it had not. `value_at(t)`
// reads the value, `happens(value)` judges it.
template <class ValueAt, class Happens>
double first_instant(Look before, Look after, ValueAt&& value_at, Happens&& happens) {
  auto [a, ya] = before;
  auto [b, yb] = after;
  const double ulp = std::nextafter(std::abs(b), std::numeric_limits<double>::max()) - std::abs(b);
  const double tolerance = 0.5 * std::max(kInstantTolerance, 4 * ulp);
  const double kappa = 0.2 / (b - a);
  const int most = 1 + int(std::ceil(std::max(0.0, std::log2((b - a) / (2 * tolerance)))));
  for (int j = 0; j <= most && b - a > 2 * tolerance; ++j) {
    const double radius = tolerance * std::ldexp(1, most - j) - 0.5 * (b - a);
    const double x = detail::itp_estimate(a, b, ya, yb, kappa * (b - a) * (b - a), std::max(radius, 0.0));
    const double y = value_at(x);
    if (happens(y)) {
      b = x;
      yb = y;
    } else {
      a = x;
      ya = y;
    }
  }
  return b;
}

}  // namespace chainreel

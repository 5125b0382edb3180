// Where a value that falls at first and rises at last goes below a limit in between, if it does.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/watch/first_instant.hpp"

namespace chainreel {

// By golden section, as long as slopes like those seen could lead below zero; the dip may be sharp, like that of a distance.
template <class ValueAt>
std::optional<Look> below_in_dip(double from, double to, double limit, int most_looks, ValueAt&& value_at) {
  constexpr double kGolden = 0.6180339887498949;
  double a = from, b = to, c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double at_a = value_at(a), at_b = value_at(b), at_c = value_at(c), at_d = value_at(d);
  for (int looks = 0; looks < most_looks; ++looks) {
    const bool left = at_c < at_d;
    if (std::min(at_c, at_d) < limit) return left ? Look{c, at_c} : Look{d, at_d};
    const double fall = std::max(at_a - at_c, at_b - at_d) / (1 - kGolden);
    if (!(std::min(at_c, at_d) < fall)) return {};
    if (left) {
      b = d, at_b = at_d, d = c, at_d = at_c;
      c = b - kGolden * (b - a), at_c = value_at(c);
    } else {
      a = c, at_a = at_c, c = d, at_c = at_d;
      d = a + kGolden * (b - a), at_d = value_at(d);
    }
    if (!(a < c && c < d && d < b)) return {};
  }
  return {};
}

// Between two looks at which `at`, a distance, is not below the limit: where it is, if it is. `change`: by how much it changed from look to look, here or
// before; what is farther from zero than some of that is not looked at closer. Slopes are taken just inside of both looks.
template <class At>
std::optional<Look> visit_between(Look from, Look to, double change, double limit, At&& at) {
  constexpr double kReach = 4;          // changes
  constexpr double kInside = 1e-3;      // of the part
  constexpr int kMostLooksAtVisit = 48;  // each narrows the part to 0.62 of itself
  if (!(std::min(from.value, to.value) <= kReach * change)) return {};
  // Nearer at first, farther at last.
  const double inside = kInside * (to.t - from.t);
  if (!(at(from.t + inside) < from.value) || !(at(to.t - inside) < to.value)) return {};
  return below_in_dip(from.t, to.t, limit, kMostLooksAtVisit, at);
}

}  // namespace chainreel

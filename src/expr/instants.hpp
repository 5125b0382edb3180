// The instants at which corners of t alone lie, all of them: none is found by luck.
//
// Between the instants of the corners inside it a switching function is smooth. There it is looked at over
// whole pieces of time, in interval arithmetic together with its slope (R. E. Moore, R. B. Kearfott, M. J.
// Cloud, Introduction to Interval Analysis (2009), 8.1): a piece whose range leaves zero out has no root, one
// whose slope leaves zero out has at most one, which bisection finds to the last bit; all others are halved.
// So `(t > 1.507) * (t < 1.5071)` is found whatever the duration is, and all zeros of sin(20*t) are. Where a
// function only touches zero, the instant is that to 1e-12 of the duration or so.
#pragma once

#include <span>
#include <vector>

#include "expr/corners.hpp"

namespace chainreel {

inline constexpr long kMostInstants = 100000;

// Within (0, end), rising and different. Throws Error (limit) naming the expression that has more than
// kMostInstants, or whose zeros cannot be told apart.
std::vector<double> instants_of(const Corners& corners, double end);

// The sides of the corners of t alone at an instant between two of these; others' stay as they are.
void set_sides_of_time(const Corners& corners, double t, std::span<double> sides);

}  // namespace chainreel

// What films say of axes of the ellipse that their scene cuts. A number that runs cannot be read: while it does, bounds stand
// there, which grow and fall with it by steps that can, and words come and go without a jump. Internal.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "draw/layers/ellipse.hpp"

namespace chainreel {

// An axis at a frame: its length in kg or m/s, infinite of one that is open; nothing where the scene holds its end.
using CutLength = std::optional<double>;

// Those of the curve's axes, as many as there are, the longest on the page first.
std::vector<CutLength> cut_lengths(const std::vector<MassAxis>& axes, Point center, const Camera& camera, const EllipseStyle& style);

// An axis that leads so far out, in units of H, has a bound, however slow: its number would say how near to the singular pose the
// picture happens to be, and nothing of the robot.
inline constexpr double kFarOut = 10;

// "> 20": the largest of 1, 2, 5 x 10^n below it; "" of what is infinite.
std::string bound_below(double length);

// What is said of one axis at each frame of a film of so many a second; from `far_out` on, kg or m/s, a bound.
std::vector<CutNumber> numbers_along(const std::vector<CutLength>& lengths, double fps, double far_out = HUGE_VAL);

}  // namespace chainreel

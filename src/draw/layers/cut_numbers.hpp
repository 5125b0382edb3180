// What films say of axes of the ellipse that their scene cuts. A number that runs cannot be read: while it does, a bound stands
// there that holds for all of the passage, and words come and go without a jump. Internal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/layers/ellipse.hpp"

namespace chainreel {

// An axis at a frame: its length in kg or m/s, infinite of one that is open; nothing where the scene holds its end.
using CutLength = std::optional<double>;

// Those of the curve's axes, as many as there are, the longest on the page first.
std::vector<CutLength> cut_lengths(const std::vector<MassAxis>& axes, Point center, const Camera& camera, const EllipseStyle& style);

// "> 30": the largest number of one digit below it; "" of what is infinite.
std::string bound_below(double least);

// What is said of one axis at each frame of a film of so many a second.
std::vector<CutNumber> numbers_along(const std::vector<CutLength>& lengths, double fps);

}  // namespace chainreel

// How exact a run has to be, as a scene says it: the unit decides what is compared.
#pragma once

#include <string>

#include "core/names.hpp"

namespace chainreel {

// `value` in units of
//   px        places of points that can be seen; 1 px is 1/1080 of the fitted scene's height, whatever the output's size
//   m         the same places
//   rad       angles of turning joints and of floating bases; ways of sliders and bases over the diagonal of the motion
//   relative  the same places as px, in units of the diagonal of the box in which they move
enum class AccuracyUnit { px, m, rad, relative };
std::span<const Name> names_of(AccuracyUnit);

struct Accuracy {
  double value = 0.1;
  AccuracyUnit unit = AccuracyUnit::px;
};

// "0.1 px", "1e-3 m", "0.01 rad", "1e-6 relative" (the last word may be left out). Throws Error (bad input).
Accuracy parse_accuracy(const std::string& text);
std::string to_string(const Accuracy& accuracy);

}  // namespace chainreel

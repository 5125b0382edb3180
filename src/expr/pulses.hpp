// Smooth pulses of t alone that are much narrower than the time they stand in, like
// 1e5*exp(-((t - 1.2345)/1e-5)^2): steps pass over them unless they end there.
#pragma once

#include <span>
#include <vector>

#include "expr/corners.hpp"

namespace chainreel {

// Instants within (0, end) that divide each pulse into parts, rising. `known`, rising too, are those of the
// corners (instants_of). A pulse leaves the values at both ends of a thousandth of the duration within it, by
// a tenth of the largest. Of a function that does so nearly everywhere, a fast wave, there are none: all
// steps see that.
std::vector<double> pulses_of(const std::vector<CorneredProgram>& programs, const Corners& corners,
                              std::span<const double> known, double end);

}  // namespace chainreel

// Needles of curves: peaks so short and so far above the rest that on an axis which holds them nobody could read it, as multipliers have near singular
// poses. The axis then holds the rest; each needle leaves the plot at its edge, and its number stands beside it there, so that nothing is hidden.
#pragma once

#include <optional>
#include <vector>

#include "draw/film/plot_strip.hpp"

namespace chainreel {

struct ValueRange {
  double low = 0, high = 0;
  double span() const { return high - low; }
};

// Of curves that decide on the axis and together reach over `whole`: what 95 % of the time of each lie in, and the peaks that go beyond by less than
// once more, where that is less than a fifth of the whole and what is left out is a few peaks that rise from it and come back. Else nothing.
std::optional<ValueRange> range_without_needles(const StripData& data, ValueRange whole);

// Of curves that do not lie on others.
std::vector<Needle> needles_of(const std::vector<StripCurve>& curves, const Axis& y);

// Heads of those until t, where they leave the frame.
void draw_needle_heads(Picture& picture, const PlotFrame& frame, const std::vector<Needle>& needles, const std::vector<StripCurve>& curves, double t, double opacity);
// "-260 N"
std::string number_of(const Needle& needle, const std::string& unit);
// That of each beside its head, all on one side of theirs, where all have room beside curves and one another; else none. Of equal ones in one
// place one. Whether they are told.
bool draw_needle_numbers(Picture& picture, const PlotFrame& frame, const std::vector<Needle>& needles, const std::vector<StripCurve>& curves, const std::string& unit,
                         const PlotStyle& style);

}  // namespace chainreel

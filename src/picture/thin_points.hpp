// Points of a curve without which it looks the same: samples lie closer than pixels.
#pragma once

#include <cstddef>
#include <vector>

#include "picture/plot.hpp"

namespace chainreel {

// Indices of `data`, rising, the first and the last among them: the path through these points of the page passes every other one
// at less than a tenth of a pixel of 1080 lines. What the frame cannot show, and its neighbours, are kept, and so is all that
// does not go on to the right. `pixel`: of the page, units of H, where it is known.
std::vector<std::size_t> thin_points(const PlotFrame& frame, std::span<const Point> data, double pixel = 0);

// Of many points of a page, to the right each, those that a path through all of them shows: the first, the lowest, the highest and the
// last of each column that is narrower than a pixel, of one that holds many the lowest and the highest; all of few.
std::vector<std::size_t> column_points(std::span<const Point> page, double pixel = 0);

}  // namespace chainreel

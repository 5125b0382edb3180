// Hatching of some cells of a grid: what has no value is never coloured.
#pragma once

#include <vector>

#include "picture/picture.hpp"

namespace chainreel {

// Lines at 45 degrees across the marked cells of a grid of nx x ny in `box`, row by row from the lower left;
// neighbours share their lines.
void draw_hatch(Picture& picture, const Rect& box, int nx, int ny, const std::vector<bool>& marked,
                Color color);

}  // namespace chainreel

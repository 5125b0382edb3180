// The scale of lengths: a bar at the lower left inside the scene.
#pragma once

#include "draw/sheet.hpp"
#include "picture/camera.hpp"

namespace chainreel {

// The largest of 1, 2, 5 x 10^n m that measures at most a quarter of the scene's width.
double metre_bar_length(double scale, double scene_width);

void draw_metre_bar(Picture& picture, const Camera& camera, const Sheet& sheet, const Fonts& fonts);

}  // namespace chainreel

// What stands at the ends of axes that lead out of the scene: an infinity sign where the mass is infinite, else the
// length of the axis. Internal.
#pragma once

#include "draw/ellipse.hpp"
#include "draw/fading.hpp"

namespace chainreel {

// Infinity signs on the way from the centre along d and against it, off the end effector's disc; nothing where the
// style wants none.
void draw_infinities(Picture& picture, Point center, Point d, double half_width, const EllipseStyle& style, int clip);

// "7.91 kg" where the axis from center - v to center + v, `length` in the unit of the reading, leaves the scene at both
// of its ends: at each of them, stronger the further it leads out. Nothing where an end can be seen.
void draw_length_along(Picture& picture, Point center, Point v, double length, double half_width,
                       const EllipseStyle& style, int clip);

// How the lines of such axes fade, to leave room for what is written at their ends.
Fade fade_before_length(Point center, Point v, double length, const EllipseStyle& style);
Fade fade_before_infinity(Point center, Point d, const EllipseStyle& style);

}  // namespace chainreel

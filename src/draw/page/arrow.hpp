// Arrows, straight and round: the marks of vectors, at places of the page and in the sizes of the theme.
#pragma once

#include <optional>

#include "picture/picture.hpp"

namespace chainreel {

struct ArrowStyle {
  Color color;
  double size = 1;  // of shaft, head and dashes; below 1 in small panels
  bool dashed = false;
  double broken = 0;  // 0 to 1: how far a break in the shaft is open, which says that it is longer than it is drawn
  double lines = 1;   // times the width of the shaft: a style's, at most 2, where a head is still wider
  std::optional<Color> casing = std::nullopt;  // the background's: a line around it, so that it is seen on bodies of any colour
  double around = 0;                           // by so much it is drawn larger on all sides: of a casing
};

// From `tail` to tail + v. The head of a short arrow shrinks with it.
void draw_arrow(Picture& picture, Point tail, Point v, const ArrowStyle& style, int clip);

// Part of the curve center + cos(a) u + sin(a) w, a from -turn/2 to turn/2, with its head at that end: an
// arc about `center` that opens opposite to u. A circle where u and w are equally long and perpendicular,
// else a circle in space as the camera sees it. Dashes are for straight ones.
void draw_turn(Picture& picture, Point center, Point u, Point w, double turn, const ArrowStyle& style,
               int clip);
// The whole curve as a thin line.
void draw_ring(Picture& picture, Point center, Point u, Point w, Color color, int clip);

}  // namespace chainreel

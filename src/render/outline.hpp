// Where a shape may colour the page, row by row: between which columns, and between which of these it does so evenly.
#pragma once

#include "core/pixel_box.hpp"

namespace chainreel {

// Columns [left, right) outside of which a shape colours nothing; within [inner_left, inner_right), which may be empty, it
// has one colour, or none if it is a ring.
struct Spans {
  int left = 0, right = 0;
  int inner_left = 0, inner_right = 0;

  bool empty() const { return left >= right; }
  bool has_inner() const { return inner_left < inner_right; }
};

// Lengths in page pixels, y down.
struct Outline {
  enum class Kind { box, segment, ring, ellipse, polygon };

  Kind kind = Kind::box;
  PixelBox box;         // of all that it may colour, within its clip and the page
  double x = 0, y = 0;  // one end, or the centre
  double u = 1, v = 0;  // unit direction of the segment or of the major axis
  double a = 0, b = 0;  // length; radius of the ring; semi-axes
  double reach = 0;     // how far from the segment, the circle or the edge it may colour

  // In the rows [top, bottom), which are within its box. `numbers` are those of its instance: a polygon has its eight
  // corners there.
  Spans spans(int top, int bottom, const float* numbers) const;
};

}  // namespace chainreel

// What the vector writers share: pages of shapes without pixels.
#pragma once

#include <string>
#include <vector>

#include "picture/picture.hpp"

namespace chainreel {

struct VectorPage {
  double height = 540;  // of the page in its own units: pt in PDF, px in SVG
  std::string title, description;
  std::string metadata;  // anything that is to travel with the page
};

// All numbers are finite; others are left out, as by the canvas.
bool is_finite(const Shape& shape);

// A part of a trail with one width and one opacity. Vector formats know no opacity along a path, so a trail
// is divided into levels; where it is all of one level, its pieces are one path with round ends, and overlaps
// do not add up.
struct TrailRun {
  double width = 0, alpha = 0;
  std::vector<std::vector<Point>> lines;
  bool round_ends = false;
};
std::vector<TrailRun> trail_runs(const Trail& trail);

// The glyphs first .. first + count - 1 and the characters that they stand for.
struct GlyphCluster {
  std::size_t first = 0, count = 0;
  std::u32string text;
};
std::vector<GlyphCluster> clusters_of(const GlyphRun& run);

}  // namespace chainreel

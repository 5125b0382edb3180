// What a picture is: a flat list of shapes in painter's order. Physics fills it, render turns it into pixels
// or vector pages; neither knows the other.
//
// Page coordinates: unit = frame height H, origin at the lower left, x right, y up. A page is `aspect` wide
// and 1 high.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "picture/color.hpp"
#include "picture/point.hpp"
#include "picture/solids.hpp"

namespace chainreel {

// Fill the inside, then a stroke centred on the edge.
struct Paint {
  Color fill;
  Color stroke;
  double stroke_width = 0;
};

// All points within `radius` of the segment a-b. A line is a capsule without stroke.
struct Capsule {
  Point a, b;
  double radius = 0;
  Paint paint;
  double alpha_a = 1, alpha_b = 1;  // opacity at the two ends, linear between them
};

// Semi-axes as vectors; `u` and `v` are perpendicular. A disc has |u| = |v|.
struct Ellipse {
  Point center;
  Point u, v;
  Paint paint;
};

// Part of a circle's edge with round ends; angles in radians, counter-clockwise.
struct Arc {
  Point center;
  double radius = 0;
  double start = 0, sweep = 0;
  double width = 0;
  Color color;
};

// Convex, three to eight corners, either way round.
struct Polygon {
  std::array<Point, 8> corners;
  int count = 0;
  Paint paint;
};

// A path whose pieces may overlap without beading: coverage is the maximum, not the sum, of its pieces.
struct TrailPoint {
  Point p;
  double width = 0;
  double alpha = 0;
};
struct Trail {
  std::vector<TrailPoint> points;
  Color color;
};

// The faces that the program opens, each by its file.
enum class Face { label, label_bold, math };

struct Glyph {
  std::uint32_t index = 0;  // in the face, not a character
  double x = 0, y = 0;      // pen position relative to the run's origin, in units of H
  // The first of the characters of the run's text that it stands for: a ligature takes several, and several
  // glyphs may share one.
  std::uint32_t character = 0;
};

struct GlyphRun {
  Face face = Face::label;
  double size = 0;  // em, in units of H
  Point origin;     // on the baseline
  std::vector<Glyph> glyphs;
  Color color;
  std::string text;  // what it says, for outputs with selectable text
};

// Flat coloured cells that fill a rectangle, never smoothed; row by row from the lower left.
struct Cells {
  Rect rect;
  int nx = 0, ny = 0;
  std::vector<Color> colors;  // nx * ny
};

using Shape = std::variant<Capsule, Ellipse, Arc, Polygon, Trail, GlyphRun, Cells, Solids>;

struct Item {
  Shape shape;
  int clip = -1;  // index into Picture::clips, -1: the whole page
};

struct Picture {
  double aspect = 16.0 / 9.0;
  Color background = color_of(0xFFFFFF);
  std::vector<Rect> clips;
  std::vector<Item> items;

  template <class S>
  void add(S&& shape, int clip = -1) {
    // Assigned in place: g++ 12 warns wrongly of unset members where a variant made for the call is moved.
    Item& item = items.emplace_back();
    item.shape = std::forward<S>(shape);
    item.clip = clip;
  }

  // Everything of `over` on top of what is here; its page and background are left out.
  void append(const Picture& over) {
    const int shift = int(clips.size());
    clips.insert(clips.end(), over.clips.begin(), over.clips.end());
    for (const Item& item : over.items) items.push_back({item.shape, item.clip < 0 ? -1 : item.clip + shift});
  }
};

}  // namespace chainreel

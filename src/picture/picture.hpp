// What a picture is: a flat list of shapes in painter's order. Physics fills it, render turns it into pixels
// or vector pages; neither knows the other.
//
// Page coordinates: unit = frame height H, origin at the lower left, x right, y up. A page is `aspect` wide
// and 1 high.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/triangle_mesh.hpp"
#include "picture/fade.hpp"
#include "picture/point.hpp"

namespace chainreel {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  double a = 0;  // opacity 0 to 1; 0 draws nothing

  Color faded(double opacity) const { return {r, g, b, a * opacity}; }
  friend bool operator==(const Color&, const Color&) = default;
};

// From 0xRRGGBB, opaque unless said.
constexpr Color color_of(std::uint32_t rgb, double a = 1) {
  return {std::uint8_t(rgb >> 16), std::uint8_t(rgb >> 8), std::uint8_t(rgb), a};
}

// Bodies in space as one shape of a picture: the renderer lights them, lets them hide one another and puts
// the result down like any flat shape.

// View coordinates: x right, y up, z towards the viewer, m, from the point that the camera looks at.
struct Solid {
  std::shared_ptr<const TriangleMesh> mesh;
  std::array<double, 12>
      to_view{};  // rows of the 3x4 matrix from the mesh's coordinates; a pose, scales are the mesh's own
  std::optional<Color> color;  // instead of the mesh's own
  // Of each vertex of the mesh, how much of the sky it sees, 255: all of what is above its surface. None: all do.
  std::shared_ptr<const std::vector<std::uint8_t>> openness{};
};

struct Solids {
  std::vector<Solid> parts;
  // A point (x, y, z) of the view stands on the page at origin + scale / (1 - nearing . (x, y, z)) (x, y).
  Point origin;
  double scale = 1;                   // units of H per metre where nothing is nearer
  std::array<double, 3> nearing{};    // 1/m; 0: parallel rays
  double opacity = 1;                 // of the whole
  Color outline;                      // around the whole; a = 0: none
  double outline_width = 0;
  bool is_shadow = false;  // one flat colour instead of light: that of `outline`, whose width is how far its edges are blurred
  Fade fade{};             // of a shadow
};

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
  Fade fade{};
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
  Fade fade{};
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

// The faces that the program opens, each by its file. Those behind them are what `Fonts` found for characters that these lack.
enum class Face { label, label_bold, math };
inline constexpr int kOwnFaces = 3;

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
  double stroke_width = 0;  // above 0: the edges of the glyphs as lines instead, a halo below words; none selects it
  bool right_to_left = false;  // the glyphs stand as they are seen, the text as it is read
  bool joins = false;          // letters change with their neighbours, so that none may be set by itself
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
  std::size_t fixed = 0;  // so many of the items, the first ones, are alike in all pictures of a film

  template <class S>
  void add(S&& shape, int clip = -1) {
    // Assigned in place: g++ 12 warns wrongly of unset members where a variant made for the call is moved.
    Item& item = items.emplace_back();
    item.shape = std::forward<S>(shape);
    item.clip = clip;
  }

  // Items `begin` to the one before `end` on the same page.
  Picture part(std::size_t begin, std::size_t end) const {
    return {aspect, background, clips, {items.begin() + std::ptrdiff_t(begin), items.begin() + std::ptrdiff_t(end)}};
  }

  // Everything of `over` on top of what is here; its page and background are left out.
  void append(const Picture& over) {
    const int shift = int(clips.size());
    clips.insert(clips.end(), over.clips.begin(), over.clips.end());
    for (const Item& item : over.items) items.push_back({item.shape, item.clip < 0 ? -1 : item.clip + shift});
  }
};

}  // namespace chainreel

// What the vector writers share: pages of shapes without pixels.
#pragma once

#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"

typedef struct _cairo cairo_t;  // of <cairo.h>, which no other floor sees

namespace chainreel {

struct VectorPage {
  double height = 540;  // of the page in its own units: pt in PDF
  std::string title, description;
  std::string metadata;  // anything that is to travel with the page
  double width_mm = 0;   // above 0: as wide on paper, whatever the height
  double height_px = 0;  // of an SVG, as it is shown where nobody scales it; 0: its own units
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

// Vector formats know no opacity that is the least of several: parts of the page one in the other, each over the one before
// it, what they hold having this opacity.
struct FadeLevel {
  Rect part;
  double opacity = 0;
};
std::vector<FadeLevel> fade_levels(const Fade& fade);

// The glyphs first .. first + count - 1 and the characters that they stand for.
struct GlyphCluster {
  std::size_t first = 0, count = 0;
  std::u32string text;
};
std::vector<GlyphCluster> clusters_of(const GlyphRun& run);

// Shapes by Cairo: the same list as for the canvas, on any of Cairo's surfaces.

// Background and shapes; `height` of the page in the units of the surface, upper left corner at the origin.
// Throws Error (exit 4) where Cairo fails.
void paint_with_cairo(cairo_t* cairo, const Picture& picture, const Fonts& fonts, double height);

// A page of one picture with selectable text; the bytes of a PDF file. Equal pictures give equal bytes: it
// bears no time.
std::string pdf_text(const Picture& picture, const Fonts& fonts, const VectorPage& page);

// Shapes as SVG with selectable text.
//
// Text is <text> with a position for every character; each face is embedded as the part of it that the page
// uses, so a browser shows the very glyphs of the other outputs. Programs that read no embedded fonts
// (librsvg, Inkscape) take the family behind it: DejaVu Sans, Latin Modern Math.

std::string svg_text(const Picture& picture, const Fonts& fonts, const VectorPage& page);

}  // namespace chainreel

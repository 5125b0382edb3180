// One face's glyphs and their measures in ems; what the layouts of running text and of math are made of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "picture/text.hpp"

namespace chainreel {

struct ShapedText {
  std::vector<Glyph> glyphs;  // pen positions in ems
  double advance = 0;         // ems
  Rect ink;                   // of the outlines, ems; of zero width where nothing is inked
  bool has_ink = false;
};

// Throws Error (exit 4) where the face has no glyph for a character.
ShapedText shape(const Fonts& fonts, Face face, std::u32string_view text);

// How far a slanted glyph leans over its advance, in ems, as the face's MATH table says; 0 without one.
double italic_correction(const Fonts& fonts, Face face, std::uint32_t glyph);

// Collects what is laid out, in units of H relative to the line's start, and aligns it at the end.
class LineBuilder {
 public:
  LineBuilder(Face face, double size, Color color, Align align)
      : face_(face), size_(size), color_(color), align_(align) {}

  // `scale` of the line's em, at (x, y).
  void add(const ShapedText& shaped, std::u32string_view text, double scale, double x, double y);
  void add_disc(Point center, double radius);
  void add_rule(Point a, Point b, double width);  // with round ends
  void set_color(Color color) { color_ = color; }  // of what is added from now on
  TextLine finish(double advance);

 private:
  void enclose(const Rect& ink);

  Face face_;
  double size_;
  Color color_;
  Align align_;
  TextLine line_;
  bool has_ink_ = false;
};

}  // namespace chainreel

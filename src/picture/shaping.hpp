// One face's glyphs and their measures in ems; what the layouts of running text and of math are made of.
#pragma once

#include <cstdint>
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

// Whether one face has the whole text, and neither its letters nor its words change places or shapes: `shape` does.
bool is_plain(const Fonts& fonts, Face face, std::u32string_view text);

// A piece of a line of one face, script and direction.
struct TextRun {
  std::size_t begin = 0, end = 0;  // of its characters, as they are read
  Face face = Face::label;
  std::uint32_t script = 0;        // ISO 15924's tag
  bool right_to_left = false, joins = false;
};
// The pieces of any line as they stand from left to right. Characters U+FFFC are pieces of their own. Throws Error (exit 4) where no
// installed font has a character.
std::vector<TextRun> runs_of(const Fonts& fonts, Face face, std::u32string_view line);
// One of them. Characters count from the piece's first.
ShapedText shape(const Fonts& fonts, const TextRun& run, std::u32string_view line);

inline constexpr char32_t kObject = 0xFFFC;  // stands for what is no letter: a formula between words

// Faces in the place of `face` for characters that it lacks: one that has all of them, else each its own. Throws Error (exit 4)
// that names a package of fonts where none has one; `line` is what it is said of.
std::vector<Face> fallbacks_for(const Fonts& fonts, Face face, std::u32string_view characters, std::u32string_view line);
bool has_glyph(const Fonts& fonts, Face face, char32_t character);

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

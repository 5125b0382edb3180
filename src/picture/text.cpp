#include "picture/text.hpp"

#include <algorithm>

#include "picture/shaping.hpp"
#include "picture/utf8.hpp"

namespace chainreel {

void LineBuilder::enclose(const Rect& ink) {
  Rect& box = line_.box;
  box = has_ink_ ? Rect{std::min(box.x0, ink.x0), std::min(box.y0, ink.y0), std::max(box.x1, ink.x1),
                        std::max(box.y1, ink.y1)}
                 : ink;
  has_ink_ = true;
}

void LineBuilder::add(const ShapedText& shaped, std::u32string_view text, double scale, double x, double y) {
  const double em = scale * size_;
  // What shares size and baseline with the run before continues it, so that selected text reads on.
  const bool continues =
      !line_.runs.empty() && line_.runs.back().size == em && line_.runs.back().origin.y == y &&
      line_.runs.back().color == color_;
  if (!continues) line_.runs.push_back({face_, em, {x, y}, {}, color_, {}});
  GlyphRun& run = line_.runs.back();
  const auto before = std::uint32_t(decode_utf8(run.text).size());
  for (const Glyph& glyph : shaped.glyphs)
    run.glyphs.push_back(
        {glyph.index, x - run.origin.x + em * glyph.x, em * glyph.y, before + glyph.character});
  run.text += encode_utf8(text);
  if (shaped.has_ink)
    enclose({x + em * shaped.ink.x0, y + em * shaped.ink.y0, x + em * shaped.ink.x1, y + em * shaped.ink.y1});
}

void LineBuilder::add_disc(Point center, double radius) {
  line_.marks.push_back(Ellipse{center, {radius, 0}, {0, radius}, {color_, {}, 0}});
  enclose({center.x - radius, center.y - radius, center.x + radius, center.y + radius});
}

void LineBuilder::add_rule(Point a, Point b, double width) {
  const double r = width / 2;
  line_.marks.push_back(Capsule{a, b, r, {color_, {}, 0}});
  enclose({std::min(a.x, b.x) - r, std::min(a.y, b.y) - r, std::max(a.x, b.x) + r, std::max(a.y, b.y) + r});
}

namespace {

void shift_shape(Shape& shape, Point by) {
  if (auto* rule = std::get_if<Capsule>(&shape)) {
    rule->a = rule->a + by;
    rule->b = rule->b + by;
  }
  if (auto* ellipse = std::get_if<Ellipse>(&shape)) ellipse->center = ellipse->center + by;
  if (auto* run = std::get_if<GlyphRun>(&shape)) run->origin = run->origin + by;
}

}  // namespace

TextLine LineBuilder::finish(double advance) {
  const double shift = align_ == Align::left ? 0 : align_ == Align::center ? -advance / 2 : -advance;
  for (GlyphRun& run : line_.runs) run.origin.x += shift;
  for (Shape& mark : line_.marks) shift_shape(mark, {shift, 0});
  if (has_ink_) {
    line_.box.x0 += shift;
    line_.box.x1 += shift;
  }
  line_.advance = advance;
  return std::move(line_);
}

TextLine lay_out_text(const Fonts& fonts, const std::string& utf8, const TextStyle& style) {
  const std::u32string text = decode_utf8(utf8);
  const ShapedText shaped = shape(fonts, style.face, text);
  LineBuilder line(style.face, style.size, style.color, style.align);
  if (!shaped.glyphs.empty()) line.add(shaped, text, 1, 0, 0);
  return line.finish(style.size * shaped.advance);
}

void draw_text(Picture& picture, const TextLine& line, Point anchor, int clip) {
  for (const GlyphRun& run : line.runs) {
    Shape moved = run;
    shift_shape(moved, anchor);
    picture.add(std::move(moved), clip);
  }
  for (const Shape& mark : line.marks) {
    Shape moved = mark;
    shift_shape(moved, anchor);
    picture.add(std::move(moved), clip);
  }
}

}  // namespace chainreel

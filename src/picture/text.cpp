#include "picture/text.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "core/error.hpp"
#include "picture/formula_words.hpp"
#include "picture/shaping.hpp"

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

namespace {

constexpr double kFormulaSize = 1.2;  // of the text's: small letters of the math face are lower

// Sets `part` behind what is there.
void append(TextLine& line, TextLine part) {
  for (GlyphRun& run : part.runs) {
    run.origin.x += line.advance;
    line.runs.push_back(std::move(run));
  }
  for (Shape& mark : part.marks) {
    shift_shape(mark, {line.advance, 0});
    line.marks.push_back(std::move(mark));
  }
  if (part.box.width() > 0) {
    const Rect box{part.box.x0 + line.advance, part.box.y0, part.box.x1 + line.advance, part.box.y1};
    line.box = line.box.width() > 0 ? around(line.box, box) : box;
  }
  line.advance += part.advance;
}

// Words of any script, with what stands at the places of kObject in them; from the left.
TextLine lay_out_mixed(const Fonts& fonts, std::u32string_view words, const std::map<std::size_t, TextLine>& objects,
                       const TextStyle& style) {
  TextLine line;
  for (const TextRun& run : runs_of(fonts, style.face, words)) {
    if (const auto object = objects.find(run.begin); object != objects.end()) {
      append(line, object->second);
      continue;
    }
    const ShapedText shaped = shape(fonts, run, words);
    LineBuilder builder(run.face, style.size, style.color, Align::left);
    if (!shaped.glyphs.empty()) builder.add(shaped, words.substr(run.begin, run.end - run.begin), 1, 0, 0);
    TextLine part = builder.finish(style.size * shaped.advance);
    for (GlyphRun& glyphs : part.runs) {
      glyphs.right_to_left = run.right_to_left;
      glyphs.joins = run.joins;
    }
    append(line, std::move(part));
  }
  return line;
}

// From the left to where the style says.
TextLine aligned(TextLine line, Align align) {
  const double shift = align == Align::left ? 0 : align == Align::center ? -line.advance / 2 : -line.advance;
  for (GlyphRun& run : line.runs) run.origin.x += shift;
  for (Shape& mark : line.marks) shift_shape(mark, {shift, 0});
  line.box.x0 += shift;
  line.box.x1 += shift;
  return line;
}

}  // namespace

TextLine lay_out_text(const Fonts& fonts, const std::string& utf8, const TextStyle& style) {
  const std::u32string text = decode_utf8(utf8);
  if (!is_plain(fonts, style.face, text)) return aligned(lay_out_mixed(fonts, text, {}, style), style.align);
  const ShapedText shaped = shape(fonts, style.face, text);
  LineBuilder line(style.face, style.size, style.color, style.align);
  if (!shaped.glyphs.empty()) line.add(shaped, text, 1, 0, 0);
  return line.finish(style.size * shaped.advance);
}

TextLine lay_out_words(const Fonts& fonts, const std::string& words, const TextStyle& style) {
  std::string text;
  std::map<std::size_t, TextLine> formulas;  // by their bytes' place in the text, each kObject's there
  const std::string object = encode_utf8(std::u32string_view(&kObject, 1));
  for (const FormulaPart& part : formula_parts(words)) {
    try {
      if (part.is_formula) {
        formulas[text.size()] =
            lay_out_math(fonts, part.text, {Face::math, kFormulaSize * style.size, style.color, Align::left});
        text += object;
        continue;
      }
    } catch (const Error&) {
      // no notation: it stands as it is written
    }
    text += part.text;
  }
  const TextStyle plain{style.face, style.size, style.color, Align::left};
  TextLine line;
  std::string without;
  for (std::size_t from = 0, next = 0; from <= text.size(); from = next + object.size()) {
    const auto formula = formulas.lower_bound(from);
    next = formula == formulas.end() ? text.size() : formula->first;
    without += text.substr(from, next - from);
  }
  if (is_plain(fonts, style.face, decode_utf8(without))) {
    // Formulas part the words, which are shaped one by one.
    std::size_t from = 0;
    for (auto& [at, formula] : formulas) {
      if (at > from) append(line, lay_out_text(fonts, text.substr(from, at - from), plain));
      append(line, std::move(formula));
      from = at + object.size();
    }
    if (from < text.size()) append(line, lay_out_text(fonts, text.substr(from), plain));
  } else {
    std::map<std::size_t, TextLine> objects;
    for (auto& [at, formula] : formulas) objects[decode_utf8(std::string_view(text).substr(0, at)).size()] = std::move(formula);
    line = lay_out_mixed(fonts, decode_utf8(text), objects, plain);
  }
  return aligned(std::move(line), style.align);
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

void draw_halo(Picture& picture, const TextLine& line, Point anchor, Color color, double width, int clip) {
  for (GlyphRun run : line.runs) {
    run.origin = run.origin + anchor;
    run.color = color;
    run.stroke_width = 2 * width;
    picture.add(std::move(run), clip);
  }
  for (Shape mark : line.marks) {
    shift_shape(mark, anchor);
    if (auto* rule = std::get_if<Capsule>(&mark)) rule->radius += width, rule->paint = {color, {}, 0};
    if (auto* dot = std::get_if<Ellipse>(&mark)) {
      const double r = norm(dot->u) + width;
      *dot = {dot->center, {r, 0}, {0, r}, {color, {}, 0}};
    }
    picture.add(std::move(mark), clip);
  }
}

namespace {

// Bytes of the sequence that `lead` opens, 0 where it cannot open one.
int sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead < 0xC2) return 0;  // a continuation byte, or an overlong form
  if (lead < 0xE0) return 2;
  if (lead < 0xF0) return 3;
  return lead < 0xF5 ? 4 : 0;
}

constexpr std::uint32_t kSmallest[5] = {0, 0, 0x80, 0x800, 0x10000};

bool is_surrogate(std::uint32_t c) {
  return c >= 0xD800 && c < 0xE000;
}

}  // namespace

std::u32string decode_utf8(std::string_view utf8) {
  std::u32string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    const int length = sequence_length(lead);
    std::uint32_t c = length == 1 ? lead : lead & (0x7Fu >> length);
    bool good = length > 0 && i + std::size_t(length) <= utf8.size();
    for (int k = 1; good && k < length; ++k) {
      const auto byte = static_cast<unsigned char>(utf8[i + std::size_t(k)]);
      good = (byte & 0xC0) == 0x80;
      c = c << 6 | (byte & 0x3Fu);
    }
    if (!good || c < kSmallest[length] || c > 0x10FFFF || is_surrogate(c))
      throw Error(ExitCode::bad_input, "text is not UTF-8: byte " + std::to_string(i + 1) + " of '" +
                                           std::string(utf8) + "'; save the file as UTF-8");
    text.push_back(char32_t(c));
    i += std::size_t(length);
  }
  return text;
}

std::string encode_utf8(std::u32string_view text) {
  std::string utf8;
  for (const char32_t c : text) {
    if (c < 0x80) {
      utf8 += char(c);
    } else if (c < 0x800) {
      utf8 += {char(0xC0 | c >> 6), char(0x80 | (c & 0x3F))};
    } else if (c < 0x10000) {
      utf8 += {char(0xE0 | c >> 12), char(0x80 | (c >> 6 & 0x3F)), char(0x80 | (c & 0x3F))};
    } else {
      utf8 += {char(0xF0 | c >> 18), char(0x80 | (c >> 12 & 0x3F)), char(0x80 | (c >> 6 & 0x3F)),
               char(0x80 | (c & 0x3F))};
    }
  }
  return utf8;
}

}  // namespace chainreel

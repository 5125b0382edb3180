// Lays the atoms of a formula out on one line. Gaps are those of Knuth, The TeXbook, ch. 18: a thin space is
// 3/18 em, a medium one 4/18 em (around binary operators), a thick one 5/18 em (around relations); none of
// the wider two in scripts.
#include <algorithm>

#include "picture/math_notation.hpp"
#include "picture/shaping.hpp"

namespace chainreel {
namespace {

constexpr double kThin = 3.0 / 18, kMedium = 4.0 / 18, kThick = 5.0 / 18, kWordSpace = 0.30;  // em
constexpr double kScriptScale[] = {1, 0.70, 0.50};
constexpr double kSubDown = 0.18, kSupUp = 0.38, kAfterScript = 0.04;         // em of the base
constexpr double kDotDiameter = 0.11, kDotAboveInk = 0.10, kDotPitch = 0.18;  // em

// A product shows no dot between a number and what it multiplies.
bool is_implicit_product(const MathAtom& before, const MathAtom& product, const MathAtom& after) {
  return product.kind == AtomKind::product && before.kind == AtomKind::number && before.sup.empty() &&
         after.kind != AtomKind::number;
}

double gap_between(const MathAtom& before, const MathAtom& after, bool in_script) {
  const auto either = [&](AtomKind kind) { return before.kind == kind || after.kind == kind; };
  const auto is_bracketed = [](const MathAtom& a) {
    return a.kind == AtomKind::open || a.kind == AtomKind::close;
  };
  if (either(AtomKind::word) && after.blank_before) return kWordSpace;
  if (before.kind == AtomKind::slash || after.kind == AtomKind::slash) return 0;
  if (after.kind == AtomKind::unit) return kThin;
  if (in_script) return 0;
  if (either(AtomKind::relation)) return kThick;
  if (either(AtomKind::binary)) return kMedium;
  if (before.kind == AtomKind::comma) return kThin;
  if (either(AtomKind::product)) return kThin / 2;
  if (before.kind == AtomKind::sign || is_bracketed(after) || before.kind == AtomKind::open) return 0;
  if (before.kind == AtomKind::function || after.kind == AtomKind::function) return kThin;
  return after.blank_before && after.kind != AtomKind::comma ? kThin : 0;
}

class Layout {
 public:
  Layout(const Fonts& fonts, const TextStyle& style)
      : fonts_(fonts), size_(style.size), line_(Face::math, style.size, style.color, style.align) {}

  TextLine lay_out(const std::vector<MathAtom>& atoms) {
    const double advance = add_list(atoms, 0, 0, 0);
    return line_.finish(advance);
  }

 private:
  // Each returns the pen's x behind what it has set.
  double add_list(const std::vector<MathAtom>& atoms, int level, double x, double y) {
    const double em = size_ * kScriptScale[std::min(level, 2)];
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      if (i > 0) x += em * gap_between(atoms[i - 1], atoms[i], level > 0);
      const bool is_inner = i > 0 && i + 1 < atoms.size();
      if (is_inner && is_implicit_product(atoms[i - 1], atoms[i], atoms[i + 1])) continue;
      x = add_atom(atoms[i], level, x, y);
    }
    return x;
  }

  double add_atom(const MathAtom& atom, int level, double x, double y) {
    const double scale = kScriptScale[std::min(level, 2)], em = size_ * scale;
    const ShapedText base = shape(fonts_, Face::math, atom.text);
    line_.add(base, atom.text, scale, x, y);
    add_dots(atom.dots, base.ink, em, x, y);
    const double end = x + em * base.advance;
    if (atom.sub.empty() && atom.sup.empty()) return end;

    const double lean =
        base.glyphs.empty() ? 0 : em * italic_correction(fonts_, Face::math, base.glyphs.back().index);
    const double sub_end = add_list(atom.sub, level + 1, end, y - em * kSubDown);
    const double sup_end = add_list(atom.sup, level + 1, end + lean, y + em * kSupUp);
    return std::max(atom.sub.empty() ? end : sub_end, atom.sup.empty() ? end : sup_end) + em * kAfterScript;
  }

  void add_dots(int dots, const Rect& ink, double em, double x, double y) {
    for (int i = 0; i < dots; ++i) {
      const double from_middle = (i - (dots - 1) / 2.0) * kDotPitch;
      line_.add_disc({x + em * ((ink.x0 + ink.x1) / 2 + from_middle), y + em * (ink.y1 + kDotAboveInk)},
                     em * kDotDiameter / 2);
    }
  }

  const Fonts& fonts_;
  double size_;
  LineBuilder line_;
};

}  // namespace

TextLine lay_out_math(const Fonts& fonts, const std::string& notation, const TextStyle& style) {
  return Layout(fonts, style).lay_out(parse_math(notation));
}

}  // namespace chainreel

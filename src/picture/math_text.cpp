// Lays the atoms of a formula out on one line. Gaps are those of Knuth, The TeXbook, ch. 18: a thin space is
// 3/18 em, a medium one 4/18 em (around binary operators), a thick one 5/18 em (around relations); none of
// the wider two in scripts.
#include <algorithm>
#include <cmath>

#include "picture/math_notation.hpp"
#include "picture/shaping.hpp"

namespace chainreel {
namespace {

constexpr double kThin = 3.0 / 18, kMedium = 4.0 / 18, kThick = 5.0 / 18, kWordSpace = 0.30;  // em
constexpr double kScriptScale[] = {1, 0.70, 0.50};
constexpr double kSubDown = 0.18, kSupUp = 0.38, kAfterScript = 0.04;         // em of the base
constexpr double kDotDiameter = 0.11, kDotAboveInk = 0.10, kDotPitch = 0.18;  // em
constexpr double kMathAxis = 0.25;  // em above the base line: where fractions and matrices are centred
constexpr double kRule = 0.06;      // em: rules of fractions, brackets and accents
constexpr double kFractionSide = 0.12, kFractionClear = 0.13, kFractionScripts = 0.62;          // em
constexpr double kRowPitch = 1.30, kColumnGap = 0.9, kBracketGap = 0.30, kBracketSerif = 0.16;  // em
constexpr double kSupBelowBracket = 0.35;                                       // em, of a superscript's base line
constexpr double kAccentAboveInk = 0.10, kHatWidth = 0.36, kHatHeight = 0.12;  // em
constexpr double kRootWidth = 0.6, kRootLeast = 0.45;  // em: of the sign itself, and over what is low

// A product shows no dot between a number and what it multiplies.
bool is_implicit_product(const MathAtom& before, const MathAtom& product, const MathAtom& after) {
  return product.kind == AtomKind::product && before.kind == AtomKind::number && before.sup.empty() &&
         after.kind != AtomKind::number && after.kind != AtomKind::sign;
}

double gap_between(const MathAtom& before, const MathAtom& after, bool in_script) {
  const auto either = [&](AtomKind kind) { return before.kind == kind || after.kind == kind; };
  const auto is_bracketed = [](const MathAtom& a) {
    return a.kind == AtomKind::open || a.kind == AtomKind::close;
  };
  if (either(AtomKind::word) && after.blank_before) return kWordSpace;
  // The entries of (10 10 10).
  if (before.kind == AtomKind::number && after.kind == AtomKind::number && after.blank_before) return kWordSpace;
  if (before.kind == AtomKind::slash || after.kind == AtomKind::slash) return 0;
  if (before.kind == AtomKind::open) return 0;
  if (after.kind == AtomKind::unit) return kThin;
  if (in_script) return 0;
  if (either(AtomKind::relation)) return kThick;
  if (either(AtomKind::binary)) return kMedium;
  if (before.kind == AtomKind::comma) return kThin;
  if (either(AtomKind::product)) return kThin / 2;
  if (before.kind == AtomKind::sign || is_bracketed(after) || before.kind == AtomKind::open) return 0;
  // Words between quotes bring the blanks that they need.
  if (after.kind == AtomKind::function && (after.text.starts_with(U',') || after.text.starts_with(U' '))) return 0;
  if (before.kind == AtomKind::function && before.text.ends_with(U' ')) return 0;
  if (before.kind == AtomKind::function || after.kind == AtomKind::function) return kThin;
  return after.blank_before && after.kind != AtomKind::comma ? kThin : 0;
}

class Layout {
 public:
  Layout(const Fonts& fonts, const TextStyle& style, const std::vector<SymbolColor>& symbols)
      : fonts_(fonts), size_(style.size), color_(style.color),
        line_(Face::math, style.size, style.color, style.align) {
    for (const SymbolColor& symbol : symbols) {
      const std::vector<MathAtom> atoms = parse_math(symbol.symbol);
      if (atoms.size() == 1) symbols_.emplace_back(atoms[0].text, symbol.color);
    }
  }

  TextLine lay_out(const std::vector<MathAtom>& atoms, int level = 0) {
    const double advance = add_list(atoms, level, 0, 0);
    return line_.finish(advance);
  }

 private:
  static double scale_at(int level) { return kScriptScale[std::min(level, 2)]; }

  // What a list measures where it would begin at (0, 0).
  TextLine measured(const std::vector<MathAtom>& atoms, int level) const {
    return Layout(fonts_, {Face::math, size_, color_, Align::left}, {}).lay_out(atoms, level);
  }

  // Each returns the pen's x behind what it has set.
  double add_list(const std::vector<MathAtom>& atoms, int level, double x, double y) {
    const double em = size_ * scale_at(level);
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      if (i > 0) x += em * gap_between(atoms[i - 1], atoms[i], level > 0);
      const bool is_inner = i > 0 && i + 1 < atoms.size();
      const bool is_divisor = i > 1 && atoms[i - 2].kind == AtomKind::slash;  // what follows it is not divided by
      if (is_inner && !is_divisor && is_implicit_product(atoms[i - 1], atoms[i], atoms[i + 1])) continue;
      x = add_atom(atoms[i], level, x, y);
    }
    return x;
  }

  double add_atom(const MathAtom& atom, int level, double x, double y) {
    switch (atom.kind) {
      case AtomKind::fraction:
        return add_scripts(atom, level, add_fraction(atom, level, x, y), y, 0, kFractionScripts);
      case AtomKind::matrix:
        return add_scripts(atom, level, add_matrix(atom, level, x, y), y, 0,
                           kMathAxis + double(atom.cells.size()) * kRowPitch / 2 - kSupBelowBracket);
      case AtomKind::hat:
      case AtomKind::bar:
        return add_scripts(atom, level, add_accent(atom, level, x, y), y, 0, kSupUp);
      case AtomKind::root:
        return add_scripts(atom, level, add_root(atom, level, x, y), y, 0, kSupUp);
      default:
        return add_glyphs(atom, level, x, y);
    }
  }

  double add_glyphs(const MathAtom& atom, int level, double x, double y) {
    const double scale = scale_at(level), em = size_ * scale;
    const ShapedText base = shape(fonts_, Face::math, atom.text);
    line_.set_color(color_of_symbol(atom.text));
    line_.add(base, atom.text, scale, x, y);
    add_dots(atom.dots, base.ink, em, x, y);
    line_.set_color(color_);
    const double lean =
        base.glyphs.empty() ? 0 : em * italic_correction(fonts_, Face::math, base.glyphs.back().index);
    return add_scripts(atom, level, x + em * base.advance, y, lean, kSupUp);
  }

  // Behind `end`; the superscript is shifted by `lean` and raised by `up` em.
  double add_scripts(const MathAtom& atom, int level, double end, double y, double lean, double up) {
    if (atom.sub.empty() && atom.sup.empty()) return end;
    const double em = size_ * scale_at(level), down = kSubDown + up - kSupUp;
    const double sub_end = add_list(atom.sub, level + 1, end, y - em * down);
    const double sup_end = add_list(atom.sup, level + 1, end + lean, y + em * up);
    return std::max(atom.sub.empty() ? end : sub_end, atom.sup.empty() ? end : sup_end) + em * kAfterScript;
  }

  double add_fraction(const MathAtom& atom, int level, double x, double y) {
    const double em = size_ * scale_at(level), axis = y + kMathAxis * em;
    const auto &above = atom.cells[0][0], &below = atom.cells[1][0];
    const TextLine upper = measured(above, level + 1), lower = measured(below, level + 1);
    const double side = kFractionSide * em, width = std::max(upper.advance, lower.advance) + 2 * side;
    const double clear = (kFractionClear + kRule / 2) * em;
    add_list(above, level + 1, x + (width - upper.advance) / 2, axis + clear - std::min(upper.box.y0, 0.0));
    add_list(below, level + 1, x + (width - lower.advance) / 2, axis - clear - lower.box.y1);
    line_.add_rule({x + side / 2, axis}, {x + width - side / 2, axis}, kRule * em);
    return x + width;
  }

  double add_matrix(const MathAtom& atom, int level, double x, double y) {
    const double em = size_ * scale_at(level), rows = double(atom.cells.size());
    std::vector<double> widths(atom.cells[0].size(), 0.0);
    for (const auto& row : atom.cells)
      for (std::size_t j = 0; j < row.size(); ++j)
        widths[j] = std::max(widths[j], measured(row[j], level).advance);
    double left = x + kBracketGap * em;
    for (std::size_t j = 0; j < widths.size(); ++j) {
      for (std::size_t i = 0; i < atom.cells.size(); ++i) {
        const double inset = (widths[j] - measured(atom.cells[i][j], level).advance) / 2;
        add_list(atom.cells[i][j], level, left + inset, y + ((rows - 1) / 2 - double(i)) * kRowPitch * em);
      }
      left += widths[j] + (j + 1 < widths.size() ? kColumnGap : kBracketGap) * em;
    }
    const double middle = y + kMathAxis * em, half = rows * kRowPitch * em / 2;
    add_bracket(x + kRule * em, middle, half, em);
    add_bracket(left - kRule * em, middle, half, -em);
    return left;
  }

  // Opens towards the side of `em`'s sign.
  void add_bracket(double x, double middle, double half, double em) {
    const double width = kRule * std::abs(em), serif = kBracketSerif * em;
    line_.add_rule({x, middle - half}, {x, middle + half}, width);
    line_.add_rule({x, middle - half}, {x + serif, middle - half}, width);
    line_.add_rule({x, middle + half}, {x + serif, middle + half}, width);
  }

  double add_accent(const MathAtom& atom, int level, double x, double y) {
    const double em = size_ * scale_at(level);
    const Rect ink = measured(atom.cells[0][0], level).box;
    const double end = add_list(atom.cells[0][0], level, x, y);
    const double low = y + ink.y1 + kAccentAboveInk * em, middle = x + (ink.x0 + ink.x1) / 2;
    if (atom.kind == AtomKind::bar) {
      line_.add_rule({x + ink.x0, low}, {x + ink.x1, low}, kRule * em);
      return end;
    }
    const double half = kHatWidth * em / 2, top = low + kHatHeight * em;
    line_.add_rule({middle - half, low}, {middle, top}, kRule * em);
    line_.add_rule({middle, top}, {middle + half, low}, kRule * em);
    return end;
  }

  double add_root(const MathAtom& atom, int level, double x, double y) {
    const double em = size_ * scale_at(level), left = x + kRootWidth * em;
    const Rect ink = measured(atom.cells[0][0], level).box;
    const double end = add_list(atom.cells[0][0], level, left, y) + kRule * em;
    const double top = y + std::max(ink.y1, kRootLeast * em) + kAccentAboveInk * em, foot = y + std::min(ink.y0, 0.0);
    const Point tick{x + 0.3 * kRootWidth * em, y + kMathAxis * em}, bottom{x + 0.6 * kRootWidth * em, foot};
    line_.add_rule({x + 0.1 * kRootWidth * em, tick.y - kRule * em}, tick, kRule * em);
    line_.add_rule(tick, bottom, 1.3 * kRule * em);
    line_.add_rule(bottom, {left, top}, kRule * em);
    line_.add_rule({left, top}, {end, top}, kRule * em);
    return end;
  }

  void add_dots(int dots, const Rect& ink, double em, double x, double y) {
    for (int i = 0; i < dots; ++i) {
      const double from_middle = (i - (dots - 1) / 2.0) * kDotPitch;
      line_.add_disc({x + em * ((ink.x0 + ink.x1) / 2 + from_middle), y + em * (ink.y1 + kDotAboveInk)},
                     em * kDotDiameter / 2);
    }
  }

  Color color_of_symbol(const std::u32string& text) const {
    for (const auto& [symbol, color] : symbols_)
      if (symbol == text) return color;
    return color_;
  }

  const Fonts& fonts_;
  double size_;
  Color color_;
  LineBuilder line_;
  std::vector<std::pair<std::u32string, Color>> symbols_;
};

}  // namespace

TextLine lay_out_math(const Fonts& fonts, const std::string& notation, const TextStyle& style,
                      const std::vector<SymbolColor>& symbols) {
  return Layout(fonts, style, symbols).lay_out(parse_math(notation));
}

}  // namespace chainreel

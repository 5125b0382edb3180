// Reads the notation of lay_out_math into atoms; where they go on the page is math_text.cpp's business.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

enum class AtomKind {
  operand,   // a variable or any other sign without gaps of its own
  number,    //
  word,      // upright, set off by word spaces
  function,  // upright: sin, cos, ...
  unit,      // upright, behind a number or bracket
  sign,      // + or - in front of an operand
  binary,    // + or - between two
  product,   // *, drawn as a thin space behind a number and as a dot elsewhere
  slash,
  relation,
  open,
  close,
  comma,
  fraction,  // cells: numerator, denominator
  matrix,    // cells in square brackets, row by row
  hat,       // cells: what it stands above
  bar,
  root,  // cells: what stands under it
};

struct MathAtom {
  AtomKind kind = AtomKind::operand;
  std::u32string text;  // characters of the math face: its alphabets are code points of their own
  int dots = 0;         // above, for derivatives
  std::vector<MathAtom> sub, sup;
  bool blank_before = false;
  std::vector<std::vector<std::vector<MathAtom>>> cells{};  // rows of lists
};

// Throws Error (exit 3) at an unfinished script or brace, or where the text is not UTF-8.
std::vector<MathAtom> parse_math(std::string_view notation);

// Of a letter of the math face's alphabets the one of the keyboard, or of Greek; any other sign as it is.
char32_t plain_letter(char32_t c);

// A formula where there are letters alone: "tau_1 = 5 sin(2 t)" with the Greek letter and a lowered digit, qdd with its dots,
// fractions with a slash. What is no notation stands as it is written.
std::string plain_formula(std::string_view notation);

}  // namespace chainreel

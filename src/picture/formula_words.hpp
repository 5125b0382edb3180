#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chainreel {

// Running text with formulas between dollar signs, "$tau$ [N m]", taken apart at them: the one place that knows what a
// dollar sign means. Without a partner, or behind a backslash, it is one.
struct FormulaPart {
  std::string_view source;  // as it stands in the text, dollar signs with it
  std::string text;         // the notation of a formula; of words what is to be read
  bool is_formula = false;
};

// In their order; together the sources are the text, which has to outlive them.
std::vector<FormulaPart> formula_parts(std::string_view text);

// As they are written, so that they are joined by blanks to the same text; a formula is one, and part of the word that
// it touches, and a number is one with its unit.
std::vector<std::string> formula_words(std::string_view text);

// Whether text may be cut before this byte without parting a formula, or a sign from its backslash.
bool is_outside_formula(std::string_view text, std::size_t byte);

// Throws Error, as parse_math does, at the first formula that is none; its message says how a dollar sign is written.
// `in_line`: where there is room for one line, and none for columns and matrices.
void require_formulas(std::string_view text, bool in_line = false);

// So that every dollar sign of a text is shown.
std::string without_formulas(std::string_view text);

// For where there are letters alone, formulas as plain_formula has them.
std::string in_plain_words(std::string_view text);

}  // namespace chainreel

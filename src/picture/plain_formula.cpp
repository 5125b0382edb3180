// Formulas where there are letters alone: names of files' lists, captions, alternative texts.
#include <optional>

#include "core/error.hpp"
#include "picture/math_notation.hpp"
#include "picture/text.hpp"

namespace chainreel {
namespace {

using Atoms = std::vector<MathAtom>;

constexpr char32_t kDots[] = {0, 0x0307, 0x0308};  // above the letter before them
constexpr char32_t kHat = 0x0302, kBar = 0x0304, kRoot = 0x221A;

std::u32string plain(const Atoms& atoms);

// The characters that stand lower or higher for each of the text's, where there are such.
std::optional<std::u32string> script_of(const std::u32string& text, bool below) {
  std::u32string script;
  for (const char32_t c : text) {
    if (c >= U'0' && c <= U'9')
      script += below ? 0x2080 + (c - U'0') : c == U'1' ? 0xB9 : c == U'2' || c == U'3' ? 0xB2 + (c - U'2') : 0x2070 + (c - U'0');
    else if (c == 0x2212)
      script += below ? 0x208B : 0x207B;
    else
      return std::nullopt;
  }
  return script;
}

std::u32string in_brackets(const Atoms& atoms) {
  const std::u32string text = plain(atoms);
  return atoms.size() > 1 ? U"(" + text + U")" : text;
}

std::u32string scripts_of(const MathAtom& atom) {
  std::u32string text;
  for (const bool below : {true, false}) {
    const Atoms& atoms = below ? atom.sub : atom.sup;
    if (atoms.empty()) continue;
    const std::optional<std::u32string> script = script_of(plain(atoms), below);
    text += script ? *script : (below ? U"_" : U"^") + in_brackets(atoms);
  }
  return text;
}

std::u32string rows_of(const MathAtom& matrix) {
  std::u32string text;
  for (const auto& row : matrix.cells) {
    text += text.empty() ? U"[" : U"; ";
    for (std::size_t j = 0; j < row.size(); ++j) text += (j > 0 ? U", " : U"") + plain(row[j]);
  }
  return text + U"]";
}

std::u32string base_of(const MathAtom& atom) {
  switch (atom.kind) {
    case AtomKind::fraction:
      return in_brackets(atom.cells[0][0]) + U"/" + in_brackets(atom.cells[1][0]);
    case AtomKind::matrix:
      return rows_of(atom);
    case AtomKind::root:
      return kRoot + in_brackets(atom.cells[0][0]);
    case AtomKind::hat:
    case AtomKind::bar:
      return in_brackets(atom.cells[0][0]) + (atom.kind == AtomKind::hat ? kHat : kBar);
    default:
      std::u32string text;
      for (const char32_t c : atom.text) text += plain_letter(c);
      if (atom.dots > 0) text += kDots[atom.dots];
      return text;
  }
}

bool is_set_off(const MathAtom& atom) {
  return atom.kind == AtomKind::binary || atom.kind == AtomKind::relation;
}

std::u32string plain(const Atoms& atoms) {
  std::u32string text;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const bool has_gap = atoms[i].blank_before || is_set_off(atoms[i]) || (i > 0 && is_set_off(atoms[i - 1]));
    if (i > 0 && has_gap) text += U' ';
    text += base_of(atoms[i]) + scripts_of(atoms[i]);
  }
  return text;
}

}  // namespace

std::string plain_formula(std::string_view notation) {
  try {
    return encode_utf8(plain(parse_math(notation)));
  } catch (const Error&) {
    return std::string(notation);
  }
}

}  // namespace chainreel

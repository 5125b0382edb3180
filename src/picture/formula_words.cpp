#include "picture/formula_words.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "picture/math_notation.hpp"

namespace chainreel {

std::vector<FormulaPart> formula_parts(std::string_view text) {
  std::vector<FormulaPart> parts;
  FormulaPart words;
  std::size_t begin = 0;  // of `words`
  const auto end_words = [&](std::size_t end) {
    words.source = text.substr(begin, end - begin);
    if (!words.source.empty()) parts.push_back(std::move(words));
    words = {};
  };
  std::size_t i = 0;
  while (i < text.size()) {
    if (text.substr(i, 2) == "\\$") {
      words.text += '$';
      i += 2;
      continue;
    }
    const std::size_t close = text[i] == '$' ? text.find('$', i + 1) : std::string_view::npos;
    if (close == std::string_view::npos) {
      words.text += text[i++];
      continue;
    }
    end_words(i);
    parts.push_back({text.substr(i, close + 1 - i), std::string(text.substr(i + 1, close - i - 1)), true});
    begin = i = close + 1;
  }
  end_words(text.size());
  return parts;
}

namespace {

// A number, signs and brackets before it apart.
bool is_number(std::string_view word) {
  const std::size_t first = word.find_first_not_of("+-\u2212([=<>~");
  if (first == std::string_view::npos) return false;
  const std::string_view digits = word.substr(first);
  return digits.find_first_not_of("0123456789.eE+-") == std::string_view::npos && digits.find_first_of("0123456789") == 0;
}

// "N", "m/s^2", "kg,": what stands behind numbers, punctuation behind it apart.
bool is_unit(std::string_view word) {
  constexpr std::array<std::string_view, 22> kUnits = {"N", "m", "s", "kg", "rad", "J", "W", "Hz", "mm", "cm", "km", "ms", "g", "deg", "\u00b0", "%", "min", "h", "px", "K", "Nm", "us"};
  while (!word.empty() && std::string_view(".,;:)]?!").find(word.back()) != std::string_view::npos) word.remove_suffix(1);
  const std::string_view first = word.substr(0, word.find_first_of("/^*"));
  return std::ranges::find(kUnits, first) != kUnits.end();
}

// Each number in one word with its unit: a line that ended between them would be read as a number without.
std::vector<std::string> with_units_kept(const std::vector<std::string>& words) {
  std::vector<std::string> kept;
  bool is_open = false;  // the last one is a number, or a number with its unit
  for (const std::string& word : words) {
    if (is_open && is_unit(word)) {
      kept.back() += " " + word;
      is_open = word == "N";  // N m
    } else {
      kept.push_back(word);
      is_open = is_number(word);
    }
  }
  return kept;
}

}  // namespace

std::vector<std::string> formula_words(std::string_view text) {
  std::vector<std::string> words{""};
  for (const FormulaPart& part : formula_parts(text)) {
    for (const char c : part.source) {
      if (c != ' ' || part.is_formula)
        words.back() += c;
      else if (!words.back().empty())
        words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return with_units_kept(words);
}

bool is_outside_formula(std::string_view text, std::size_t byte) {
  for (const FormulaPart& part : formula_parts(text)) {
    const std::size_t begin = std::size_t(part.source.data() - text.data());
    if (byte <= begin || byte >= begin + part.source.size()) continue;
    return !part.is_formula && text.substr(byte - 1, 2) != "\\$";
  }
  return true;
}

namespace {

bool holds_rows(const std::vector<MathAtom>& atoms) {
  return std::any_of(atoms.begin(), atoms.end(), [](const MathAtom& atom) {
    if (atom.kind == AtomKind::matrix && atom.cells.size() > 1) return true;
    if (holds_rows(atom.sub) || holds_rows(atom.sup)) return true;
    for (const auto& row : atom.cells)
      if (std::any_of(row.begin(), row.end(), holds_rows)) return true;
    return false;
  });
}

}  // namespace

void require_formulas(std::string_view text, bool in_line) {
  for (const FormulaPart& part : formula_parts(text)) {
    if (!part.is_formula) continue;
    try {
      if (holds_rows(parse_math(part.text)) && in_line)
        throw Error(ExitCode::bad_input, "a column or matrix of several rows has no room in a line; it has in the words of `annotate:`");
    } catch (const Error& error) {
      throw Error(error.code(), error.problems().front().message + "; see `chainreel help formulas`. A dollar sign is written \\$");
    }
  }
}

std::string without_formulas(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '$' ? std::string("\\$") : std::string(1, c);
  return escaped;
}

std::string in_plain_words(std::string_view text) {
  std::string plain;
  for (const FormulaPart& part : formula_parts(text)) plain += part.is_formula ? plain_formula(part.text) : part.text;
  return plain;
}

}  // namespace chainreel

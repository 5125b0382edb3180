#include "picture/latex_words.hpp"

#include <algorithm>

namespace chainreel {
namespace {

constexpr char32_t kFixedBlank = 0xA0, kThinSpace = 0x2009;

bool is_latin(char32_t c) {
  return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z');
}

// The word behind a backslash: letters, or one sign.
std::u32string_view word_at(std::u32string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && is_latin(text[end])) ++end;
  if (end == begin && begin < text.size()) ++end;
  return text.substr(begin, end - begin);
}

}  // namespace

LatexText plain_latex_text(std::u32string_view written) {
  LatexText read;
  for (std::size_t i = 0; i < written.size();) {
    if (written[i] != U'\\') {
      read.plain += written[i] == U'~' ? kFixedBlank : written[i];
      ++i;
      continue;
    }
    const std::u32string_view word = word_at(written, ++i);
    i += word.size();
    const auto sign = std::ranges::find(kLatexSigns, word, &std::pair<std::u32string_view, char32_t>::first);
    if (word == U"!") continue;  // a space less than none
    if (std::ranges::count(kLatexSpaces, word) > 0) {
      read.plain += word == U" " ? kFixedBlank : kThinSpace;
    } else if (sign != kLatexSigns.end()) {
      read.plain += sign->second;
      if (i < written.size() && written[i] == U' ') ++i;  // it ends the word
    } else {
      read.unknown = word.empty() ? U"\\" : std::u32string(word);
      return read;
    }
  }
  return read;
}

}  // namespace chainreel

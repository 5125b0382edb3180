#include "fuzz/mutate.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace chainreel {
namespace {

constexpr std::size_t kLongest = 300000;  // bytes; longer texts are refused by their size, which is soon tried

const std::string_view kNumbers[] = {"0", "-0", "-1", "1e308", "-1e308", "1e-320", "1e999", "nan", "inf", "-inf",
                                     "2147483648", "-2147483649", "18446744073709551616", "0x10", "1,5", "0.1.2", "1e",
                                     "+", "3e-17", "99999999999999999999999999", "90deg", "1/0", "00012", "1_000"};
const std::string_view kWords[] = {"\x1b[31m", std::string_view("\0", 1), "\xff\xfe", "\xe2\x80\xae", "\r", "\n", "\t",
                                   "{", "}", "[", "]", "<", ">", "\"", "'", "&amp;", "&#0;", "<!--", "]]>", "%s%n", "$(id)",
                                   "../../../..", "/etc/passwd", "*", "?", ": ", "- ", "#", ",", "|", "~", "null", "true"};

std::size_t span_length(Dice& dice, std::size_t most) {
  const std::size_t scale[] = {1, 4, 16, 64, 1024};
  return std::min(most, 1 + dice.below(dice.pick(scale)));
}

void replace_number(std::string& text, Dice& dice) {
  const std::size_t from = dice.below(text.size());
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto begin = std::find_if(text.begin() + std::ptrdiff_t(from), text.end(), is_digit);
  auto end = begin;
  while (end != text.end() && (is_digit(static_cast<unsigned char>(*end)) || *end == '.')) ++end;
  text.replace(begin, end, nasty_number(dice));
}

void change(std::string& text, Dice& dice, std::span<const std::string> dictionary) {
  const std::size_t at = dice.below(text.size());
  const std::size_t length = span_length(dice, text.size() - at);
  switch (dice.below(11)) {
    case 0:
      text[at] = char(text[at] ^ (1 << dice.below(8)));
      break;
    case 1:
      text[at] = char(dice.below(256));
      break;
    case 2:
      text.erase(at, length);
      break;
    case 3:
      text.insert(at, text.substr(at, length));
      break;
    case 4: {  // a piece goes elsewhere
      const std::string piece = text.substr(at, length);
      text.erase(at, length);
      text.insert(dice.below(text.size() + 1), piece);
      break;
    }
    case 5:
    case 6:
      replace_number(text, dice);
      break;
    case 7:
      text.insert(at, dice.pick(kWords));
      break;
    case 8:
      if (!dictionary.empty()) text.insert(at, dice.pick(dictionary));
      break;
    case 9:
      if (dice.one_in(4)) text.resize(at);
      break;
    default: {  // one piece very often: depth and length
      if (!dice.one_in(4)) break;
      const std::string piece = dice.one_in(2) ? std::string(1, "[{(<-\"'aA0"[dice.below(10)]) : text.substr(at, std::min<std::size_t>(length, 8));
      std::string many;
      for (std::size_t count = std::size_t(1) << dice.below(17); count > 0 && many.size() < kLongest; --count) many += piece;
      text.insert(at, many);
    }
  }
}

}  // namespace

std::uint64_t Dice::bits() {
  std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

std::string nasty_number(Dice& dice) {
  return std::string(dice.pick(kNumbers));
}

std::string mutated(std::string text, Dice& dice, std::span<const std::string> dictionary) {
  for (std::size_t changes = 1 + dice.below(1 + dice.below(6)); changes > 0; --changes) {
    if (text.empty()) text = " ";
    change(text, dice, dictionary);
    if (text.size() > kLongest) text.resize(kLongest);
  }
  return text;
}

}  // namespace chainreel

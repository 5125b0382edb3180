#include "core/format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <utility>

namespace chainreel {
namespace {

template <class... Style>
std::string print(double value, Style... style) {
  std::array<char, 400> text;  // the longest fixed-notation double has 309 digits before the point
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, style...);
  return std::string(text.data(), end.ptr);
}

}  // namespace

std::string format_shortest(double value) {
  return print(value);
}

std::string format_power(double value) {
  static constexpr std::array<const char*, 10> kSuperscripts = {
      "\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074", "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  int exponent = int(std::floor(std::log10(value)));
  long digit = std::lround(value / std::pow(10.0, exponent));
  if (digit == 10) digit = 1, ++exponent;
  std::string text = std::to_string(digit) + "\u00D710";
  for (const char c : std::to_string(exponent))
    text += c == '-' ? "\u207B" : kSuperscripts[std::size_t(c - '0')];
  return text;
}

std::string format_fixed(double value, int decimals) {
  std::string text = print(value, std::chars_format::fixed, decimals);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string format_significant(double value, int digits) {
  const std::string text = print(value == 0 ? 0.0 : value, std::chars_format::general, digits);
  // "430" instead of "4.3e+02".
  constexpr double kWritten = 1e5;
  return text.find('e') != std::string::npos && std::abs(value) >= 1 && std::abs(value) < kWritten ? format_fixed(*parse_number(text), 0) : text;
}

double rounded_down(double value, int digits) {
  if (!(value > 0)) return 0;
  const double last = std::pow(10, std::floor(std::log10(value)) - digits + 1);
  return std::floor(value / last) * last;
}

std::string format_digits(double value, int digits) {
  const std::string usual = format_significant(value, digits);
  const std::optional<double> rounded = parse_number(usual);
  if (!rounded || *rounded == 0 || usual.find('e') != std::string::npos) return usual;
  return format_fixed(value, std::max(digits - 1 - int(std::floor(std::log10(std::abs(*rounded)))), 0));
}

std::string lower_case_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return ending;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : between) + words[i];
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> separated(const std::string& text, char sign) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, sign);) parts.push_back(part);
  return parts;
}

std::string quoted_list(const std::vector<std::string>& names) {
  return names.empty() ? "" : "'" + joined(names, "', '") + "'";
}

std::string bracketed(const std::vector<double>& values, int digits) {
  std::vector<std::string> words;
  for (const double x : values) words.push_back(format_significant(x, digits));
  return "[" + joined(words) + "]";
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

namespace {

// Bytes that a character has by its first one; 0 where none begins so.
std::size_t length_by(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

struct Character {
  std::size_t length = 0;  // bytes; 0: no UTF-8 begins here
  std::uint32_t code = 0;
  bool is_cut = false;  // good so far, but the text ends within
};

Character character_at(std::string_view text) {
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const auto first = static_cast<unsigned char>(text[0]);
  Character result{length_by(first), first, false};
  if (result.length < 2) return result;
  result.code = first & (0xFFU >> (result.length + 1));
  for (std::size_t i = 1; i < result.length; ++i) {
    if (i == text.size()) return {0, first, true};
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xC0) != 0x80) return {0, first, false};
    result.code = (result.code << 6) | (next & 0x3FU);
  }
  const bool is_surrogate = result.code >= 0xD800 && result.code < 0xE000;
  if (result.code < kLeast[result.length] || result.code > 0x10FFFF || is_surrogate) return {0, first, false};
  return result;
}

bool is_an_order(std::uint32_t code) {
  if (code == '\n' || code == '\t') return false;
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return true;
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

std::string escaped(std::uint32_t code) {
  char text[8];
  std::snprintf(text, sizeof text, "\\u%04x", unsigned(code & 0xFFFF));
  return text;
}

// Appends what can be shown of the text; returns how many bytes at its end are a character without its end.
std::size_t append_printable(std::string_view text, std::string& result) {
  while (!text.empty()) {
    const Character character = character_at(text);
    if (character.is_cut) return text.size();
    const std::size_t length = character.length > 0 ? character.length : 1;
    if (character.length == 0 || is_an_order(character.code))
      result += escaped(character.code);
    else
      result += text.substr(0, length);
    text.remove_prefix(length);
  }
  return 0;
}

}  // namespace

std::string PrintableStream::next(std::string_view piece) {
  std::string text = std::exchange(waiting_, {});
  text += piece;
  std::string result;
  result.reserve(text.size());
  const std::size_t left = append_printable(text, result);
  waiting_ = text.substr(text.size() - left);
  return result;
}

std::string PrintableStream::end() {
  std::string result;
  for (const char c : std::exchange(waiting_, {})) result += escaped(static_cast<unsigned char>(c));
  return result;
}

std::u32string code_points(std::string_view text) {
  std::u32string points;
  while (!text.empty()) {
    const Character character = character_at(text);
    points += character.length > 0 ? char32_t(character.code) : U'\uFFFD';
    text.remove_prefix(character.length > 0 ? character.length : 1);
  }
  return points;
}

std::string printable(std::string_view text) {
  PrintableStream stream;
  std::string result = stream.next(text);
  return result + stream.end();
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + ".. (" + std::to_string(text.size() - end) + " bytes more)";
}

}  // namespace chainreel

#include "core/format.hpp"

#include <array>
#include <charconv>
#include <cmath>

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

std::string format_exact(double value) {
  return print(value, std::chars_format::general, 17);
}

std::string format_fixed(double value, int decimals) {
  std::string text = print(value, std::chars_format::fixed, decimals);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string format_significant(double value, int digits) {
  return print(value == 0 ? 0.0 : value, std::chars_format::general, digits);
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : between) + words[i];
  return text;
}

std::string quoted_list(const std::vector<std::string>& names) {
  return names.empty() ? "" : "'" + joined(names, "', '") + "'";
}

std::string bracketed(const std::vector<double>& values) {
  std::vector<std::string> words;
  for (const double x : values) words.push_back(format_significant(x, 6));
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

}  // namespace chainreel

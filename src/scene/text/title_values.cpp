#include "scene/text/title_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>

#include "core/error.hpp"
#include "core/format.hpp"
#include "expr/expression.hpp"

namespace chainreel {
namespace {

constexpr std::string_view kInDegrees = "deg", kSignOfDegrees = "\u00B0";
constexpr int kDigitsOfDegrees = 10;  // fewer where panels are told apart by these

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string expression_in_words(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto is_word = [&](std::string_view word, bool behind_number) {
      const bool begins = i == 0 || !is_of_name(text[i - 1]) || (behind_number && is_digit(text[i - 1]));
      const std::size_t end = i + word.size();
      return begins && text.compare(i, word.size(), word) == 0 && (end >= text.size() || !is_of_name(text[end]));
    };
    if (is_word(kInDegrees, true)) {
      while (result.ends_with(' ')) result.pop_back();
      result += kSignOfDegrees;
      i += kInDegrees.size() - 1;
    } else if (is_word("pi", false)) {
      result += "\u03C0";
      ++i;
    } else if (text[i] == '*') {
      while (result.ends_with(' ')) result.pop_back();
      while (i + 1 < text.size() && text[i + 1] == ' ') ++i;
      result += "\u00B7";
    } else {
      result += text[i];
    }
  }
  return with_minus_signs(result);
}

// Of an expression in nothing, "pi/2".
std::optional<double> constant_of(const std::string& text) {
  try {
    const Expression expression = Expression::parse(text, {}, {});
    if (expression.is_constant()) return expression.evaluate(std::span<const double>());
  } catch (const Error&) {
  }
  return {};
}

// Such as "\u03C0/2" of 1.5707963267948966: what someone wrote so, since no other number has these digits.
std::optional<std::string> part_of_pi(double number) {
  constexpr int kMostOver = 24, kMostUnder = 12;
  for (int under = 1; under <= kMostUnder; ++under) {
    const double over = std::round(number * under / std::numbers::pi);
    if (over < 1 || over > kMostOver || std::abs(over * std::numbers::pi / under - number) > 4e-16 * number) continue;
    return (over == 1 ? "" : format_shortest(over)) + "\u03C0" + (under == 1 ? "" : "/" + std::to_string(under));
  }
  return {};
}

// Of "1e-06" at its letter.
std::optional<double> power_at(const std::string& text, std::size_t at) {
  if (at >= text.size() || text[at] != 'e') return {};
  std::size_t end = at + 1;
  if (end < text.size() && (text[end] == '-' || text[end] == '+')) ++end;
  while (end < text.size() && is_digit(text[end])) ++end;
  return parse_number(text.substr(at + 1, end - at - 1));
}

}  // namespace

std::string with_minus_signs(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == ' ' || text[i - 1] == '(';
    if (text[i] == '-' && begins && i + 1 < text.size())
      result += "\u2212";
    else
      result += text[i];
  }
  return result;
}

TitleValue title_value(const std::string& written, const std::string& unit) {
  const std::string text = trimmed(written);
  if (text.ends_with("deg/s") && parse_number(trimmed(text.substr(0, text.size() - 5)))) return {with_minus_signs(trimmed(text.substr(0, text.size() - 5))) + "\u00B0", "/s"};
  const bool is_in_degrees = text.ends_with(kInDegrees);
  const std::optional<double> number = parse_number(is_in_degrees ? trimmed(text.substr(0, text.size() - kInDegrees.size())) : text);
  if (!number) {
    const std::optional<double> angle = unit == "rad" ? constant_of(text) : std::nullopt;
    return angle ? title_value(format_shortest(*angle), unit) : TitleValue{expression_in_words(text), ""};
  }
  const std::string degrees(kSignOfDegrees);
  if (is_in_degrees) return {expression_in_words(text), unit == "rad/s" ? "/s" : ""};
  if (unit == "rad") return {with_minus_signs(format_significant(*number * 180 / std::numbers::pi, kDigitsOfDegrees)) + degrees, ""};
  return {with_minus_signs(text), unit};
}

std::string joined_value(const TitleValue& value) {
  const bool is_close = value.unit.empty() || value.unit.starts_with('/');
  return value.words + (is_close ? "" : " ") + value.unit;
}

std::string joined_values(const std::vector<TitleValue>& values) {
  if (values.empty()) return "()";
  const bool has_one_unit = std::ranges::all_of(values, [&](const TitleValue& one) { return one.unit == values.front().unit && !one.unit.starts_with('/'); });
  std::vector<std::string> words;
  for (const TitleValue& one : values) words.push_back(has_one_unit ? one.words : joined_value(one));
  return "(" + joined(words) + ")" + (has_one_unit && !values.front().unit.empty() ? " " + values.front().unit : "");
}

std::string with_readable_numbers(const std::string& text) {
  constexpr std::size_t kReadable = 7;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
    const std::string word = text.substr(i, std::max<std::size_t>(end - i, 1));
    const bool is_long = word.size() > kReadable && word.find('.') != std::string::npos;
    const std::optional<double> number = is_long ? parse_number(word) : std::nullopt;
    const std::optional<double> power = end > i ? power_at(text, end) : std::nullopt;
    const std::optional<std::string> pi = number && !power ? part_of_pi(*number) : std::nullopt;
    const std::string shown = pi ? *pi : number ? format_significant(*number, 4) : word;
    i += word.size();
    if (!power) {
      result += shown;
      continue;
    }
    // "10\u207B\u2076" of 1e-06.
    const std::string ten = format_power(std::pow(10.0, *power));
    result += (shown == "1" ? "" : shown + "\u00D7") + ten.substr(ten.find("10"));
    while (i < text.size() && (text[i] == 'e' || text[i] == '-' || text[i] == '+' || is_digit(text[i]))) ++i;
  }
  return result;
}

}  // namespace chainreel

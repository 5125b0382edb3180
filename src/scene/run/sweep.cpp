#include "scene/run/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/format.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

constexpr int kMostValues = 10000;

// What stands outside of brackets, and of quotes that open a value or an entry; all of it where these do not close, as in words.
std::string outside_text(const std::string& text) {
  std::string outside = text, closing;
  char before = ',';
  for (char& c : outside) {
    const char sign = c;
    const bool is_quote = sign == '"' || sign == '\'', is_quoted = !closing.empty() && (closing.back() == '"' || closing.back() == '\'');
    const std::size_t bracket = std::string_view("[{(").find(sign);
    if (!closing.empty()) c = ' ';
    if (!closing.empty() && sign == closing.back())
      closing.pop_back();
    else if (!is_quoted && bracket != std::string_view::npos)
      closing += "]})"[bracket];
    else if (!is_quoted && is_quote && std::string_view(",[{(:").find(before) != std::string_view::npos)
      closing += sign;
    if (sign != ' ') before = sign;
  }
  return closing.empty() ? outside : text;
}

std::vector<std::string> split(const std::string& text, char separator) {
  const std::string outside = outside_text(text);
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = outside.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

struct Asked {
  const std::string& option;
  const std::string& example;
};

[[noreturn]] void refuse(const std::string& text, const Asked& asked, const std::string& why) {
  throw Error(ExitCode::usage, asked.option +
                                   " takes KEY=a,b,c or KEY=from:to:count, maybe with :log behind it, like " +
                                   asked.option + " " + asked.example + "; '" + text + "' " + why);
}

double number_in(const std::string& part, const std::string& text, const Asked& asked) {
  try {
    return parse_quantity(part, {});
  } catch (const Error&) {
    refuse(text, asked, "holds '" + part + "', which is no number");
  }
}

// The decimal number of at most 12 digits that a value is but for rounding, else itself: of 1:0:6 the fifth is 0.2. `size`: of
// what it was computed from.
double meant_decimal(double value, double size) {
  constexpr double kOfProducts = 8 * std::numeric_limits<double>::epsilon();  // of a product, a sum, a power
  if (std::abs(value) <= kOfProducts * size) return 0;
  const double near = parse_number(format_significant(value, 12)).value_or(value);
  return std::abs(near - value) <= kOfProducts * size ? near : value;
}

void fill_range(Sweep& sweep, const std::vector<std::string>& parts, const std::string& text,
                const Asked& asked) {
  sweep.logarithmic = parts.size() == 4;
  if (parts.size() < 3 || parts.size() > 4 || (sweep.logarithmic && parts[3] != "log"))
    refuse(text, asked, "is no range");
  const double from = number_in(parts[0], text, asked), to = number_in(parts[1], text, asked);
  // Kept beside the numbers, so that the key sees whether it is one of its own.
  sweep.unit = unit_kind(parts[1]);
  if (const std::string first = unit_kind(parts[0]); !first.empty() && !sweep.unit.empty() && first != sweep.unit)
    refuse(text, asked, "goes from " + first + " to " + sweep.unit);
  else if (sweep.unit.empty())
    sweep.unit = first;
  const auto count = parse_number(parts[2]);
  if (!count || *count != std::floor(*count) || *count < 2 || *count > kMostValues)
    refuse(text, asked, "needs a count between 2 and " + std::to_string(kMostValues));
  if (!std::isfinite(to - from)) refuse(text, asked, "spans more than numbers can tell");
  if (sweep.logarithmic && !((from > 0 && to > 0) || (from < 0 && to < 0)))
    refuse(text, asked, "needs ends of one sign for equal factors");
  const int n = int(*count);
  for (int k = 0; k < n; ++k) {
    const double s = double(k) / (n - 1);
    double value = sweep.logarithmic ? from * std::pow(to / from, s) : from + s * (to - from);
    value = k == n - 1 ? to : meant_decimal(value, sweep.logarithmic ? std::abs(value) : std::max(std::abs(from), std::abs(to)));
    sweep.numbers.push_back(value);
    sweep.values.push_back(format_shortest(value));
  }
}

}  // namespace

Sweep parse_sweep(const std::string& text, const std::string& option, const std::string& example) {
  const Asked asked{option, example};
  Sweep sweep;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    refuse(text, asked, "names no key or no values");
  sweep.key = text.substr(0, equals);
  const std::string list = text.substr(equals + 1);
  if (outside_text(list).find(':') != std::string::npos) {
    fill_range(sweep, split(list, ':'), text, asked);
    return sweep;
  }
  sweep.values = split(list, ',');
  for (const std::string& value : sweep.values) {
    if (value.empty()) refuse(text, asked, "has an empty value");
    const auto number = parse_number(value);
    if (number) sweep.numbers.push_back(*number);
  }
  if (sweep.numbers.size() != sweep.values.size()) sweep.numbers.clear();
  return sweep;
}

}  // namespace chainreel

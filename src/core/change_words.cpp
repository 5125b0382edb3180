#include "core/change_words.hpp"

#include <cmath>
#include <numbers>

#include "core/format.hpp"

namespace chainreel {

std::string amount_text(const std::string& number, const std::string& unit) {
  return number + (unit.empty() ? "" : " " + unit);
}

std::string change_text(const std::string& before, const std::string& after) {
  return before + " -> " + after;
}

std::string change_text(double before, double after, const std::string& unit) {
  const double most = 0.02 * std::abs(after - before);  // that rounding may take away
  const auto rounds = [&](double value, int digits) {
    return !(std::abs(parse_number(format_significant(value, digits)).value_or(0) - value) <= most);
  };
  int digits = 6;
  while (digits < 17 && (rounds(before, digits) || rounds(after, digits))) ++digits;
  const auto text = [&](double value) {
    return digits < 17 ? format_significant(value, digits) : format_shortest(value);
  };
  return amount_text(change_text(text(before), text(after)), unit);
}

std::string length_text(double metres) {
  return std::abs(metres) < 0.9995 ? format_significant(1000 * metres, 3) + " mm"
                                   : format_significant(metres, 3) + " m";
}

std::string angle_text(double radians) {
  return format_significant(180 / std::numbers::pi * radians, 3) + " deg";
}

}  // namespace chainreel

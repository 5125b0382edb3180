#include "core/change_words.hpp"

#include <cmath>
#include <numbers>

#include "core/format.hpp"

namespace chainreel {

std::string change_text(const std::string& before, const std::string& after) {
  return before + " -> " + after;
}

std::string change_text(double before, double after, const std::string& unit) {
  return change_text(format_shortest(before), format_shortest(after)) + (unit.empty() ? "" : " " + unit);
}

std::string length_text(double metres) {
  return std::abs(metres) < 0.9995 ? format_significant(1000 * metres, 3) + " mm" : format_significant(metres, 3) + " m";
}

std::string angle_text(double radians) {
  return format_significant(180 / std::numbers::pi * radians, 3) + " deg";
}

}  // namespace chainreel

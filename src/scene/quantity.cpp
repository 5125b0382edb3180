#include "scene/quantity.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/format.hpp"
#include "expr/expression.hpp"

namespace chainreel {
namespace {

struct Unit {
  std::string_view name;
  std::string_view si;  // of the same kind
  double factor;        // of one of it in that
};

constexpr double kRounding = 1e-12;  // of an angle that is computed in two ways
constexpr double kDegree = std::numbers::pi / 180;
// Longer names before those that they end with.
constexpr Unit kUnits[] = {{"N m s/rad", "N m s/rad", 1}, {"N m/rad", "N m/rad", 1}, {"N s/m", "N s/m", 1}, {"N/m", "N/m", 1},
                           {"deg/s", "rad/s", kDegree}, {"rad/s", "rad/s", 1},   {"mm/s", "m/s", 1e-3}, {"cm/s", "m/s", 1e-2},
                           {"m/s^2", "m/s^2", 1},       {"m/s", "m/s", 1},       {"1/s", "1/s", 1},     {"N m", "N m", 1},
                           {"deg", "rad", kDegree},     {"\u00b0", "rad", kDegree},  {"rad", "rad", 1},       {"min", "s", 60},      {"ms", "s", 1e-3},
                           {"us", "s", 1e-6},           {"mm", "m", 1e-3},       {"cm", "m", 1e-2},     {"km", "m", 1e3},
                           {"kg", "kg", 1},             {"Hz", "1/s", 1},        {"px", "px", 1},       {"N", "N", 1},
                           {"J", "J", 1},               {"h", "s", 3600},        {"g", "kg", 1e-3},     {"s", "s", 1},
                           {"m", "m", 1}};

constexpr Unit kRadian{"rad", "rad", 1};

struct Split {
  std::string number;
  const Unit* unit = nullptr;
};

bool has_degrees(const std::string& text) {
  return text.find("deg") != std::string::npos || text.find("\u00b0") != std::string::npos;
}

// A unit stands behind a figure, a bracket or a space, or behind pi; elsewhere its letters belong to a word.
Split split(const std::string& text) {
  const std::size_t last = text.find_last_not_of(" \t");
  const std::string trimmed = last == std::string::npos ? "" : text.substr(0, last + 1);
  for (const Unit& unit : kUnits) {
    if (!trimmed.ends_with(unit.name)) continue;
    const std::string number = trimmed.substr(0, trimmed.size() - unit.name.size());
    const std::size_t end = number.find_last_not_of(" \t");
    if (end == std::string::npos) continue;
    const unsigned char before = static_cast<unsigned char>(number.back());
    const bool stands_apart = std::isdigit(before) || before == '.' || before == ')' || before == ' ';
    if (!stands_apart && !number.ends_with("pi")) continue;
    if (has_degrees(number)) break;  // a sum of several angles
    return {number.substr(0, end + 1), &unit};
  }
  return {trimmed, has_degrees(trimmed) ? &kRadian : nullptr};
}

// Whether `si` is among "rad or m".
bool is_among(std::string_view si, std::string_view wanted) {
  for (std::size_t begin = 0; begin <= wanted.size();) {
    const std::size_t end = std::min(wanted.find(" or ", begin), wanted.size());
    if (wanted.substr(begin, end - begin) == si) return true;
    begin = end + 4;
  }
  return false;
}

}  // namespace

bool has_unit(const std::string& text) {
  return split(text).unit != nullptr;
}

std::string unit_kind(const std::string& text) {
  const Unit* unit = split(text).unit;
  return unit == nullptr ? "" : std::string(unit->si);
}

double parse_quantity(const std::string& text, const Place& place, const std::string& in) {
  const auto [value, unit] = split(text);
  const std::optional<double> number = Expression::parse(value, {}, place).constant();
  if (!number || !(*number - *number == 0))
    throw Error(ExitCode::bad_input, "'" + text + "' is not a finite number", place);
  if (unit == nullptr) return *number;
  if (!in.empty() && !is_among(unit->si, in))
    throw Error(ExitCode::bad_input, "'" + text + "' is in " + std::string(unit->name) + ", but this is in " + in, place);
  const double in_si = *number * unit->factor;
  // As expressions read it, where degrees stand right behind the last number.
  const bool is_glued = has_degrees(std::string(unit->name)) && unit->si == "rad" && std::isdigit(static_cast<unsigned char>(value.back())) &&
                        text.find(value + std::string(unit->name)) != std::string::npos;
  if (!is_glued) return in_si;
  const std::optional<double> read = Expression::parse(value + std::string(unit->name), {}, place).constant();
  if (!read || !(std::abs(*read - in_si) <= kRounding * std::abs(in_si)))
    throw Error(ExitCode::bad_input,
                "'" + text + "' is " + format_significant(in_si / kDegree, 6) + "deg as a whole, but " +
                    (read ? format_significant(*read / kDegree, 6) + "deg" : "no number") +
                    " where deg belongs to its last number: give each its own unit, or write one number",
                place);
  return in_si;
}

std::string doubt_of_angle(const std::string& text, double value, const std::string& of) {
  const double turns = std::abs(value) / (2 * std::numbers::pi);
  if (!(turns > 1) || has_unit(text)) return "";
  return text + of + " is in radians, " + format_significant(turns, 3) + " turns: for degrees write " + text + "deg, for radians " + text +
         "rad";
}

double parse_angle(const std::string& text, const Place& place) {
  const double angle = parse_quantity(text, place, "rad");
  if (const std::string doubt = doubt_of_angle(text, angle); !doubt.empty()) throw Error(ExitCode::bad_input, doubt, place);
  return angle;
}

}  // namespace chainreel

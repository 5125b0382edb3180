#include "sim/choice/accuracy.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr std::array<const char*, 4> kUnits = {"px", "m", "rad", "relative"};
// What doubles hold of a motion's size, and of an angle: some roundings. What metres are to a mechanism shows when it
// is there.
constexpr double kLeastShare = 1e-15;    // relative, rad
constexpr double kLeastPx = 1e-12;  // a page is 1080 px high

std::optional<double> least_of(const std::string& unit) {
  if (unit == "m") return {};
  return unit == "px" ? kLeastPx : kLeastShare;
}

}  // namespace

Accuracy parse_accuracy(const std::string& text) {
  const std::size_t end = text.find_first_of(" \t");
  const std::size_t begin_unit = end == std::string::npos ? end : text.find_first_not_of(" \t", end);
  Accuracy accuracy;
  accuracy.unit = begin_unit == std::string::npos ? "relative" : text.substr(begin_unit);
  const auto value = parse_number(text.substr(0, end));
  if (!value || !(*value > 0) || std::find(kUnits.begin(), kUnits.end(), accuracy.unit) == kUnits.end())
    throw Error(ExitCode::bad_input, "'" + text +
                                         "' is no accuracy: write a number above 0 with a unit, like 0.1 px, "
                                         "1e-3 m, 0.01 rad or 1e-6 relative");
  if (const auto least = least_of(accuracy.unit); least && *value < *least)
    throw Error(ExitCode::bad_input, "'" + text + "' is below what doubles hold: ask for " +
                                         format_shortest(*least) + " " + accuracy.unit +
                                         " at the least, and for a long motion for a thousand times that");
  accuracy.value = *value;
  return accuracy;
}

std::string to_string(const Accuracy& accuracy) {
  return format_shortest(accuracy.value) + " " + accuracy.unit;
}

}  // namespace chainreel

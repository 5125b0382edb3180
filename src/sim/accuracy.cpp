#include "sim/accuracy.hpp"

#include <optional>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

// What doubles hold of a motion's size, and of an angle: some roundings. What metres are to a mechanism shows when it
// is there.
constexpr double kLeastShare = 1e-15;    // relative, rad
constexpr double kLeastPx = 1e-12;  // a page is 1080 px high

std::optional<double> least_of(AccuracyUnit unit) {
  if (unit == AccuracyUnit::m) return {};
  return unit == AccuracyUnit::px ? kLeastPx : kLeastShare;
}

}  // namespace

std::span<const Name> names_of(AccuracyUnit) {
  static constexpr Name names[] = {
      {"px", "1/1080 of the fitted scene's height, whatever the output's size"},
      {"m", "metres"},
      {"rad", "angles of turning joints and of floating bases; ways of sliders and bases over the motion's diagonal"},
      {"relative", "to the diagonal of the box in which the motion happens"}};
  return names;
}

Accuracy parse_accuracy(const std::string& text) {
  const std::size_t end = text.find_first_of(" \t");
  const std::size_t begin_unit = end == std::string::npos ? end : text.find_first_not_of(" \t", end);
  const auto unit = begin_unit == std::string::npos ? AccuracyUnit::relative
                                                    : value_named<AccuracyUnit>(text.substr(begin_unit));
  const auto value = parse_number(text.substr(0, end));
  if (!value || !(*value > 0) || !unit)
    throw Error(ExitCode::bad_input, "'" + text +
                                         "' is no accuracy: write a number above 0 with a unit, like 0.1 px, "
                                         "1e-3 m, 0.01 rad or 1e-6 relative");
  if (const auto least = least_of(*unit); least && *value < *least)
    throw Error(ExitCode::bad_input, "'" + text + "' is below what doubles hold: ask for " +
                                         to_string(Accuracy{*least, *unit}) +
                                         " at the least, and for a long motion for a thousand times that");
  return {*value, *unit};
}

std::string to_string(const Accuracy& accuracy) {
  return format_shortest(accuracy.value) + " " + to_string(accuracy.unit);
}

}  // namespace chainreel

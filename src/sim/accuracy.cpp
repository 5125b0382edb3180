#include "sim/accuracy.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr std::array<const char*, 4> kUnits = {"px", "m", "rad", "relative"};

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
  accuracy.value = *value;
  return accuracy;
}

std::string to_string(const Accuracy& accuracy) {
  return format_shortest(accuracy.value) + " " + accuracy.unit;
}

}  // namespace chainreel

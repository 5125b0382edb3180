#include "app/sweep/map_axes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "app/sweep/parameter_unit.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "model/model_description.hpp"
#include "scene/keys/keys.hpp"
#include "scene/run/prepare.hpp"
#include "table/data_table.hpp"

namespace chainreel {

namespace {

// As the table of keys has it, where that is one unit; "": none, or one that the model knows.
std::string unit_of_key(const std::string& key) {
  const SceneKey* const row = find_key(key);
  std::string unit = row != nullptr && row->unit.find(" or ") == std::string::npos ? row->unit : "";
  if (const std::size_t square = unit.find("^2"); square != std::string::npos) unit.replace(square, 2, "\u00B2");
  return unit;
}

}  // namespace

std::string title_of_key(const std::string& key) {
  if (key == "payload.mass") return with_unit("payload", unit_of_key(key));
  if (key.starts_with("push.") && key.find("force.") != std::string::npos) return "push, force " + key.substr(key.rfind('.') + 1) + " [N]";
  for (const std::string prefix : {"parameters.", "start.q.", "start.qd."}) {
    if (!key.starts_with(prefix)) continue;
    const std::string rest = key.substr(prefix.size());
    if (prefix == "parameters.") return rest;
    const std::string symbol = prefix == "start.q." ? "q" : "qd";
    const bool is_number = rest.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? "$" + symbol + rest + "(0)$" : (symbol == "q" ? "" : "rate of ") + rest + " at t = 0";
  }
  return with_unit(key, unit_of_key(key));
}

std::string title_of_axis(const Sweep& sweep) {
  const std::string title = title_of_key(sweep.key);
  return title.ends_with(']') ? title : with_unit(title, sweep.unit);
}

Sweep with_unit_of(const Chain& chain, Sweep sweep) {
  struct OfCoordinate {
    std::string prefix;
    const char *of_angle, *of_length;
  };
  static const std::vector<OfCoordinate> kOf{{"start.q.", "rad", "m"}, {"start.qd.", "rad/s", "m/s"}, {"torque.", "N m", "N"},
                                             {"torque.pd.kp.", "N m/rad", "N/m"}, {"torque.pd.kd.", "N m s/rad", "N s/m"}};
  for (const OfCoordinate& of : kOf) {
    if (!sweep.unit.empty() || !sweep.key.starts_with(of.prefix)) continue;
    const std::optional<double> number = parse_number(sweep.key.substr(of.prefix.size()));
    const std::vector<DescribedCoordinate> coordinates = coordinates_of(chain);
    const bool is_one = number && *number >= 1 && *number <= double(coordinates.size());
    const std::string unit = is_one ? coordinates[std::size_t(*number) - 1].unit : "";
    if (unit == "rad" || unit == "m") sweep.unit = unit == "rad" ? of.of_angle : of.of_length;
  }
  return sweep;
}

Sweep with_unit_of_parameter(Scene scene, Sweep sweep) {
  const std::string prefix = "parameters.";
  if (!sweep.unit.empty() || !sweep.key.starts_with(prefix)) return sweep;
  const Chain chain = prepare(scene, false).chain;
  sweep.unit = unit_of_parameter(chain, scene, sweep.key.substr(prefix.size()));
  return sweep;
}

Axis map_axis(const Sweep& sweep) {
  Axis axis;
  axis.scale = sweep.logarithmic ? Scale::log : Scale::linear;
  const auto& v = sweep.numbers;
  if (sweep.logarithmic) {
    const double half = std::sqrt(v[1] / v[0]);
    axis.low = v.front() / half;
    axis.high = v.back() * half;
  } else {
    const double half = 0.5 * (v[1] - v[0]);
    axis.low = v.front() - half;
    axis.high = v.back() + half;
  }
  axis.title = title_of_axis(sweep);
  return axis;
}

// By what its numbers are shown: angles are read in degrees.
double degrees_of(const Sweep& sweep) {
  return !sweep.logarithmic && title_of_axis(sweep).find("[rad]") != std::string::npos ? 180 / std::numbers::pi : 1;
}

namespace {

// With ticks at the values, where these are few, and angles in degrees, as they are read.
Axis in_its_units(const Sweep& sweep, Axis axis) {
  constexpr std::size_t kFewValues = 12;
  if (!sweep.logarithmic && sweep.numbers.size() <= kFewValues) axis.at = sweep.numbers;
  const double degrees = degrees_of(sweep);
  if (degrees == 1) return axis;
  axis.title.replace(axis.title.find("[rad]"), 5, "[deg]");
  for (double* end : {&axis.low, &axis.high}) *end *= degrees;
  for (double& tick : axis.at) tick = std::round(1e9 * degrees * tick) / 1e9;
  return axis;
}

}  // namespace

Axis map_axis_in_units(const Sweep& sweep) {
  return in_its_units(sweep, map_axis(sweep));
}

Axis curve_axis_of(const Sweep& sweep) {
  return in_its_units(sweep, {sweep.logarithmic ? Scale::log : Scale::linear, sweep.numbers.front(), sweep.numbers.back(), title_of_axis(sweep)});
}

void require_curve_axis(const Sweep& sweep, const std::string& option) {
  const std::vector<double>& v = sweep.numbers;
  if (v.size() < 2 || !std::ranges::is_sorted(v, std::less_equal<>{}) || (sweep.logarithmic && !(v.front() > 0)))
    throw Error(ExitCode::usage, option + " of a picture takes rising numbers: KEY=from:to:count, or a list like KEY=0,1,2.5");
}

void require_map_axis(const Sweep& sweep, const std::string& option) {
  const auto& v = sweep.numbers;
  bool good = v.size() >= 2 && !(sweep.logarithmic && v[0] < 0);
  for (std::size_t k = 1; good && k < v.size(); ++k) {
    const double even =
        sweep.logarithmic ? v[0] * std::pow(v[1] / v[0], double(k)) : v[0] + double(k) * (v[1] - v[0]);
    good = v[k] > v[k - 1] && std::abs(v[k] - even) <= 1e-6 * std::abs(v[k] - v[0]);
  }
  if (!good)
    throw Error(ExitCode::usage,
                option +
                    " of a map takes a range of rising numbers: KEY=from:to:count, maybe with "
                    ":log behind it where they are above 0");
}

}  // namespace chainreel

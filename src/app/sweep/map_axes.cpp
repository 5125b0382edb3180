#include "app/sweep/map_axes.hpp"

#include <cmath>

#include "core/error.hpp"

namespace chainreel {

std::string title_of_key(const std::string& key) {
  if (key == "step") return "step [s]";
  if (key == "payload.mass") return "payload [kg]";
  for (const std::string prefix : {"parameters.", "start.q.", "start.qd."}) {
    if (!key.starts_with(prefix)) continue;
    const std::string rest = key.substr(prefix.size());
    if (prefix == "parameters.") return rest;
    const std::string symbol = prefix == "start.q." ? "q" : "qd";
    const bool is_number = rest.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? "$" + symbol + rest + "(0)$" : (symbol == "q" ? "" : "rate of ") + rest + " at t = 0";
  }
  return key;
}

std::string title_of_axis(const Sweep& sweep) {
  const std::string title = title_of_key(sweep.key);
  return sweep.unit.empty() || title.ends_with(']') ? title : title + " [" + sweep.unit + "]";
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

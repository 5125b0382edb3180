// One grammar for everything that varies a scene: KEY=a,b,c or KEY=from:to:count (equal distances) or
// KEY=from:to:count:log (equal factors), with dotted keys and indices as in --set: step, torque.1,
// parameters.k. Commas and colons within brackets or quotes belong to a value: torque=[1, 0],[0, 1].
#pragma once

#include <string>
#include <vector>

namespace chainreel {

struct Sweep {
  std::string key;
  std::vector<std::string> values;  // as they are written into the scene
  std::vector<double> numbers;      // the same; empty where one of them is no number
  bool logarithmic = false;
  std::string unit{};  // SI, of a range whose ends have one: 0:90deg:4 is in rad

  std::string setting(std::size_t k) const { return key + "=" + values[k] + unit; }
};

// Throws Error (usage) naming the option, with the example.
Sweep parse_sweep(const std::string& text, const std::string& option, const std::string& example = "step=1e-4:0.1:30:log");

}  // namespace chainreel

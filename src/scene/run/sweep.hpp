// One grammar for everything that varies a scene: KEY=a,b,c or KEY=from:to:count (equal distances) or
// KEY=from:to:count:log (equal factors), with dotted keys and indices as in --set: step, torque.1,
// parameters.k.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace chainreel {

struct Sweep {
  std::string key;
  std::vector<std::string> values;  // as they are written into the scene
  std::vector<double> numbers;      // the same; empty where one of them is no number
  bool logarithmic = false;

  std::string setting(std::size_t k) const { return key + "=" + values[k]; }
};

// Throws Error (usage) naming the option.
Sweep parse_sweep(const std::string& text, const std::string& option);

// Independent pieces of work on several threads.

// Each index below `count` once; what the first of them throws is thrown here.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& run);

}  // namespace chainreel

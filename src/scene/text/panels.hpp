// What tells the panels of a comparison apart, in words.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// What the numbers of a state are measured in: "rad", "m" or "".
struct CoordinateUnits {
  std::vector<std::string> q, freedoms;
  std::map<std::string, std::string> by_name;  // of coordinates
  friend bool operator==(const CoordinateUnits&, const CoordinateUnits&) = default;
};
CoordinateUnits units_of(const Chain& chain);

// Gives panels without a title one that says what differs: "explicit_euler", "step 0.01 s", "k = 100". To be
// asked when all defaults are filled in. `units`: of all panels; of none that are known, numbers have none.
void name_panels(std::vector<Scene>& panels, const CoordinateUnits& units = {});

// Whether all panels show one motion, computed in several ways: nothing but methods, with their steps and tolerances, and
// what is written beside them differs.
bool differ_by_method_alone(const std::vector<Scene>& panels);

}  // namespace chainreel

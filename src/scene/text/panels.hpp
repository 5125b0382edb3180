// What tells the panels of a comparison apart, in words.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace chainreel {

// Gives panels without a title one that says what differs: "explicit_euler", "step 0.01 s", "k = 100". To be
// asked when all defaults are filled in.
void name_panels(std::vector<Scene>& panels);

// Whether all panels show one motion, computed in several ways: nothing but methods, with their steps and tolerances, and
// what is written beside them differs.
bool differ_by_method_alone(const std::vector<Scene>& panels);

}  // namespace chainreel

// What panels differ in, in words: of keys that hold mappings, the kinds of them and what differs within a kind. Internal to this shelf.
#pragma once

#include <string>
#include <vector>

#include "scene/text/panels.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {

// "computed torque", "PD, $k_p$ = 50", "no push": each tells its panel from the others. Empty where the key holds no mapping, nor lists of
// such, in any panel. `entries`: one a panel, null where it is left out.
std::vector<std::string> words_by_leaf(const std::vector<const Scene*>& panels, const std::vector<const SceneEntry*>& entries,
                                       const CoordinateUnits& units);

}  // namespace chainreel

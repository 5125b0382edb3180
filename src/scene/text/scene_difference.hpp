// What two scenes, as `scene_text` writes them, say differently.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// A sentence a key in the order of the second: "method: rk4 -> dop853", "step: not given -> 0.01". Keys below
// others are dotted, entries of lists numbered from 1: "compare.2.title". Empty: the same. Throws Error (exit
// 3) where a text is no YAML.
std::vector<std::string> explain_scene_texts(const std::string& before, const std::string& after);

}  // namespace chainreel

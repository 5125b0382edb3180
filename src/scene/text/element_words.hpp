// What panels differ in, in words: of lists their elements, with symbols, as they were written. Internal to this shelf.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {

// "$k_p$" of kp: gains as formulas have them; other names stay.
std::string symbol_of_gain(const std::string& name);

// Signs as one reads them: "\u22120.5" of "-0.5".
std::string with_minus_signs(const std::string& text);

// What a list of numbers says of each panel, of starts, torques and gravity, where all panels have one of the same length: the elements
// that differ, "$q_2(0)$ = 30\u00B0", or all of it where all differ. Empty where that cannot be said so. `entries`: one a panel, or null.
std::vector<std::string> words_by_element(const std::vector<Scene>& panels, const std::vector<const SceneEntry*>& entries);

}  // namespace chainreel

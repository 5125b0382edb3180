// What two scenes, or two values of one key, say differently.
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// A sentence a key: "method rk4 -> dop853", "step: left out -> 0.01". Keys below others are dotted and
// entries of lists numbered from 1, as --set has them: "torque.2 1 -> 1.01"; of lists of words that grew or
// shrank it says what left them and what came: "draw: without trail, with ellipse". Other order of keys,
// other quotes are no difference.

// Of two scenes as `scene_text` writes them, keys in the order of the second. Throws Error (exit 3) where a
// text is no YAML.
std::vector<std::string> explain_scene_texts(const std::string& before, const std::string& after);

// Of two values of a key, each in one line of YAML; "": it is left out.
std::vector<std::string> key_changes(const std::string& key, const std::string& before,
                                     const std::string& after);

}  // namespace chainreel

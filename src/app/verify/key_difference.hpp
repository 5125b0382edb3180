// What differs between two values of a scene's key, down to the entry of a list: "torque.1: 0 -> 5".
#pragma once

#include <string>
#include <vector>

namespace chainreel {

// Both in one line of YAML, as scenes are written. Where both are lists of one length, or mappings, the entries that differ
// are told, by the names that --set has for them; "": the key is left out.
std::vector<std::string> key_changes(const std::string& key, const std::string& before, const std::string& after);

}  // namespace chainreel

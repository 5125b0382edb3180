// A scene as YAML, every key with its value, defaults included: what `check` prints and a file that reads
// back the same.
#pragma once

#include <string>
#include <vector>

#include "scene/keys/keys.hpp"

namespace chainreel {

// `model` is written as given: the text is meant for the working folder. Of several panels, what they share
// stands at the top, and each entry of `compare:` holds the rest of its panel.
std::string scene_text(const Scene& scene);

// What a panel can have for itself, in the order of the table; without its title.
std::vector<SceneEntry> entries_of(const Scene& scene);
// Those entries that all panels have, with the same value.
std::vector<SceneEntry> shared_entries(const std::vector<Scene>& panels);

}  // namespace chainreel

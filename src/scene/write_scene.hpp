// A scene as YAML, every key with its value, defaults included: what `check` prints and a file that reads
// back the same.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace chainreel {

// `model` is written as given: the text is meant for the working folder.
std::string scene_text(const Scene& scene);

}  // namespace chainreel

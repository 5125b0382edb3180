// A scene file, read and checked as far as that can be done without its model.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chainreel {

// `overrides` are texts `key=value` of the command line. Throws Error with every problem of the file.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

// A model file as a scene that names it and leaves all else to defaults and overrides, whose paths are relative to the
// model's folder. Throws Error as above.
Scene read_model_scene(const std::string& model, const std::vector<std::string>& overrides = {});

}  // namespace chainreel

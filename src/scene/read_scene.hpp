// A scene file, read and checked as far as that can be done without its model.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chainreel {

// `overrides` are texts `key=value` of the command line. Throws Error with every problem of the file.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace chainreel

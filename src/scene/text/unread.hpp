// Parameters that no expression reads, which a comparison of their values compares nothing by.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace chainreel {

// `key` is one that varies, `option` what it was given by (--vary, --over, --sweep). Throws Error (usage) where it is
// `parameters.NAME` and nothing in the scene (torques, references, events, plots, constraints) reads NAME.
void require_read(const std::string& key, const Scene& scene, const std::string& option);

}  // namespace chainreel

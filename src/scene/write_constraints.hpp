// Constraints as one line of YAML. Internal.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace chainreel {

std::string constraints_text(const Scene& scene);
std::string contact_force_text(const Scene& scene);

}  // namespace chainreel

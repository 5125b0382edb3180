// The second look at a URDF file: urdfdom reads masses, inertias, placements, axes, limits and shapes.
#pragma once

#include <string>

#include "model/urdf_file.hpp"

namespace chainreel {

// `plain` is the text that check_urdf prepared, without problems. Throws Error with urdfdom's own words where
// it refuses what the check let through.
void read_urdf_values(const std::string& plain, UrdfFile& file);

}  // namespace chainreel

// `camera:`, `links:` and `mesh_up:` of a scene. Internal.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

// What is wrong with an angle (rad), or with a distance (m, infinity for parallel rays): "" if nothing is.
// The text goes on behind the name of what was read.
std::string azimuth_problem(double azimuth);
std::string elevation_problem(double elevation);
std::string distance_problem(double distance);

void read_camera(Fields& fields, Scene& scene);
void read_body_shapes(Fields& fields, Scene& scene);

}  // namespace chainreel

// `camera:`, `links:` and `mesh_up:` of a scene. Internal.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

void read_camera(Fields& fields, Scene& scene);
void read_body_shapes(Fields& fields, Scene& scene);

}  // namespace chainreel

// `slow_motion:` of a scene. Internal.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

// After the scene's events, duration and frame rate, which it is checked against.
void read_slow_motion(Fields& fields, Scene& scene);

}  // namespace chainreel

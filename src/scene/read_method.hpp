// The keys method, step, tolerance, order and accuracy of a scene. Internal.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

void read_method(Fields& fields, Scene& scene);

}  // namespace chainreel

// The keys `constraints`, `stabilize`, `baumgarte` and `contact_force`. Internal.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

void read_constraints(Fields& fields, Scene& scene);

}  // namespace chainreel

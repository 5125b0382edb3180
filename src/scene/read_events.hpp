// The keys `frames`, `foot` and `events`. Internal.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

void read_events(Fields& fields, Scene& scene);

}  // namespace chainreel

// The key `plot`: what is plotted beside the scene.
#pragma once

#include "scene/fields.hpp"

namespace chainreel {

void read_plot(Fields& fields, Scene& scene);

}  // namespace chainreel

// In what a parameter is measured, of which a scene has numbers alone.
#pragma once

#include <string>

#include "model/chain.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// The one unit in which all torques that read it are N m or N, however long a metre, a second and a radian are, and however heavy a
// kilogram; "": several are, or none, or numbers of an expression may have units of their own.
std::string unit_of_parameter(const Chain& chain, const Scene& scene, const std::string& name);

}  // namespace chainreel

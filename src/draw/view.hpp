// Which way the camera looks at a chain.
#pragma once

#include "model/chain.hpp"
#include "picture/camera.hpp"

namespace chainreel {

// Planar chains: along the normal of their plane, up against gravity (its part in the plane), else +y, else
// +z, and that side of the plane from which x, else the first link, points to the right. Others: from azimuth
// 35 deg (0 sees x to the right) and elevation 20 deg, +z up. Scale 1 and origin 0: fitting comes later.
Camera view_of(const Chain& chain);

}  // namespace chainreel

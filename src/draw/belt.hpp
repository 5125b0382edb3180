// The mass felt along each direction as a curve about the end effector: see EllipseReading::belt. Internal.
#pragma once

#include "draw/ellipse.hpp"

namespace chainreel {

// In space: the three belts in the principal planes, and the silhouette of the surface 1 / (u^T Lambda_inv u).
void draw_belt(Picture& picture, const std::vector<MassAxis>& axes, Point center, const Camera& camera,
               const EllipseStyle& style, int clip);

}  // namespace chainreel

// The ellipsoid of a robot in space, cut by a plane through its middle.
#pragma once

#include <vector>

#include "draw/ellipse.hpp"

namespace chainreel {

// Semi-axes of the curve in which the plane of two perpendicular unit vectors (columns, in W) cuts the
// ellipsoid of this reading, as mass_axes gives those of the whole. With E the plane in the basis of Lambda,
// the curve of `mass` is f^T E^T Lambda_inv^2 E f = 1, that of `energy` v^T E^T Lambda E v = 1, that of
// `belt` 1 / (u^T E^T Lambda_inv E u). Chains in the plane have no ellipsoid: their ellipse itself.
std::vector<MassAxis> section_axes(const EffectiveMass& effective, const Eigen::Matrix<double, 3, 2>& plane,
                                   EllipseReading reading);

}  // namespace chainreel

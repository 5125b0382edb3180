// The shapes that a URDF gives by their measures, as triangles with the normals of the true surface.
#pragma once

#include <Eigen/Core>

#include "core/triangle_mesh.hpp"

namespace chainreel {

TriangleMesh box_mesh(const Eigen::Vector3d& edges);       // m, centred
TriangleMesh cylinder_mesh(double radius, double length);  // m, along z, centred
TriangleMesh sphere_mesh(double radius);                   // m

}  // namespace chainreel

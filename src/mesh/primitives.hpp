// The shapes that a URDF gives by their measures, and rounded ones, as triangles with the normals of the true surface.
#pragma once

#include <Eigen/Core>

#include "core/triangle_mesh.hpp"

namespace chainreel {

TriangleMesh box_mesh(const Eigen::Vector3d& edges);       // m, centred
TriangleMesh cylinder_mesh(double radius, double length);  // m, along z, centred
TriangleMesh sphere_mesh(double radius);                   // m
// Edges and corners are round with `radius`, m, at most half of the shortest edge: with just that, a capsule or a ball.
TriangleMesh rounded_box_mesh(const Eigen::Vector3d& edges, double radius);

}  // namespace chainreel

// Normals for triangles that bring none.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace chainreel {

using Point3f = std::array<float, 3>;

// Unit, counter-clockwise seen from outside; zero where the triangle has no area, not finite where a
// point is not.
Eigen::Vector3d face_normal(const Point3f& a, const Point3f& b, const Point3f& c);

// Edges that are flatter than this are meant to be round.
inline constexpr double kSmoothedEdge = 35;  // degrees

// A normal for each corner of triangles: the mean of the faces that meet there and differ from the corner's
// own by less than kSmoothedEdge, each weighted by its angle at that point, so that it does not matter how a
// face was cut into triangles. `corners` has three points a triangle; points are one where they are equal to
// the last bit. Corners of triangles without area have zero.
std::vector<Eigen::Vector3f> smooth_normals(const std::vector<Point3f>& corners);

}  // namespace chainreel

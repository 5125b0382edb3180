#include "mesh/smooth_normals.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "core/equal_items.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kCornersOfPoint = 6;  // where triangles cover a surface

Eigen::Vector3d vector_of(const Point3f& p) {
  return {double(p[0]), double(p[1]), double(p[2])};
}

// The angle at `at` between the directions to two points.
double angle_at(const Point3f& at, const Point3f& a, const Point3f& b) {
  const Eigen::Vector3d u = vector_of(a) - vector_of(at), v = vector_of(b) - vector_of(at);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

// The corners at each point, one row behind the other: those of point i stand from first[i] to first[i + 1].
struct CornersAtPoints {
  explicit CornersAtPoints(const std::vector<Point3f>& corners) {
    EqualItems<Point3f> points(corners.size() / kCornersOfPoint);
    point_of.reserve(corners.size());
    for (const Point3f& corner : corners) point_of.push_back(points.index_of(corner));
    first.assign(points.items.size() + 1, 0);
    for (const std::uint32_t point : point_of) ++first[point + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    row.resize(corners.size());
    std::vector<std::uint32_t> next = first;
    for (std::size_t c = 0; c < corners.size(); ++c) row[next[point_of[c]]++] = std::uint32_t(c);
  }

  std::vector<std::uint32_t> point_of, first, row;
};

}  // namespace

Eigen::Vector3d face_normal(const Point3f& a, const Point3f& b, const Point3f& c) {
  const Eigen::Vector3d from = vector_of(a);
  const Eigen::Vector3d n = (vector_of(b) - from).cross(vector_of(c) - from);
  const double length = n.norm();
  return length == 0 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(n / length);
}

std::vector<Eigen::Vector3f> smooth_normals(const std::vector<Point3f>& corners) {
  std::vector<Eigen::Vector3f> faces(corners.size() / 3);
  std::vector<float> angles(corners.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Point3f* p = &corners[3 * f];
    faces[f] = face_normal(p[0], p[1], p[2]).cast<float>();
    for (std::size_t c = 0; c < 3; ++c)
      angles[3 * f + c] = float(angle_at(p[c], p[(c + 1) % 3], p[(c + 2) % 3]));
  }

  const CornersAtPoints at(corners);
  const float flat = float(std::cos(kSmoothedEdge * M_PI / 180));
  std::vector<Eigen::Vector3f> normals(corners.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Eigen::Vector3f& own = faces[c / 3];
    Eigen::Vector3f sum(0, 0, 0);
    for (std::uint32_t i = at.first[at.point_of[c]]; i < at.first[at.point_of[c] + 1]; ++i) {
      const Eigen::Vector3f& face = faces[at.row[i] / 3];
      if (own.dot(face) > flat) sum += angles[at.row[i]] * face;
    }
    const float length = sum.norm();
    normals[c] = length > 0 ? Eigen::Vector3f(sum / length) : own;
  }
  return normals;
}

}  // namespace chainreel

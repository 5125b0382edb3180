#include "mesh/primitives.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/scalar.hpp"

namespace chainreel {
namespace {

// Corners of a circle: it strays from its polygon by 0.2 % of the radius, half a pixel at a radius of 230.
constexpr int kSegments = 48;
constexpr int kRings = kSegments / 2;  // of a sphere, from pole to pole

std::uint32_t add_vertex(TriangleMesh& mesh, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  TriangleMesh::Vertex vertex;
  for (std::size_t i = 0; i < 3; ++i) {
    vertex.position[i] = float(p[Eigen::Index(i)]);
    vertex.normal[i] = float(n[Eigen::Index(i)]);
  }
  vertex.color = {255, 255, 255, 255};
  mesh.vertices.push_back(vertex);
  return std::uint32_t(mesh.vertices.size() - 1);
}

void add_triangle(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
}

// Corner i of a circle of radius 1 about z. Corner kSegments is corner 0 to the last bit, so that no seam
// opens.
Eigen::Vector3d corner(int i) {
  const auto [s, c] = sin_cos(2 * M_PI * double(i % kSegments) / kSegments);
  return {c, s, 0};
}

void add_cap(TriangleMesh& mesh, double radius, double z, const Eigen::Vector3d& normal) {
  const std::uint32_t centre = add_vertex(mesh, {0, 0, z}, normal);
  for (int i = 0; i < kSegments; ++i) add_vertex(mesh, radius * corner(i) + Eigen::Vector3d(0, 0, z), normal);
  for (int i = 0; i < kSegments; ++i) {
    const std::uint32_t here = centre + 1 + std::uint32_t(i);
    const std::uint32_t next = centre + 1 + std::uint32_t((i + 1) % kSegments);
    if (normal[2] > 0)
      add_triangle(mesh, centre, here, next);
    else
      add_triangle(mesh, centre, next, here);
  }
}

}  // namespace

TriangleMesh box_mesh(const Eigen::Vector3d& edges) {
  TriangleMesh mesh;
  const Eigen::Vector3d half = 0.5 * edges;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d n = side * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d u = Eigen::Vector3d::Unit((axis + 1) % 3);
      const Eigen::Vector3d v = n.cross(u);  // u, v, n right-handed: counter-clockwise from outside
      const auto at = [&](double a, double b) {
        return add_vertex(mesh, half.cwiseProduct(n + a * u + b * v), n);
      };
      const std::uint32_t first = at(-1, -1);
      at(1, -1);
      at(1, 1);
      at(-1, 1);
      add_triangle(mesh, first, first + 1, first + 2);
      add_triangle(mesh, first, first + 2, first + 3);
    }
  }
  return mesh;
}

TriangleMesh cylinder_mesh(double radius, double length) {
  TriangleMesh mesh;
  const Eigen::Vector3d half(0, 0, 0.5 * length);
  for (int i = 0; i < kSegments; ++i) {
    add_vertex(mesh, radius * corner(i) - half, corner(i));
    add_vertex(mesh, radius * corner(i) + half, corner(i));
  }
  for (int i = 0; i < kSegments; ++i) {
    const std::uint32_t here = 2 * std::uint32_t(i), next = 2 * std::uint32_t((i + 1) % kSegments);
    add_triangle(mesh, here, next, next + 1);
    add_triangle(mesh, here, next + 1, here + 1);
  }
  add_cap(mesh, radius, -half[2], {0, 0, -1});
  add_cap(mesh, radius, half[2], {0, 0, 1});
  return mesh;
}

namespace {

// What bounds a body around its middle: rows of points about z from pole to pole. Calls add(n) for unit vectors n.
template <class Add>
void add_globe(TriangleMesh& mesh, int segments, int rings, double first_angle, const Add& add) {
  const std::uint32_t south = add({0, 0, -1});
  for (int ring = 1; ring < rings; ++ring) {
    const auto [s, c] = sin_cos(M_PI * double(ring) / rings);
    for (int i = 0; i < segments; ++i) {
      const auto [y, x] = sin_cos(first_angle + 2 * M_PI * double(i) / segments);
      add({s * x, s * y, -c});
    }
  }
  const std::uint32_t north = add({0, 0, 1});
  const auto at = [&](int ring, int i) { return south + 1 + std::uint32_t((ring - 1) * segments + i % segments); };
  for (int i = 0; i < segments; ++i) {
    add_triangle(mesh, south, at(1, i + 1), at(1, i));
    for (int ring = 1; ring + 1 < rings; ++ring) {
      add_triangle(mesh, at(ring, i), at(ring, i + 1), at(ring + 1, i + 1));
      add_triangle(mesh, at(ring, i), at(ring + 1, i + 1), at(ring + 1, i));
    }
    add_triangle(mesh, north, at(rings - 1, i), at(rings - 1, i + 1));
  }
}

}  // namespace

TriangleMesh sphere_mesh(double radius) {
  TriangleMesh mesh;
  add_globe(mesh, kSegments, kRings, 0, [&](const Eigen::Vector3d& n) { return add_vertex(mesh, radius * n, n); });
  return mesh;
}

TriangleMesh rounded_box_mesh(const Eigen::Vector3d& edges, double radius) {
  // Segments in fours and an odd number of rings: no point of the globe lies between two sides, so that its eighths can be moved
  // apart.
  constexpr int kCorners = 32, kRows = 17;
  TriangleMesh mesh;
  const Eigen::Vector3d apart = (0.5 * edges).array() - radius;
  add_globe(mesh, kCorners, kRows, M_PI / kCorners, [&](const Eigen::Vector3d& n) {
    Eigen::Vector3d p = radius * n;
    for (int i = 0; i < 3; ++i) p[i] += n[i] > 0 ? apart[i] : n[i] < 0 ? -apart[i] : 0;
    return add_vertex(mesh, p, n);
  });
  return mesh;
}

}  // namespace chainreel

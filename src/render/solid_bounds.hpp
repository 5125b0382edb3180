// What is asked of bodies in space before they are drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.hpp"
#include "picture/picture.hpp"

namespace chainreel {

// A box in a mesh's coordinates.
struct MeshBounds {
  std::array<double, 3> lower{}, upper{};
};
MeshBounds bounds_of(const TriangleMesh& mesh);

// All numbers are finite, all parts have a mesh, and as many numbers of its vertices as there are, if any. Whether its indices are right is seen when it is drawn.
bool is_drawable(const Solids& solids);

// The triangles in another order.
struct SortedTriangles {
  std::vector<std::uint32_t> indices;  // three a triangle
  std::size_t closed = 0;              // so many of them, at the front, are opaque and belong to closed parts
  std::size_t opaque = 0;              // ... are opaque; the others let something through
};

// An edge at which a surface bends sharply: from `a` to `b`, as the one of its two triangles runs, whose third corners are `left`
// and `right`.
struct Crease {
  std::uint32_t a = 0, b = 0, left = 0, right = 0;
};

// What a mesh's edges tell of it. Vertices at the same place count as one.
struct MeshSurface {
  // Which parts bound a volume, so that triangles that turn away from the viewer are never seen. A part is what hangs together by
  // edges. It is closed where every edge joins just two triangles that run along it in opposite directions, and the volume inside is
  // positive.
  SortedTriangles triangles;
  // The edges of two triangles at both ends of which their normals are more than 30 degrees apart.
  std::vector<Crease> creases;

  explicit MeshSurface(const TriangleMesh& mesh);
};

}  // namespace chainreel

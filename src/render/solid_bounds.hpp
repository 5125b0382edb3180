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

// All numbers are finite and all parts have a mesh. Whether its indices are right is seen when it is drawn.
bool is_drawable(const Solids& solids);

// Which parts of a mesh bound a volume, so that triangles that turn away from the viewer are never seen.

// The triangles in another order.
struct SortedTriangles {
  std::vector<std::uint32_t> indices;  // three a triangle
  std::size_t closed = 0;              // so many of them, at the front, are opaque and belong to closed parts
  std::size_t opaque = 0;              // ... are opaque; the others let something through
};

// A part is what hangs together by edges, with vertices at the same place counted as one. It is closed where
// every edge joins just two triangles that run along it in opposite directions, and the volume inside is
// positive.
SortedTriangles closed_parts_first(const TriangleMesh& mesh);

}  // namespace chainreel

// A mesh in the order in which bodies are drawn from it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/triangle_mesh.hpp"
#include "render/solid_bounds.hpp"

namespace chainreel {

struct SolidMesh {
  // Throws Error (exit 3) for triangles between vertices that are not there.
  explicit SolidMesh(std::shared_ptr<const TriangleMesh> whole);

  std::shared_ptr<const TriangleMesh> mesh;  // kept, so that no other mesh gets its place in memory
  MeshBounds bounds;
  SortedTriangles triangles;
  std::vector<Crease> creases;
  // Of each vertex, its numbers apart, so that four are placed at once; the last ones are repeated up to a multiple of 4.
  std::array<std::vector<float>, 3> position, normal;
  std::vector<std::uint32_t> color;  // blue, green, red and opacity from the lowest byte on, premultiplied
};

}  // namespace chainreel

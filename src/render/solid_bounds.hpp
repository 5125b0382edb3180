// Where bodies in space stand in view coordinates and on the page, without drawing them.
#pragma once

#include <optional>

#include "picture/picture.hpp"

namespace chainreel {

// A box in a mesh's coordinates.
struct MeshBounds {
  std::array<double, 3> lower{}, upper{};
};
MeshBounds bounds_of(const TriangleMesh& mesh);

// All numbers are finite and all parts have a mesh. Whether its indices are right is seen when it is drawn.
bool is_drawable(const Solids& solids);

// The bounds of everything in front of the eye; the two depths are view coordinates z.
struct SolidBounds {
  Rect page;  // with the outline
  double nearest = 0, farthest = 0;
};
// Nothing where there is nothing to see. `bounds` are those of the parts' meshes, in their order.
std::optional<SolidBounds> bounds_of(const Solids& solids, const std::vector<MeshBounds>& bounds);

}  // namespace chainreel

// How large a mesh file is: the box around its vertices.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

namespace chainreel {

inline constexpr std::size_t kLargestMeshFile = std::size_t(64) << 20;  // bytes

// An axis-aligned box; `lower` beyond `upper` while it is empty.
struct Box {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(-1e300);

  bool is_empty() const { return lower[0] > upper[0]; }
  void add(const Eigen::Vector3d& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  Eigen::Vector3d size() const {
    return is_empty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(upper - lower);
  }
};

// STL, OBJ or DAE, by the file's ending. The placements of all nodes count, and with them Collada's unit; its
// "up" does not, since a URDF has axes of its own. In metres where the file has a unit, in the file's numbers
// elsewhere. Throws Error: exit 3 for a file that is missing, of another kind or broken, exit 7 for one that
// is too large.
Box mesh_extents(const std::string& path);

}  // namespace chainreel

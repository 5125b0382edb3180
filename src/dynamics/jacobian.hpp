// The Jacobian of a frame's velocity in world (or in-plane) axes.
#pragma once

#include <string>
#include <vector>

#include "dynamics/workspace.hpp"

namespace chainreel {

enum class Task {
  linear,  // velocity of the frame's origin: 2 rows in the plane (ex, ey), else 3 (x, y, z)
  full,    // angular velocity first, then linear: planar 3 rows (about the normal, ex, ey), else 6
};

// The unit vectors, in W, along which the rows are measured; angular rows named "w_...".
struct TaskBasis {
  std::vector<std::string> names;           // e.g. {"x", "y"}
  std::vector<Eigen::Vector3d> directions;  // one a row
};
TaskBasis task_basis(const Chain& chain, Task task);

// Writes ws.J (rows x nv).
void compute_jacobian(const Chain& chain, Workspace& ws, ConstVec q, int frame, Task task);
// Writes ws.Jd_qd: the frame's acceleration when qdd = 0. (The time derivative of J itself is never formed.)
void compute_jacobian_rate(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, int frame, Task task);

}  // namespace chainreel

// Poses and velocities of bodies and frames.
#pragma once

#include <string>
#include <vector>

#include "dynamics/workspace.hpp"

namespace chainreel {

// Writes ws.X_WB, ws.v_WB, ws.w_WB. q: nq, qd: nv.
void compute_kinematics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);

// After compute_kinematics; `frame` is an index into chain.frames. World numbers.
Eigen::Isometry3d frame_pose(const Chain& chain, const Workspace& ws, int frame);
Eigen::Vector3d frame_position(const Chain& chain, const Workspace& ws, int frame);  // m
Eigen::Vector3d frame_velocity(const Chain& chain, const Workspace& ws, int frame);  // m/s

// q' = N(q) qd: the rate of the coordinates (quaternions of floating joints; qd itself elsewhere). nq
// numbers.
void q_rate(const Chain& chain, ConstVec q, ConstVec qd, Vec q_dot);
// q <- q (+) h qd along a constant qd.
void advance(const Chain& chain, Vec q, ConstVec qd, double h);
// Unit quaternions again.
void normalize(const Chain& chain, Vec q);

// The Jacobian of a frame's velocity in world (or in-plane) axes.

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
// "x", or "ex = (0.707, 0, 0.707)" of what is no axis of the world.
std::vector<std::string> words_of(const TaskBasis& basis);

// Writes ws.J (rows x nv).
void compute_jacobian(const Chain& chain, Workspace& ws, ConstVec q, int frame, Task task);
// Writes ws.Jd_qd: the frame's acceleration when qdd = 0. (The time derivative of J itself is never formed.)
void compute_jacobian_rate(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, int frame, Task task);

}  // namespace chainreel

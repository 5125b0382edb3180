// Poses and velocities of bodies and frames.
#pragma once

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

}  // namespace chainreel

// What the ground exerts on a chain that stands on it: the force and moment behind all joints of the world,
// and the support of the links that are fixed to it.
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N, in W
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, about the world's origin
};

// At this motion, whatever torques make it: by Newton and Euler the rate of all momentum less what gravity
// adds to it. Of planar chains the part in their plane. Writes ws.tau, too.
Wrench compute_ground_reaction(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd);

}  // namespace chainreel

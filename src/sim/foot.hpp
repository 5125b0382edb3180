// A foot that stands on the ground, fixed to the world, and the centre of pressure below it. A flat foot on
// the ground can stand only as long as that lies below it; beyond, it would tip about its heel or toe.
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

// Places along the ground, whose direction in the chain's plane is at right angles to gravity; positive
// towards +x, or, in a plane without x, towards +y. World numbers, m.
struct Foot {
  double heel = 0;
  double toe = 0;
  double height = 0;  // of the ground, against gravity
};

struct GroundAxes {
  Eigen::Vector3d along, up;  // in W
};
// Throws Error (bad input) for chains that move out of one plane or float, and where no gravity acts in it.
GroundAxes ground_axes(const Chain& chain);

// The place on the ground, m along it, where what the ground exerts on the robot has no moment: with force F
// and moment n about the world's origin (n + height F_along) / F_up. Infinite or no number where the ground
// bears nothing. The motion is the chain's own under some torque.
double center_of_pressure(const Chain& chain, Workspace& ws, const GroundAxes& axes, double height,
                          ConstVec q, ConstVec qd, ConstVec qdd);

}  // namespace chainreel

// The joints at which constraints close loops, which the chain's own tree does not hold.
#pragma once

#include <vector>

#include "draw/chain.hpp"
#include "sim/constraint_plan.hpp"

namespace chainreel {

// Places of the world at which a loop is closed on the ground, or a frame pinned to it.
std::vector<Eigen::Vector3d> closure_pins(const Chain& chain, const ConstraintPlan& plan);
// The ground below these.
void draw_closure_pins(Picture& picture, const ChainDrawing& drawing, const ConstraintPlan& plan, int clip);
// The joints themselves, after compute_kinematics.
void draw_closure_joints(Picture& picture, const ChainDrawing& drawing, const Workspace& ws,
                         const ConstraintPlan& plan, int clip);

}  // namespace chainreel

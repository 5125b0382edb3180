// A pose on the constraints, where the shortest way back onto them leads nowhere.
#pragma once

#include <vector>

#include "dynamics/constraints/constraint_projection.hpp"

namespace chainreel {

struct FoundPose {
  Projection way;         // the last part of it; `before` is the distance of the start that was given
  std::vector<double> q;  // nq numbers: on the constraints if way.reached, else the nearest that was found
};

// project_positions from q, and where that does not arrive from poses about q and about where it ended: a little aside
// by each freedom, by neighbours against each other and by all, in steps up to a radian (a metre), until one within a
// radian (a metre) arrives. A chain stretched out towards its line has a way of order two only, which the first
// derivatives do not see: its rows' matrix is singular or nearly so. Of those that arrive, that which moves q least.
// Always the same answer.
FoundPose find_pose(const Chain& chain, const ConstraintSet& set, ConstVec q);

}  // namespace chainreel

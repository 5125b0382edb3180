// Where the other joints of a mechanism stand when some are held: a linkage by the angle of its crank.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dynamics/constraints/constraint_set.hpp"
#include "dynamics/workspace.hpp"

namespace chainreel {

struct FollowedPose {
  std::vector<double> q;
  bool is_met = false;  // on the constraints to round-off; else the nearest that was found, `row` off by `away`
  double away = 0;      // m or rad
  int row = 0;
};

// Of a chain without a floating joint: coordinates that are `held` stay as they are, those that no constraint touches, too. Newton's method from q
// and from a fixed set of poses of the others finds the ways in which the mechanism can be put together; of these that is taken which is within the
// limits of joints, then the one whose orientation is the same for all values of what is held (the sign of det J of the others, where that is
// square: it changes at singular poses alone; negative, an elbow that is up), then the one nearest to q.
// `about`: coordinates that say about where they are meant, by which alone nearness is measured then, instead of the orientation.
// Angles are within half a turn, or within their limits. The same for the same chain, constraints and q.
FollowedPose followed_pose(const Chain& chain, const ConstraintSet& set, ConstVec q, const std::vector<bool>& held, std::span<const std::size_t> about = {});

}  // namespace chainreel

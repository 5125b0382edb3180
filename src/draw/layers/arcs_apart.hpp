// Arcs of torques about joints that come close to one another, as where a chain folds: both shrink as long as they then have
// room beside each other; where they have none any more, the second lies inside of the first, which grows around it.
#pragma once

#include <vector>

#include "picture/picture.hpp"

namespace chainreel {

struct TorqueArc {
  Point center;
  double radius = 0;  // units of H, as it would be alone
};

// What to multiply each radius by, without a jump from frame to frame: it depends on distances alone. `marks`: as in ChainLook.
std::vector<double> arcs_apart(const std::vector<TorqueArc>& arcs, double marks);

}  // namespace chainreel

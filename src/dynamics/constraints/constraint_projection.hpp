// Back onto the constraints, by the shortest way in the metric of M (as a mechanism would yield to an
// impulse):
//
//   positions   q <- q (+) -M^-1 Jc^T G^+ phi, repeated (Gauss-Newton: quadratic near phi = 0)
//   velocities  qd <- qd - M^-1 Jc^T G^+ (Jc qd), at once
//
// Positions alone leave velocities that point off the constraints: project both. E. Hairer, C. Lubich, G.
// Wanner, Geometric Numerical Integration, ch. VII.2.
#pragma once

#include "dynamics/constraints/constrained_workspace.hpp"

namespace chainreel {

struct Projection {
  bool reached = false;  // phi = 0 to round-off
  double before = 0;     // largest |phi|, m or rad: the distance of the start from the constraints
  double after = 0;
  double moved = 0;   // largest change of a coordinate (of a floating base: m along its axes, rad about them)
  int worst_row = 0;  // the row that `after` belongs to (`before`, where reached)
  int passes = 0;
};

// Moves q. Where the constraints cannot be reached q ends where nothing came nearer.
Projection project_positions(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                             ConstrainedWorkspace& cws, Vec q);

// Moves qd to Jc qd = 0 at q; returns the largest |Jc qd| before.
double project_velocities(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                          ConstrainedWorkspace& cws, ConstVec q, Vec qd);

}  // namespace chainreel

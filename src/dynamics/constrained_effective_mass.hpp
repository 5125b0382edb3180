// The effective mass of a frame of a constrained mechanism: of all accelerations that a force would give,
// those that the constraints leave,
//
//   Lambda_inv = J (M^-1 - M^-1 Jc^T G^+ Jc M^-1) J^T,   G = Jc M^-1 Jc^T
//
// (F. Aghili, IEEE Transactions on Robotics 21 (2005), sec. III; L. Sentis, J. Park, O. Khatib, ibid. 26
// (2010)). Directions that the constraints forbid have infinite mass and are named so.
#pragma once

#include "dynamics/constrained_workspace.hpp"
#include "dynamics/effective_mass.hpp"

namespace chainreel {

// Lambda is absent where a direction is infinite. Uses ws.J on the way.
EffectiveMass constrained_effective_mass_of(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                            ConstrainedWorkspace& cws, ConstVec q, int frame, Task task);

}  // namespace chainreel

// Inverse dynamics by the recursive Newton-Euler algorithm. Joint friction is apart (dynamics/friction.hpp).
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

// ws.tau = M(q) qdd + nle(q, qd), N m or N.
void compute_inverse_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd);
// ws.nle = C(q, qd) qd + tau_g(q)
void compute_nle(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);
// ws.tau_g
void compute_gravity_torque(const Chain& chain, Workspace& ws, ConstVec q);

}  // namespace chainreel

// Forward dynamics by the articulated-body algorithm: O(n). Not for chains with mimic joints (their
// coordinates are shared between bodies); compute_forward_dynamics takes the mass matrix there.
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

// ws.qdd = M(q)^-1 (tau - nle(q, qd)); joint friction is not subtracted here.
void compute_aba(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau);

}  // namespace chainreel

// The joint-space mass matrix by the composite-rigid-body algorithm.
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

// Writes ws.M (nv x nv, both halves).
void compute_mass_matrix(const Chain& chain, Workspace& ws, ConstVec q);

}  // namespace chainreel

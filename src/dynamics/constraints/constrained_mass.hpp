// M^-1 b for the rows of constraints. Short chains, and those whose bodies share coordinates, take L D L^T of
// the dense M; long ones the articulated inertias that the articulated-body algorithm leaves behind, so that
// a product costs O(n): R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 7.1, without velocity
// and gravity,
//
//   u = b - S^T p,  p_parent += X^T (p + U u / D)         back
//   a' = X a_parent,  x = (u - U^T a') / D,  a = a' + S x  out
#pragma once

#include "dynamics/constraints/constrained_workspace.hpp"
#include "dynamics/effective_mass.hpp"

namespace chainreel {

// Above so many freedoms the dense factor, whose cost grows with their cube, gives way to the articulated inertias.
inline constexpr int kDenseFreedoms = 16;
bool takes_dense_mass_matrix(const Chain& chain);

// Factors M at q, for solve_mass and compute_row_system. Places the bodies.
void factor_mass(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws, ConstVec q);

// The same where the bodies are placed; articulated: after aba at this pose.
void factor_placed_mass(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws);

// x = M^-1 b, after factor_mass; x may be b.
void solve_mass(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws, const double* b, double* x);

// cws.Z = M^-1 Jc^T and the factor of G = Jc Z, from cws.Jc.
void compute_row_system(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws);

// The effective mass of a frame of a constrained mechanism: of all accelerations that a force would give,
// those that the constraints leave,
//
//   Lambda_inv = J (M^-1 - M^-1 Jc^T G^+ Jc M^-1) J^T,   G = Jc M^-1 Jc^T
//
// (F. Aghili, IEEE Transactions on Robotics 21 (2005), sec. III; L. Sentis, J. Park, O. Khatib, ibid. 26
// (2010)). Directions that the constraints forbid have infinite mass and are named so.

// Lambda is absent where a direction is infinite. Uses ws.J on the way.
EffectiveMass constrained_effective_mass_of(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                            ConstrainedWorkspace& cws, ConstVec q, int frame, Task task);

}  // namespace chainreel

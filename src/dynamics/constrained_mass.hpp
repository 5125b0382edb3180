// M^-1 b for the rows of constraints. Short chains, and those whose bodies share coordinates, take L D L^T of
// the dense M; long ones the articulated inertias that the articulated-body algorithm leaves behind, so that
// a product costs O(n): R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 7.1, without velocity
// and gravity,
//
//   u = b - S^T p,  p_parent += X^T (p + U u / D)         back
//   a' = X a_parent,  x = (u - U^T a') / D,  a = a' + S x  out
#pragma once

#include "dynamics/constrained_workspace.hpp"

namespace chainreel {

// Of more freedoms the dense factor, whose cost grows with their cube, gives way to the articulated inertias.
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

}  // namespace chainreel

// phi, Jc and Jc_dot qd of every row of a set of constraints. With p, v, a the place, velocity and
// acceleration (at qdd = 0) of anchors A and B, w and alpha those of their turning, e and L constant, u and z
// axes fixed in B and A:
//
//   along     phi = e.(p_A - p_B) - c          Jc_dot qd = e.(a_A - a_B)
//   distance  phi = (d.d - L^2)/(2 L)          Jc_dot qd = (d.(a_A - a_B) + |v_A - v_B|^2)/L,   d = p_A - p_B
//   parallel  phi = u.z                        Jc_dot qd = n.(alpha_B - alpha_A) + n'.(w_B - w_A),
//             n = u x z,  n' = (w_B x u) x z + u x (w_A x z)
//   curve     phi = n.(p_A - c(s))             Jc_dot qd = n.a_A - kappa (t.v_A)^2/(1 - kappa phi),
//             s the foot point: c'(s).(p_A - c(s)) = 0, t the tangent, n a quarter turn to its left, kappa
//             the curvature (M. do Carmo, Differential Geometry of Curves and Surfaces, 1976, ch. 1.5)
//
// so that a multiplier is the force along e, the tension of the rod, the moment, or the force along n that
// the robot exerts on its surroundings.
#pragma once

#include "dynamics/constraints/constrained_workspace.hpp"
#include "dynamics/links.hpp"

namespace chainreel {

// Directions that the constraints leave free at a pose: columns of length 1 at right angles, nv rows. Rows that are multiples of
// others, to 1e-9, take none away.
Eigen::MatrixXd free_directions(const Chain& chain, Workspace& ws, const ConstraintSet& set, ConstVec q);

// Whether some of constraint k's rows are sums of multiples of others', to 1e-9: how they share a force no equation says. After compute_constraints.
bool repeats_others(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws, std::size_t k);

// Writes cws.phi, cws.Jc, cws.Jcd_qd.
void compute_constraints(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                         ConstrainedWorkspace& cws, ConstVec q, ConstVec qd);

// The first row of those that keep axes parallel whose frames stand the wrong way round, half a turn off,
// where phi = 0 holds, too; or -1. After compute_constraints at the same pose.
int reversed_row(Workspace& ws, const ConstraintSet& set);

// As compute_constraints, where links have been placed and located and hold v, and a for qdd = 0, of a world
// that accelerates by `base`.
template <class A>
void evaluate_rows(const Links<A>& links, const typename A::Motion& base, const ConstraintSet& set,
                   ConstrainedWorkspace& cws, ConstVec q);

}  // namespace chainreel

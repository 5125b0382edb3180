// Lagrange's equations, tau = d/dt dL/dqd - dL/dq with L = K - P, by automatic differentiation of the two
// energies. Nothing here is shared with the recursions: it is the other way to the same equations of motion.
//
// Floating joints: the coordinates are those of the local chart q = q0 exp(xi) at xi = 0, so that rates,
// torques and accelerations are the body's twist, wrench and rate of twist, as everywhere else.
#pragma once

#include <Eigen/Core>

#include "dynamics/workspace.hpp"

namespace chainreel {

struct LagrangeDynamics {
  Eigen::MatrixXd M;      // d2K / dqd dqd
  Eigen::VectorXd nle;    // d2K/dqd dq qd - dK/dq + dP/dq
  Eigen::VectorXd tau_g;  // dP/dq
  Eigen::VectorXd qdd;    // M^-1 (tau - nle - tau_f)
};

// Costs O(nv^2) evaluations of the energies: for inspection, not for the loop of a run.
LagrangeDynamics lagrange_dynamics_of(const Chain& chain, ConstVec q, ConstVec qd, ConstVec tau);

}  // namespace chainreel

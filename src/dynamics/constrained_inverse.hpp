// Inverse dynamics with multipliers, and multipliers as forces: tau = M qdd + nle + Jc^T lambda. (K. Lynch,
// F. Park, Modern Robotics, 2017, ch. 8.7 and 11.5.) Joint friction is apart, as in dynamics/rnea.hpp.
#pragma once

#include <Eigen/Core>

#include "dynamics/constrained_workspace.hpp"

namespace chainreel {

// ws.tau that moves the chain with qdd while it presses on its constraints with lambda. qdd must keep the
// constraints if the motion is to be that one.
void compute_constrained_inverse_dynamics(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                          ConstrainedWorkspace& cws, ConstVec q, ConstVec qd, ConstVec qdd,
                                          ConstVec lambda);

// The force that the robot exerts at the origin of constraint k's (first) frame with these multipliers, N
// along W; a line or plane takes its part across, a rod along. After compute_constraints at the pose; zero
// for conditions on coordinates.
Eigen::Vector3d contact_force(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws,
                              std::size_t k, ConstVec lambda);

// The multipliers with which constraint k bears the desired force f (N, W) at its frame: Jc = A J_frame, A^T
// lambda = f, lambda = (A^T)^+ f; the part of f that the constraint cannot bear is left out. After
// compute_constraints at the pose; writes the constraint's own entries of lambda.
void multipliers_of_force(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws,
                          std::size_t k, const Eigen::Vector3d& f, Vec lambda);

}  // namespace chainreel

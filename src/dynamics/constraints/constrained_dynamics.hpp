// Forward dynamics under constraints, with multipliers:
//
//   tau = M qdd + nle + tau_f + Jc^T lambda,   Jc qdd + Jcd_qd = 0,   G = Jc M^-1 Jc^T,
//   lambda = G^-1 (Jc M^-1 (tau - nle - tau_f) + Jcd_qd)
//
// (K. Lynch, F. Park, Modern Robotics, 2017, ch. 8.7, with this sign of lambda: +Jc^T lambda is the joint
// force that the robot exerts on its surroundings.) Where rows repeat each other, lambda is the shortest that
// does; where they contradict each other, qdd and lambda are the least squares of |Jc qdd + Jcd_qd|, and a
// status says so. How is in constrained_solver.hpp.
//
// Every pass starts from the true residual r = Jc qdd + Jcd_qd, taken from the accelerations:
// dlambda = G^-1 r (or the proximal one), lambda += dlambda, qdd -= M^-1 Jc^T dlambda. It ends where |r| is
// below the tolerance, or where |G r| is and no motion can change the rest.
#pragma once

#include <Eigen/Core>

#include "dynamics/constraints/constrained_workspace.hpp"

namespace chainreel {

struct ConstrainedOptions {
  // The largest |Jc qdd + Jcd_qd|, relative to 1 + the sum of the sizes of its parts: 45 round-offs.
  double tolerance = 1e-14;
  int most_passes = 30;
  // g of J. Baumgarte (Comput. Meth. Appl. Mech. Eng. 1 (1972)), 1/s: above zero rows are to have the
  // accelerations -2 g dphi/dt - g^2 phi, which are then part of Jcd_qd with the other sign.
  double gain = 0;
  double mu = 1e-8;  // of proximal passes, as a share of the mean of G's diagonal
  bool always_proximal =
      false;  // also where rows are independent: to compare, and to see the passes converge
};

// Writes qdd (nv numbers) and cws.lambda, status, residual, passes, rank; chains that have a kernel
// leave phi, Jc and Jcd_qd alone. Nothing is projected: phi(q) = 0 and Jc qd = 0 are the caller's.
ConstraintStatus compute_constrained_dynamics(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                              ConstrainedWorkspace& cws, ConstVec q, ConstVec qd,
                                              ConstVec tau, Vec qdd, const ConstrainedOptions& options = {});

// The same into ws.qdd.
ConstraintStatus compute_constrained_dynamics(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                              ConstrainedWorkspace& cws, ConstVec q, ConstVec qd,
                                              ConstVec tau, const ConstrainedOptions& options = {});

// Inverse dynamics with multipliers, and multipliers as forces: tau = M qdd + nle + Jc^T lambda. (K. Lynch,
// F. Park, Modern Robotics, 2017, ch. 8.7 and 11.5.) Joint friction is apart, as in dynamics/equation_of_motion.hpp.

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

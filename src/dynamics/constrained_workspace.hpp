// What the algorithms for constrained chains write, beside Workspace. Sized for one chain and one set of
// constraints when made; nothing is allocated afterwards.
#pragma once

#include <string>
#include <vector>

#include "dynamics/constrained_kernel.hpp"
#include "dynamics/constrained_solver.hpp"
#include "dynamics/constraint_set.hpp"
#include "dynamics/workspace.hpp"

namespace chainreel {

enum class ConstraintStatus {
  regular,        // all rows independent and fulfilled
  redundant,      // rows repeat each other, and are fulfilled
  inconsistent,   // rows contradict each other: the least squares of what they ask
  not_converged,  // the residual stayed above the tolerance
  not_finite,
};
std::string to_string(ConstraintStatus status);

struct ConstrainedWorkspace {
  ConstrainedWorkspace(const Chain& chain, const ConstraintSet& set);

  // compute_constraints; rows of them.
  std::vector<double> phi;     // m (rad for angles)
  std::vector<double> Jc;      // rows x nv, row by row
  std::vector<double> Jcd_qd;  // d/dt(Jc) qd: the rows' accelerations at qdd = 0

  // compute_constrained_dynamics.
  std::vector<double> lambda;  // N or N m: +Jc^T lambda is what the robot exerts on its surroundings
  ConstraintStatus status = ConstraintStatus::regular;
  double residual = 0;  // largest of |Jc qdd + Jcd_qd|
  int passes = 0;
  int rank = 0;

  // What an anchor does: place, velocity, acceleration at qdd = 0, in W (planar: the plane's basis).
  struct AnchorState {
    Vec3<double> p, v, w, a, alpha;
  };
  // A row of Jc as the forces and moments that a unit multiplier puts on its anchors.
  struct RowState {
    Vec3<double> f_a, n_a, f_b, n_b;
  };
  std::vector<AnchorState> anchor_states;
  std::vector<RowState> row_states;
  std::vector<double> curve_s;  // where the curves' foot points were last

  std::vector<double> Z;  // rows x nv: M^-1 Jc^T, transposed
  std::vector<double> M;  // nv x nv: the factor L D L^T of M, where M is taken dense
  std::vector<double> r, dlambda, tau, tau_net, qdd, dq;
  RowSolver solver;
  ConstrainedKernel kernel;
};

}  // namespace chainreel

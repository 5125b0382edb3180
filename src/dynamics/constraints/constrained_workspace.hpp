// What the algorithms for constrained chains write, beside Workspace. Sized for one chain and one set of
// constraints when made; nothing is allocated afterwards.
#pragma once

#include <string>
#include <vector>

#include "dynamics/constraints/constraint_set.hpp"
#include "dynamics/kernels/constrained_kernel.hpp"
#include "dynamics/workspace.hpp"

namespace chainreel {

// G x = r for the few rows of constraints, G = Jc M^-1 Jc^T, also where rows depend on each other.
//
// L D L^T in the given order finds the rows that earlier ones do not explain: d_i / G_ii is the squared sine
// of the angle, in the metric of M^-1, between row i and the span of those before it, whatever units the rows
// have. A row below kDependent is left out of the factor. With N an orthonormal basis of the null space of G,
// x - N N^T x of a solution x on the other rows is the Moore-Penrose solution when r fits.
//
// Where rows contradict each other, proximal passes lead to the least squares: (G + mu 1) dlambda = P r with
// P = 1 - N N^T, so that what no motion can remove never enters lambda. In the direction of an eigenvalue
// sigma of G a pass leaves mu / (sigma + mu) of the error. J. Carpentier, R. Budhiraja, N. Mansard, Proximal
// and Sparse Resolution of Constrained Dynamic Equations, RSS 2021.

class RowSolver {
 public:
  // Squared sine of the angle below which a row counts as dependent: the round-off of G, whose numbers are
  // right to 2^-52 times the condition of M, with room for M up to 1e4.
  static constexpr double kDependent = 1e-11;
  // Rows this much smaller than the largest (squared) are zero.
  static constexpr double kZeroRow = 1e-24;

  explicit RowSolver(int rows);

  int rows() const { return m_; }
  int rank() const { return m_ - int(dependent_.size()); }
  bool regular() const { return dependent_.empty(); }

  double* G() { return G_.data(); }  // rows x rows; written by the caller, of which the lower half is read
  double G(int i, int j) const { return G_[at(i, j)]; }
  double largest_diagonal() const { return largest_; }
  void factor();

  // x solves all rows that do not depend on earlier ones; the shortest such x where the others agree.
  void solve(const double* r, double* x) const;
  // v <- P v
  void remove_null_part(double* v) const;

  // mu as a share of the mean of G's diagonal.
  void factor_proximal(double mu);
  // x = (G + mu 1)^-1 P r
  void solve_proximal(const double* r, double* x) const;

 private:
  std::size_t at(int i, int j) const { return std::size_t(i * m_ + j); }
  void add_null_vector(int row);

  int m_;
  std::vector<double> G_, L_, D_inv_, N_;  // N_: one vector a row
  std::vector<double> proximal_;
  std::vector<int> independent_, dependent_;
  double largest_ = 0;
};

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

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
#pragma once

#include <vector>

namespace chainreel {

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

}  // namespace chainreel

#include "dynamics/constraints/constrained_workspace.hpp"

#include <algorithm>

#include "core/scalar.hpp"
#include "dynamics/algebra.hpp"

namespace chainreel {

RowSolver::RowSolver(int rows) : m_(rows) {
  const auto m = std::size_t(rows);
  for (auto* matrix : {&G_, &L_, &N_, &proximal_}) matrix->resize(m * m);
  D_inv_.resize(m);
  independent_.reserve(m);
  dependent_.reserve(m);
}

void RowSolver::factor() {
  independent_.clear();
  dependent_.clear();
  largest_ = 0;
  for (int i = 0; i < m_; ++i) largest_ = std::max(largest_, G_[at(i, i)]);
  for (int i = 0; i < m_; ++i) {
    double d = G_[at(i, i)];
    for (std::size_t a = 0; a < independent_.size(); ++a) {
      const int j = independent_[a];
      double w = G_[at(i, j)];  // L_ij D_j
      for (std::size_t b = 0; b < a; ++b) {
        const int k = independent_[b];
        w -= L_[at(i, k)] * (L_[at(j, k)] / D_inv_[std::size_t(k)]);
      }
      L_[at(i, j)] = w * D_inv_[std::size_t(j)];
      d -= w * L_[at(i, j)];
    }
    const bool moves = G_[at(i, i)] > kZeroRow * largest_;
    if (moves && d > kDependent * G_[at(i, i)]) {
      independent_.push_back(i);
      D_inv_[std::size_t(i)] = 1 / d;
    } else {
      add_null_vector(i);
    }
  }
}

// Row i is sum c_j row_j of the independent rows before it, c^T L = L_i: (.., -c_j, .., 1) is in the null
// space. Made orthonormal to the vectors already there; twice, because once leaves what cancels.
void RowSolver::add_null_vector(int row) {
  double* const n = &N_[at(int(dependent_.size()), 0)];
  std::fill(n, n + m_, 0.0);
  n[row] = 1;
  for (std::size_t a = independent_.size(); a-- > 0;) {
    const int j = independent_[a];
    double c = L_[at(row, j)];
    for (std::size_t b = a + 1; b < independent_.size(); ++b)
      c += n[independent_[b]] * L_[at(independent_[b], j)];
    n[j] = -c;
  }
  for (int times = 0; times < 2; ++times) {
    remove_null_part(n);
    double square = 0;
    for (int i = 0; i < m_; ++i) square += n[i] * n[i];
    const double k = 1 / square_root(square);
    for (int i = 0; i < m_; ++i) n[i] *= k;
  }
  dependent_.push_back(row);
}

void RowSolver::remove_null_part(double* v) const {
  for (std::size_t k = 0; k < dependent_.size(); ++k) {
    const double* const n = &N_[at(int(k), 0)];
    double along = 0;
    for (int i = 0; i < m_; ++i) along += n[i] * v[i];
    for (int i = 0; i < m_; ++i) v[i] -= along * n[i];
  }
}

void RowSolver::solve(const double* r, double* x) const {
  for (const int i : dependent_) x[i] = 0;
  for (std::size_t a = 0; a < independent_.size(); ++a) {
    const int i = independent_[a];
    x[i] = r[i];
    for (std::size_t b = 0; b < a; ++b) x[i] -= L_[at(i, independent_[b])] * x[independent_[b]];
  }
  for (std::size_t a = independent_.size(); a-- > 0;) {
    const int i = independent_[a];
    x[i] *= D_inv_[std::size_t(i)];
    for (std::size_t b = a + 1; b < independent_.size(); ++b)
      x[i] -= L_[at(independent_[b], i)] * x[independent_[b]];
  }
  remove_null_part(x);
}

void RowSolver::factor_proximal(double mu) {
  double trace = 0;
  for (int i = 0; i < m_; ++i) trace += G_[at(i, i)];
  // Rows that nothing moves have G = 0, and any positive number on the diagonal.
  const double added = trace > 0 ? mu * trace / m_ : 1;
  std::copy(G_.begin(), G_.end(), proximal_.begin());
  for (int i = 0; i < m_; ++i) proximal_[at(i, i)] += added;
  ldlt_factor(m_, proximal_.data());
}

void RowSolver::solve_proximal(const double* r, double* x) const {
  std::copy(r, r + m_, x);
  remove_null_part(x);
  ldlt_solve(m_, proximal_.data(), x);
}

}  // namespace chainreel

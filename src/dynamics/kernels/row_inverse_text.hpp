// What the kernels for constrained chains in the plane and in space share: private to the files that include
// it, as dynamics/kernels/kernel_packs.hpp is.
#pragma once

#include "dynamics/constraints/constrained_workspace.hpp"
#include "dynamics/kernels/kernel_packs.hpp"

namespace chainreel {
namespace {

// The few rows' own system; false where some row depends on the others.
template <int m>
struct RowInverse {
  double L[m][m], D[m], D_inv[m];

  [[gnu::always_inline]] inline bool factor(const double (&G)[m][m]) {
    double largest = G[0][0];
    for (int i = 1; i < m; ++i) largest = largest > G[i][i] ? largest : G[i][i];
    bool regular = true;
    for (int i = 0; i < m; ++i) {
      double d = G[i][i];
      for (int j = 0; j < i; ++j) {
        double w = G[i][j];
        for (int k = 0; k < j; ++k) w -= L[i][k] * L[j][k] * D[k];
        L[i][j] = w * D_inv[j];
        d -= w * L[i][j];
      }
      D[i] = d;
      D_inv[i] = kSinCosTable.one[0] / d;
      regular &= G[i][i] > RowSolver::kZeroRow * largest && d > RowSolver::kDependent * G[i][i];
    }
    return regular;
  }
  [[gnu::always_inline]] inline void solve(double (&x)[m]) const {
    for (int i = 0; i < m; ++i)
      for (int k = 0; k < i; ++k) x[i] -= L[i][k] * x[k];
    for (int i = m - 1; i >= 0; --i) {
      x[i] *= D_inv[i];
      for (int k = i + 1; k < m; ++k) x[i] -= L[k][i] * x[k];
    }
  }
};

// Multipliers of the different rows to those of the set: rows asked for several times share theirs.
template <int m>
[[gnu::always_inline]] inline void hand_out(ConstrainedWorkspace& cws, double (&lambda)[m]) {
  const ConstrainedKernel& own = cws.kernel;
  if (!own.doubled) {
    for (int k = 0; k < m; ++k) cws.lambda[std::size_t(k)] = lambda[k];
    return;
  }
  for (int k = 0; k < m; ++k) lambda[k] *= own.share[std::size_t(k)];
  for (std::size_t i = 0; i < own.group.size(); ++i) cws.lambda[i] = lambda[own.group[i]];
}

}  // namespace
}  // namespace chainreel

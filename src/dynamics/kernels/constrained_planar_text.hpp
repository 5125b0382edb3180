// The text of dynamics/kernels/constrained_kernel.hpp, behind the choice of processor, as dynamics/kernels/kernel_packs.hpp
// is; private to the two files that include it.
#pragma once

#include "dynamics/constraints/constrained_workspace.hpp"
#include "dynamics/kernels/constrained_kernel.hpp"
#include "dynamics/kernels/kernel_planar_text.hpp"
#include "dynamics/kernels/row_inverse_text.hpp"
#include "dynamics/kernels/small_solve.hpp"

namespace chainreel {
namespace {

template <int n, int m>
struct KernelRows {
  double C[m][n], gamma[m];
};

template <int n, int m>
[[gnu::always_inline]] inline void take_rows(const ConstrainedKernel& kernel, const PackOf<n>& s,
                                             const PackOf<n>& c, const double (&rate)[n],
                                             KernelRows<n, m>& rows) {
  using Pack = PackOf<n>;
  for (int k = 0; k < m; ++k) {
    const ConstrainedKernel::Row& row = kernel.row[std::size_t(k)];
    const Pack& a = load<Pack>(row.a.data());
    const Pack& b = load<Pack>(row.b.data());
    double gamma = 0;
    if (!row.rod) {
      const Pack C = a * c + b * s, pull = b * c - a * s;
      for (int i = 0; i < n; ++i) {
        rows.C[k][i] = C[i];
        gamma += pull[i] * (rate[i] * rate[i]);
      }
      rows.gamma[k] = gamma;
      continue;
    }
    const Pack X = a * c - b * s, Y = a * s + b * c;
    double d_x = row.d_x, d_y = row.d_y, v_x = 0, v_y = 0, a_x = 0, a_y = 0;
    for (int i = 0; i < n; ++i) {
      d_x += X[i], d_y += Y[i];
      v_x -= Y[i] * rate[i], v_y += X[i] * rate[i];
      a_x -= X[i] * (rate[i] * rate[i]), a_y -= Y[i] * (rate[i] * rate[i]);
    }
    for (int i = 0; i < n; ++i) rows.C[k][i] = (d_y * X[i] - d_x * Y[i]) * row.length_inv;
    rows.gamma[k] = ((d_x * a_x + d_y * a_y) + (v_x * v_x + v_y * v_y)) * row.length_inv;
  }
}

// The lower half of A after the elimination of all links but the last two, and what solves with it.
template <int n>
struct Eliminated {
  double A[n][n], D_inv[n], det_inv;

  [[gnu::always_inline]] inline void factor(const PlanarKernel& kernel) {
    D_inv[0] = kernel.A_11_inv;
#pragma GCC unroll 4
    for (int k = 0; k < n - 2; ++k) {
      if (k > 0) D_inv[k] = kSinCosTable.one[0] / A[k][k];
#pragma GCC unroll 4
      for (int i = k + 1; i < n; ++i) {
        const double factor = A[i][k] * D_inv[k];
#pragma GCC unroll 4
        for (int j = k + 1; j <= i; ++j) A[i][j] -= factor * A[j][k];
      }
    }
    det_inv = kSinCosTable.one[0] / (A[n - 2][n - 2] * A[n - 1][n - 1] - A[n - 1][n - 2] * A[n - 1][n - 2]);
  }
  [[gnu::always_inline]] inline void eliminate(double (&x)[n]) const {
#pragma GCC unroll 4
    for (int k = 0; k < n - 2; ++k)
#pragma GCC unroll 4
      for (int i = k + 1; i < n; ++i) x[i] -= A[i][k] * (x[k] * D_inv[k]);
  }
  // x^T A^-1 y of eliminated x and y
  [[gnu::always_inline]] inline double product(const double (&x)[n], const double (&y)[n]) const {
    constexpr int a = n - 2, b = n - 1;
    const double cross = x[a] * y[b] + x[b] * y[a];
    double sum = ((A[b][b] * (x[a] * y[a]) + A[a][a] * (x[b] * y[b])) - A[b][a] * cross) * det_inv;
#pragma GCC unroll 4
    for (int k = 0; k < n - 2; ++k) sum += x[k] * y[k] * D_inv[k];
    return sum;
  }
  [[gnu::always_inline]] inline void substitute(double (&x)[n]) const {
    substitute_back<n>(A, D_inv, det_inv, x);
  }
};

// r = C x + gamma; whether every row is within the tolerance of the sizes in it.
template <int n, int m>
[[gnu::always_inline]] inline bool is_fulfilled(const KernelRows<n, m>& rows, const double (&x)[n],
                                                double tolerance, double (&r)[m], double& residual) {
  bool good = true;
  residual = 0;
  for (int k = 0; k < m; ++k) {
    double sum = rows.gamma[k], size = absolute(rows.gamma[k]);
    for (int i = 0; i < n; ++i) {
      const double part = rows.C[k][i] * x[i];
      sum += part;
      size += absolute(part);
    }
    r[k] = sum;
    const double error = absolute(sum);
    residual = residual > error ? residual : error;
    good &= error <= tolerance * (1 + size);
  }
  return good;
}

template <int n, int m, Angles kAngles = Angles::common>
[[gnu::noinline]] bool run_constrained_kernel(const Workspace& ws, ConstrainedWorkspace& cws, ConstVec q,
                                              ConstVec qd, ConstVec tau, double* qdd, double tolerance) {
  using Pack = PackOf<n>;
  const PlanarKernel& kernel = ws.scratch->planar_kernel;
  double angle[n], rate[n];
  make_absolute<n, true>(kernel, q, qd, angle, rate);
  Pack phi, s, c;
  fill_lanes<n>(angle, phi);
  if constexpr (kAngles == Angles::any) {
    sin_cos_of_any(phi, s, c);
  } else if (!sin_cos_of_common(phi, s, c)) [[unlikely]] {
    return run_constrained_kernel<n, m, Angles::any>(ws, cws, q, qd, tau, qdd, tolerance);
  }
  const Pack pull = load<Pack>(kernel.pull_c.data()) * c - load<Pack>(kernel.pull_s.data()) * s;
  Couplings<n> couplings;
  couple<n, false>(kernel, s, c, couplings);
  KernelRows<n, m> rows;
  take_rows<n, m>(cws.kernel, s, c, rate, rows);

  Eliminated<n> A;
  double x[n];
  take_torques<n, true>(kernel, tau, pull, x);
  for (int i = 0; i < n; ++i) {
    A.A[i][i] = kernel.A_ii[std::size_t(i)];
    for (int j = i + 1; j < n; ++j) A.A[j][i] = couplings.A[j][i];
  }
  add_rate_terms<n>(couplings.slope, rate, x);
  A.factor(kernel);
  A.eliminate(x);
  double F[m][n], G[m][m], lambda[m];
  for (int k = 0; k < m; ++k) {
    for (int i = 0; i < n; ++i) F[k][i] = rows.C[k][i];
    A.eliminate(F[k]);
    for (int l = 0; l <= k; ++l) G[k][l] = A.product(F[k], F[l]);
    lambda[k] = A.product(F[k], x) + rows.gamma[k];
  }
  RowInverse<m> inverse;
  if (!inverse.factor(G)) [[unlikely]]
    return false;
  inverse.solve(lambda);
  for (int k = 0; k < m; ++k)
    for (int i = 0; i < n; ++i) x[i] -= lambda[k] * F[k][i];
  A.substitute(x);

  cws.passes = 1;
  double r[m];
  while (!is_fulfilled(rows, x, tolerance, r, cws.residual)) [[unlikely]] {
      if (++cws.passes > 4) return false;
      inverse.solve(r);
      double change[n] = {};
      for (int k = 0; k < m; ++k) {
        lambda[k] += r[k];
        for (int i = 0; i < n; ++i) change[i] -= r[k] * F[k][i];
      }
      A.substitute(change);
      for (int i = 0; i < n; ++i) x[i] += change[i];
    }
  hand_out<m>(cws, lambda);
  for (int i = n - 1; i >= 0; --i) qdd[i] = along_normal<true>(kernel, i, i == 0 ? x[0] : x[i] - x[i - 1]);
  return true;
}

template <int n>
ConstrainedKernel::Run constrained_kernel_for(int rows) {
  if (rows == 1) return run_constrained_kernel<n, 1>;
  if (rows == 2) return run_constrained_kernel<n, 2>;
  return run_constrained_kernel<n, 3>;
}

ConstrainedKernel::Run constrained_kernel_for(int joints, int rows) {
  if (joints == 2) return constrained_kernel_for<2>(rows);
  if (joints == 3) return constrained_kernel_for<3>(rows);
  return constrained_kernel_for<4>(rows);
}

}  // namespace
}  // namespace chainreel

// What the kernels of planar chains share, one chain at a time (Number a double) or a batch (a vector of them): all
// unrolled, in one order of operations, so that each gives the same bits.
#pragma once

namespace chainreel {

// The last part of x <- A^-1 x: Cramer's rule for the two joints that are left, whose determinant is given, then the
// others backwards.
template <int n, class Number>
[[gnu::always_inline]] inline void substitute_back(const Number (&A)[n][n], const Number (&D_inv)[n],
                                                   const Number& det_inv, Number (&x)[n]) {
  constexpr int a = n - 2, b = n - 1;
  const Number x_a = A[b][b] * x[a] - A[b][a] * x[b];
  const Number x_b = A[a][a] * x[b] - A[b][a] * x[a];
  x[a] = x_a * det_inv;
  x[b] = x_b * det_inv;
#pragma GCC unroll 4
  for (int k = n - 3; k >= 0; --k) {
#pragma GCC unroll 4
    for (int i = k + 1; i < n; ++i) x[k] -= A[i][k] * x[i];
    x[k] *= D_inv[k];
  }
}

// x <- A^-1 x of a symmetric positive definite matrix, lower half, which is lost. The joints from the first on are
// eliminated until two are left; these take Cramer's rule: one division instead of two in a row. 1/A_11 is known, and of
// two joints A_11 A_22; `one` is 1.
template <int n, class Number>
[[gnu::always_inline]] inline void solve_small(const Number& one, const Number& A_11_inv, const Number& A_11_A_22,
                                               Number (&A)[n][n], Number (&x)[n]) {
  Number D_inv[n];
  D_inv[0] = A_11_inv;
#pragma GCC unroll 4
  for (int k = 0; k < n - 2; ++k) {
    if (k > 0) D_inv[k] = one / A[k][k];
#pragma GCC unroll 4
    for (int i = k + 1; i < n; ++i) {
      const Number factor = A[i][k] * D_inv[k];
#pragma GCC unroll 4
      for (int j = k + 1; j <= i; ++j) A[i][j] -= factor * A[j][k];
      x[i] -= factor * x[k];
    }
  }
  if constexpr (n == 1) {
    x[0] *= D_inv[0];
  } else {
    constexpr int a = n - 2, b = n - 1;
    const Number squares = n == 2 ? A_11_A_22 : A[a][a] * A[b][b];
    const Number det_inv = one / (squares - A[b][a] * A[b][a]);
    substitute_back<n>(A, D_inv, det_inv, x);
  }
}

// Adds what the couplings' slopes make of the absolute rates.
template <int n, class Number>
[[gnu::always_inline]] inline void add_rate_terms(const Number (&slope)[n][n], const Number (&rate)[n], Number (&x)[n]) {
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
#pragma GCC unroll 4
    for (int j = i + 1; j < n; ++j) {
      x[i] += slope[j][i] * (rate[j] * rate[j]);
      x[j] -= slope[j][i] * (rate[i] * rate[i]);
    }
  }
}

}  // namespace chainreel

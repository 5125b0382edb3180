// The end of a small solution, unrolled.
#pragma once

namespace chainreel {

// The last part of x <- A^-1 x: Cramer's rule for the two joints that are left, whose determinant is given,
// then the others backwards. Shared by the planar kernel, the constrained one and
// batches, whose numbers are vectors.
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

}  // namespace chainreel

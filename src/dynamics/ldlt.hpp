// A = L D L^T of a symmetric positive definite matrix, in place, for the small dense systems of the dynamics.
// Without pivoting: mass matrices are positive definite, and a fixed order of operations keeps the bits the
// same everywhere. G. Golub, C. Van Loan, Matrix Computations (4th ed.), alg. 4.1.2. Row by row; only the
// lower half is read.
#pragma once

#include <cstddef>

namespace chainreel {

// The lower half becomes L (its diagonal of ones not stored), the diagonal 1/D.
template <class T>
void ldlt_factor(int n, T* A) {
  const auto at = [n, A](int i, int j) -> T& { return A[std::size_t(i) * std::size_t(n) + std::size_t(j)]; };
  for (int j = 0; j < n; ++j) {
    // Row j holds L_jk D_k until here.
    T d = at(j, j);
    for (int k = 0; k < j; ++k) {
      const T w = at(j, k);
      at(j, k) = w * at(k, k);
      d = d - at(j, k) * w;
    }
    at(j, j) = T(1) / d;
    for (int i = j + 1; i < n; ++i) {
      T w = at(i, j);
      for (int k = 0; k < j; ++k) w = w - at(i, k) * at(j, k);
      at(i, j) = w;
    }
  }
}

// x <- A^-1 x
template <class T>
void ldlt_solve(int n, const T* A, T* x) {
  const auto at = [n, A](int i, int j) { return A[std::size_t(i) * std::size_t(n) + std::size_t(j)]; };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) x[i] = x[i] - at(i, k) * x[k];
  }
  for (int i = 0; i < n; ++i) x[i] = x[i] * at(i, i);
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] = x[i] - at(k, i) * x[k];
  }
}

}  // namespace chainreel

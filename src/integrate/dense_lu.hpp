// A small dense system of linear equations by Gauss's elimination with partial pivoting: G. Golub, C. Van
// Loan, Matrix Computations (2013), 3.4. For T = double or Complex; always in the same order of operations.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace chainreel {

// The products of std::complex look after infinities; these need not.
struct Complex {
  double re = 0, im = 0;
};
inline Complex operator-(Complex x, Complex y) {
  return {x.re - y.re, x.im - y.im};
}
inline Complex operator*(Complex x, Complex y) {
  return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
}
inline double magnitude(double x) {
  return std::fabs(x);
}
inline double magnitude(Complex x) {
  return std::fabs(x.re) + std::fabs(x.im);
}
inline double inverse(double x) {
  return 1 / x;
}
inline Complex inverse(Complex x) {
  const double square = x.re * x.re + x.im * x.im;
  return {x.re / square, -x.im / square};
}

template <class T>
class DenseLu {
 public:
  explicit DenseLu(std::size_t n) : n_(n), a_(n * n), pivot_(n) {}

  T& operator()(std::size_t row, std::size_t column) { return a_[row * n_ + column]; }

  // Replaces the matrix by its factors; the diagonal holds inverses. A singular one gives no finite solution.
  void factor() {
    for (std::size_t k = 0; k < n_; ++k) {
      std::size_t largest = k;
      for (std::size_t i = k + 1; i < n_; ++i)
        if (magnitude(at(i, k)) > magnitude(at(largest, k))) largest = i;
      pivot_[k] = largest;
      if (largest != k)
        for (std::size_t j = 0; j < n_; ++j) std::swap(at(k, j), at(largest, j));
      const T scale = at(k, k) = inverse(at(k, k));
      for (std::size_t i = k + 1; i < n_; ++i) {
        const T factor = at(i, k) = at(i, k) * scale;
        for (std::size_t j = k + 1; j < n_; ++j) at(i, j) = at(i, j) - factor * at(k, j);
      }
    }
  }

  void solve(std::span<T> x) const {
    for (std::size_t k = 0; k < n_; ++k)
      if (pivot_[k] != k) std::swap(x[k], x[pivot_[k]]);
    for (std::size_t i = 1; i < n_; ++i)
      for (std::size_t j = 0; j < i; ++j) x[i] = x[i] - at(i, j) * x[j];
    for (std::size_t i = n_; i-- > 0;) {
      for (std::size_t j = i + 1; j < n_; ++j) x[i] = x[i] - at(i, j) * x[j];
      x[i] = x[i] * at(i, i);
    }
  }

 private:
  T& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
  const T& at(std::size_t i, std::size_t j) const { return a_[i * n_ + j]; }

  std::size_t n_;
  std::vector<T> a_;
  std::vector<std::size_t> pivot_;
};

}  // namespace chainreel

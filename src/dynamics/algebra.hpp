// Small dense algebra of the dynamics, over any scalar: A = L D L^T, vectors and matrices of three.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace chainreel {

// A = L D L^T of a symmetric positive definite matrix, in place, for the small dense systems of the dynamics.
// Without pivoting: mass matrices are positive definite, and a fixed order of operations keeps the bits the
// same everywhere. G. Golub, C. Van Loan, Matrix Computations (4th ed.), alg. 4.1.2. Row by row; only the
// lower half is read.

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

// Three-dimensional vectors and matrices over any scalar, with every sum written out: the order of the
// operations, and so the bits of the result, never depend on the width of a vector unit.

template <class T>
struct Vec3 {
  T x{}, y{}, z{};
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, const T& k) { return {a.x * k, a.y * k, a.z * k}; }
};

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Rows.
template <class T>
struct Mat3 {
  Vec3<T> r0, r1, r2;
  friend Vec3<T> operator*(const Mat3& R, const Vec3<T>& v) {
    return {dot(R.r0, v), dot(R.r1, v), dot(R.r2, v)};
  }
  friend Mat3 operator*(const Mat3& A, const Mat3& B) {
    return {transposed_times(B, A.r0), transposed_times(B, A.r1), transposed_times(B, A.r2)};
  }
  friend Mat3 operator*(const Mat3& A, const T& k) { return {A.r0 * k, A.r1 * k, A.r2 * k}; }
  friend Mat3 operator+(const Mat3& A, const Mat3& B) { return {A.r0 + B.r0, A.r1 + B.r1, A.r2 + B.r2}; }
  friend Mat3 operator-(const Mat3& A, const Mat3& B) { return {A.r0 - B.r0, A.r1 - B.r1, A.r2 - B.r2}; }
  friend Vec3<T> transposed_times(const Mat3& R, const Vec3<T>& v) {
    return R.r0 * v.x + R.r1 * v.y + R.r2 * v.z;
  }
  friend Mat3 transpose(const Mat3& A) {
    return {{A.r0.x, A.r1.x, A.r2.x}, {A.r0.y, A.r1.y, A.r2.y}, {A.r0.z, A.r1.z, A.r2.z}};
  }
};

// A symmetric matrix.
template <class T>
struct Sym3 {
  T xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  friend Sym3 operator+(const Sym3& a, const Sym3& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
  }
  friend Vec3<T> operator*(const Sym3& A, const Vec3<T>& v) {
    return {A.xx * v.x + A.xy * v.y + A.xz * v.z, A.xy * v.x + A.yy * v.y + A.yz * v.z,
            A.xz * v.x + A.yz * v.y + A.zz * v.z};
  }
  friend Mat3<T> full(const Sym3& A) { return {{A.xx, A.xy, A.xz}, {A.xy, A.yy, A.yz}, {A.xz, A.yz, A.zz}}; }
};

// The upper half of a matrix that is known to be symmetric.
template <class T>
Sym3<T> upper(const Mat3<T>& A) {
  return {A.r0.x, A.r0.y, A.r0.z, A.r1.y, A.r1.z, A.r2.z};
}

// R A R^T
template <class T>
Sym3<T> rotated(const Mat3<T>& R, const Sym3<T>& A) {
  const Vec3<T> a0 = A * R.r0;
  const Vec3<T> a1 = A * R.r1;
  const Vec3<T> a2 = A * R.r2;
  return {dot(R.r0, a0), dot(R.r0, a1), dot(R.r0, a2), dot(R.r1, a1), dot(R.r1, a2), dot(R.r2, a2)};
}

// a b^T
template <class T>
Mat3<T> outer(const Vec3<T>& a, const Vec3<T>& b) {
  return {b * a.x, b * a.y, b * a.z};
}

// [p]x A: each column of A crossed by p
template <class T>
Mat3<T> cross(const Vec3<T>& p, const Mat3<T>& A) {
  return {A.r2 * p.y - A.r1 * p.z, A.r0 * p.z - A.r2 * p.x, A.r1 * p.x - A.r0 * p.y};
}

template <class T>
Vec3<T> vec3_of(const Eigen::Vector3d& v) {
  return {T(v.x()), T(v.y()), T(v.z())};
}

template <class T>
Mat3<T> mat3_of(const Eigen::Matrix3d& A) {
  return {{T(A(0, 0)), T(A(0, 1)), T(A(0, 2))},
          {T(A(1, 0)), T(A(1, 1)), T(A(1, 2))},
          {T(A(2, 0)), T(A(2, 1)), T(A(2, 2))}};
}

}  // namespace chainreel

// The masses of points that are linked to a chain, and the impulses along the links that keep their lengths.
//
// The mass matrix is tridiagonal: m_i = c_i + a_{i+1} on its diagonal, o_i = b_{i+1} between points i and
// i + 1 (LinkedPoints::Link). Where a link's impulse acts along d_i, point i gets -d_i lambda_i and point
// i - 1 the opposite. All of it is O(n).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "integrate/system.hpp"

namespace chainreel {

struct Vec2 {
  double x = 0, y = 0;
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(Vec2 a, double k) { return {a.x * k, a.y * k}; }
  friend double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
};

class LinkedMasses {
 public:
  explicit LinkedMasses(std::span<const LinkedPoints::Link> links);

  bool are_single() const { return single_; }  // M is diagonal

  // f <- M^-1 f
  void accelerate(std::span<Vec2> f) const;

  // The impulses lambda along d that change each link by a part of `change` along e, and what they do to the
  // points: M move_i = - d_i lambda_i + d_{i+1} lambda_{i+1}, e_i . (move_i - move_{i-1}) = change_i.
  void correct(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
               std::span<double> lambda, std::span<Vec2> move);

  // The same for k single masses, unrolled.
  template <std::size_t k>
  void accelerate_single(std::array<Vec2, k>& f) const {
    for (std::size_t i = 0; i < k; ++i) f[i] = f[i] * inverse_[i];
  }
  template <std::size_t k>
  void correct_single(const std::array<Vec2, k>& e, const std::array<Vec2, k>& d,
                      const std::array<double, k>& change, std::array<double, k>& lambda,
                      std::array<Vec2, k>& move) const;

 private:
  void eliminate_single(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
                        std::span<double> lambda, std::span<Vec2> move);
  void eliminate_coupled(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
                         std::span<double> lambda, std::span<Vec2> move);

  // How point i and its link's impulse follow point i - 1: move_i = P move_{i-1} + t,
  // lambda_i = l . move_{i-1} + s.
  struct Follower {
    double P_xx = 0, P_xy = 0, P_yx = 0, P_yy = 0;
    Vec2 t, l;
    double s = 0;
  };

  bool single_ = true;
  std::vector<double> diagonal_, off_;  // of M
  std::vector<double> inverse_;         // 1 / m_i where single, else 1 / D of M = L D L^T
  std::vector<double> factor_;          // L below its diagonal
  std::vector<double> upper_;           // of the elimination
  std::vector<Follower> followers_;
};

// Rows of the tridiagonal conditions on lambda (linked_masses.cpp), with one division for the last two.
template <std::size_t k>
[[gnu::always_inline]] inline void LinkedMasses::correct_single(const std::array<Vec2, k>& e,
                                                                const std::array<Vec2, k>& d,
                                                                const std::array<double, k>& change,
                                                                std::array<double, k>& lambda,
                                                                std::array<Vec2, k>& move) const {
  std::array<double, k> pivot, lower{}, upper{}, right, w;
  for (std::size_t i = 0; i < k; ++i) {
    w[i] = inverse_[i];
    pivot[i] = (w[i] + (i > 0 ? w[i - 1] : 0)) * dot(e[i], d[i]);
    if (i > 0) lower[i] = w[i - 1] * dot(e[i], d[i - 1]);
    if (i + 1 < k) upper[i] = w[i] * dot(e[i], d[i + 1]);
    right[i] = -change[i];
  }
  std::array<double, k> inverse{};
  for (std::size_t i = 0; i + 2 < k; ++i) {
    inverse[i] = 1 / pivot[i];
    const double factor = lower[i + 1] * inverse[i];
    pivot[i + 1] -= factor * upper[i];
    right[i + 1] += factor * right[i];
  }
  if constexpr (k == 1) {
    lambda[0] = right[0] / pivot[0];
  } else {
    constexpr std::size_t a = k - 2, b = k - 1;
    const double det_inverse = 1 / (pivot[a] * pivot[b] - lower[b] * upper[a]);
    lambda[a] = (pivot[b] * right[a] + upper[a] * right[b]) * det_inverse;
    lambda[b] = (pivot[a] * right[b] + lower[b] * right[a]) * det_inverse;
    for (std::size_t i = a; i-- > 0;) lambda[i] = (right[i] + upper[i] * lambda[i + 1]) * inverse[i];
  }
  for (std::size_t i = 0; i < k; ++i)
    move[i] = ((i + 1 < k ? d[i + 1] * lambda[i + 1] : Vec2{}) - d[i] * lambda[i]) * w[i];
}

}  // namespace chainreel

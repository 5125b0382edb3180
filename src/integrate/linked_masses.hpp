// The masses of points that are linked to a chain, and the impulses along the links that keep their lengths.
//
// The mass matrix is tridiagonal: m_i = c_i + a_{i+1} on its diagonal, o_i = b_{i+1} between points i and
// i + 1 (LinkedPoints::Link). Where a link's impulse acts along d_i, point i gets -d_i lambda_i and point
// i - 1 the opposite. All of it is O(n).
#pragma once

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

  // f <- M^-1 f
  void accelerate(std::span<Vec2> f) const;

  // The impulses lambda along d that change each link by a part of `change` along e, and what they do to the
  // points: M move_i = - d_i lambda_i + d_{i+1} lambda_{i+1}, e_i . (move_i - move_{i-1}) = change_i.
  void correct(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
               std::span<double> lambda, std::span<Vec2> move);

 private:
  void correct_single(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
                      std::span<double> lambda, std::span<Vec2> move);
  void correct_coupled(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
                       std::span<double> lambda, std::span<Vec2> move);

  // How point i and its link's impulse follow point i - 1: move_i = P move_{i-1} + t,
  // lambda_i = l . move_{i-1} + s.
  struct Follower {
    double P_xx = 0, P_xy = 0, P_yx = 0, P_yy = 0;
    Vec2 t, l;
    double s = 0;
  };

  bool single_ = true;                         // M is diagonal
  std::vector<double> diagonal_, off_;         // of M
  std::vector<double> inverse_;                // 1 / m_i where single, else 1 / D of M = L D L^T
  std::vector<double> factor_;                 // L below its diagonal
  std::vector<double> pivot_inverse_, upper_;  // of the elimination
  std::vector<Follower> followers_;
};

}  // namespace chainreel

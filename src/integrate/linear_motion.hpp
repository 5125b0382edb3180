// A linear motion q' = v, v' = K q + D v in every form that a method may ask for, and the matrix that one
// step of a method makes of it.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "integrate/method.hpp"

namespace chainreel {

struct LinearMotion {
  Eigen::MatrixXd K, D;  // n x n: 1/s^2, 1/s

  Eigen::Index n() const { return K.rows(); }
  // 2n x 2n: x' = A x for x = (q, v).
  Eigen::MatrixXd matrix() const;
  // The same motion with `scale` seconds as the unit of time.
  LinearMotion in_units_of(double scale) const { return {K * (scale * scale), D * scale}; }
};

// 2n x 2n: x after a step of length h from x. Adaptive methods step as they are told. Nothing where the
// method takes no such motion (linked points) or the equations of its step have no solution.
std::optional<Eigen::MatrixXd> step_map(const Method& method, const LinearMotion& motion, double h);

}  // namespace chainreel

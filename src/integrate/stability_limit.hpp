// Where a method stops being stable on a linear motion: where its step multiplies something that the motion
// itself does not let grow.
//
// A method whose step is a function R of the matrix of the motion (it commutes with it: Runge-Kutta methods)
// acts on each eigenvalue by itself, |R(h lambda)| <= 1, and is looked at one by one: no slow motion is lost
// beside a fast one. All others (those that treat q and v in turn) mix what springs and dampers do: there the
// spectral radius of the whole step counts.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "integrate/method.hpp"

namespace chainreel {

// A linear motion q' = v, v' = K q + D v in every form that a method may ask for, and the matrix that one
// step of a method makes of it.

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

// Rates of the motion exp(lambda t), 1/s, that are neither 0 nor the mirror image of another one (imaginary
// part >= 0), the slowest first. What cannot be told from 0 beside the fastest, 3e-5 of it, counts as 0, and
// so do real parts of 1e-9 of it.
std::vector<std::complex<double>> rates_of(const LinearMotion& motion);

// Whether one step of length h > 0 is stable; nothing where that is not known: for methods that take no
// linear motion, and where the motion has no rate that is to stay within bounds.
std::optional<bool> is_stable(const Method& method, const LinearMotion& motion, double h);

// The largest step below which every step is stable, s: 0 where none is, infinity where all are; nothing
// where it is not known.
std::optional<double> stability_limit(const Method& method, const LinearMotion& motion);

}  // namespace chainreel

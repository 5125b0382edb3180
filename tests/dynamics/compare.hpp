// Numbers side by side, with differences measured against their size.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/chain.hpp"

namespace chainreel::test {

inline constexpr double kRoundOff = 0x1p-52;

inline Eigen::Map<const Eigen::VectorXd> as_vector(std::span<const double> v) {
  return {v.data(), Eigen::Index(v.size())};
}

// max |a - b| / max |b|; infinite where a number is not finite.
inline double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.size() == 0) return 0;
  if (!a.allFinite() || !b.allFinite()) return std::numeric_limits<double>::infinity();
  const double scale = b.cwiseAbs().maxCoeff();
  return (a - b).cwiseAbs().maxCoeff() / (scale > 0 ? scale : 1);
}

inline double relative_difference(std::span<const double> a, std::span<const double> b) {
  return relative_difference(Eigen::MatrixXd(as_vector(a)), Eigen::MatrixXd(as_vector(b)));
}

// Makes one body heavier: the input of negative controls.
inline Chain with_changed_mass(Chain chain, int body, double factor) {
  chain.bodies[std::size_t(body)].inertia.mass *= factor;
  if (chain.planar) chain.planar->bodies[std::size_t(body)].mass *= factor;
  return chain;
}

}  // namespace chainreel::test

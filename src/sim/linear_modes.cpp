#include "sim/linear_modes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "integrate/stability_limit.hpp"
#include "sim/chain_system.hpp"

namespace chainreel {
namespace {

// Central differences of numbers of size 1: the best step is the cube root of the rounding error.
constexpr double kDifference = 6e-6;
// What swings less than this part of a turn while it decays is no oscillation.
constexpr double kLeastImaginary = 1e-6;

// d acceleration / d (q, v), nv x 2 nv.
Eigen::MatrixXd slope_of(SecondOrder& system, std::vector<double> q, std::vector<double> v) {
  const Eigen::Index n = Eigen::Index(v.size());
  Eigen::MatrixXd slope(n, 2 * n);
  std::vector<double> above(v.size()), below(v.size());
  for (Eigen::Index j = 0; j < 2 * n; ++j) {
    double& x = j < n ? q[std::size_t(j)] : v[std::size_t(j - n)];
    const double x0 = x;
    x = x0 + kDifference;
    system.acceleration(0, q, v, above);
    x = x0 - kDifference;
    system.acceleration(0, q, v, below);
    x = x0;
    for (Eigen::Index i = 0; i < n; ++i)
      slope(i, j) = (above[std::size_t(i)] - below[std::size_t(i)]) / (2 * kDifference);
  }
  return slope;
}

}  // namespace

std::vector<Mode> oscillating_modes(const Simulation& simulation) {
  if (simulation.chain.nq != simulation.chain.nv) return {};
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  const Eigen::Index n = simulation.chain.nv;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomRows(n) = slope_of(system, simulation.q0, simulation.qd0);
  if (!A.allFinite()) return {};
  std::vector<Mode> modes;
  const Eigen::VectorXcd lambda = A.eigenvalues();
  for (const std::complex<double>& one : lambda) {
    const double omega = std::abs(one);
    if (one.imag() > kLeastImaginary * omega && omega > 0) modes.push_back({omega, -one.real() / omega});
  }
  std::sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) { return a.omega < b.omega; });
  return modes;
}

std::optional<double> longest_stable_step(const Method& method, const std::vector<Mode>& modes) {
  if (modes.empty() || std::isnan(amplification(method, 1, 0, 0.01))) return std::nullopt;
  double longest = std::numeric_limits<double>::infinity();
  for (const Mode& mode : modes) {
    // Differences leave a damping of 1e-10 or so where there is none.
    const double z = std::abs(mode.damping_ratio) < 1e-7 ? 0 : mode.damping_ratio;
    longest = std::min(longest, stability_limit(method, z) / mode.omega);
  }
  return longest;
}

}  // namespace chainreel

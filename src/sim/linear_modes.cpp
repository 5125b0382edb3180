#include "sim/linear_modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "integrate/stability_limit.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

// Central differences of numbers of size 1: the best step is the cube root of the rounding error.
constexpr double kDifference = 6e-6;
// Rounding of forces that cancel, over that difference; beside the largest entry.
constexpr double kNoise = 1e-9;
// Rows of the constraints that are multiples of others.
constexpr double kSameRow = 1e-9;

struct Slopes {
  Eigen::MatrixXd K, D;  // d acceleration / d q and / d v, nv x nv
};

Slopes slopes_of(ChainSystem& system, const Simulation& simulation) {
  const std::size_t n = std::size_t(simulation.chain.nv);
  Slopes slopes{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  std::vector<double> side[2] = {std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t j = 0; j < n; ++j)
    for (const bool of_velocity : {false, true}) {
      for (const bool above : {false, true}) {
        std::vector<double> q = simulation.q0, v = simulation.qd0, unit(n);
        unit[j] = 1;
        const double dx = above ? kDifference : -kDifference;
        if (of_velocity)
          v[j] += dx;
        else
          system.advance(q, unit, dx);
        system.acceleration(0, q, v, side[above]);
      }
      Eigen::MatrixXd& slope = of_velocity ? slopes.D : slopes.K;
      for (std::size_t i = 0; i < n; ++i)
        slope(Eigen::Index(i), Eigen::Index(j)) = (side[1][i] - side[0][i]) / (2 * kDifference);
    }
  return slopes;
}

// Directions that the constraints leave free: columns of length 1 at right angles, nv rows.
Eigen::MatrixXd free_directions(ChainSystem& system, const Simulation& simulation) {
  const Eigen::Index n = simulation.chain.nv;
  if (!system.constrained()) return Eigen::MatrixXd::Identity(n, n);
  const ConstraintSet& set = system.constrained()->set();
  ConstrainedWorkspace cws(simulation.chain, set);
  compute_constraints(simulation.chain, system.workspace(), set, cws, simulation.q0, simulation.qd0);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd Jc = Eigen::Map<const Rows>(cws.Jc.data(), set.rows(), n);
  return null_space(Jc, kSameRow);
}

// What differences leave where there is nothing: it would make slow rates of none.
LinearMotion without_noise(LinearMotion motion) {
  const double rate = std::max(std::sqrt(motion.K.cwiseAbs().maxCoeff()), motion.D.cwiseAbs().maxCoeff());
  const auto clean = [](double least) { return [least](double x) { return std::abs(x) < least ? 0.0 : x; }; };
  motion.K = motion.K.unaryExpr(clean(kNoise * rate * rate)).eval();
  motion.D = motion.D.unaryExpr(clean(kNoise * rate)).eval();
  return motion;
}

double largest_of(const std::vector<double>& x) {
  double largest = 0;
  for (const double one : x) largest = std::max(largest, std::abs(one));
  return largest;
}

}  // namespace

Linearisation linearise(const Simulation& simulation) {
  Linearisation start;
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  std::vector<double> qdd(simulation.qd0.size());
  system.acceleration(0, simulation.q0, simulation.qd0, qdd);
  start.rate = largest_of(simulation.qd0);
  start.acceleration = largest_of(qdd);
  // Bodies that turn and constraints that bend carry deviations along: these terms are not in it.
  if (start.rate > 0 && (simulation.chain.nq != simulation.chain.nv || system.constrained())) {
    start.trouble = "a floating base or a chain with constraints is linearised at rest alone";
    return start;
  }
  const Slopes slopes = slopes_of(system, simulation);
  if (!slopes.K.allFinite() || !slopes.D.allFinite()) {
    start.trouble = "accelerations about the start are not finite";
    return start;
  }
  const Eigen::MatrixXd T = free_directions(system, simulation);
  if (T.cols() == 0) {
    start.trouble = "constraints leave nothing free";
    return start;
  }
  start.motion = without_noise({product(T.transpose(), product(slopes.K, T)), product(T.transpose(), product(slopes.D, T))});
  start.rates = rates_of(*start.motion);
  if (start.rates.empty()) start.trouble = "nothing swings or decays about the start";
  const double force = std::max(1.0, slopes.K.cwiseAbs().maxCoeff());
  start.is_equilibrium = start.rate == 0 && start.acceleration <= kNoise * force;
  return start;
}

std::optional<double> longest_stable_step(const Method& method, const Linearisation& start) {
  return start.motion ? stability_limit(method, *start.motion) : std::nullopt;
}

}  // namespace chainreel

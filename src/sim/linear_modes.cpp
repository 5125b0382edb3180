#include "sim/linear_modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "integrate/stability_limit.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
double largest_of(const std::vector<double>& x) {
  double largest = 0;
  for (const double one : x) largest = std::max(largest, std::abs(one));
  return largest;
}

namespace {

// Central differences of numbers of size 1: the best step is the cube root of the rounding error.
constexpr double kDifference = 6e-6;
// Rounding of forces that cancel, over that difference; beside the largest entry.
constexpr double kNoise = 1e-9;

struct Slopes {
  Eigen::MatrixXd K, D;  // d acceleration / d q and / d v, nv x nv
};

struct State {
  std::vector<double> q, qd;
  double t = 0;
};

constexpr double kLooks[] = {0.0, 0.31, 0.62, 1.0};  // parts of the duration at which what should rest is looked at

// The pose that feedback is told to hold, of joints without feedback where they start; nothing where there is none or it moves, or
// where constraints may not let the robot go there.
std::optional<std::vector<double>> wished_pose(const Simulation& simulation) {
  constexpr double kSame = 1e-9;  // rad or m
  const Chain& chain = simulation.chain;
  if (chain.nq != chain.nv || !simulation.constraints.empty()) return std::nullopt;
  std::vector<double> wished;
  simulation.torque->leave_pieces();
  for (const double part : kLooks) {
    std::vector<double> q = simulation.q0;
    if (!simulation.torque->reference_at(part * simulation.duration, q)) return std::nullopt;
    if (wished.empty()) wished = q;
    for (std::size_t i = 0; i < q.size(); ++i)
      if (!(std::abs(q[i] - wished[i]) <= kSame)) return std::nullopt;
  }
  return wished;
}

Slopes slopes_of(ChainSystem& system, const Simulation& simulation, const State& place) {
  const std::size_t n = std::size_t(simulation.chain.nv);
  Slopes slopes{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  std::vector<double> side[2] = {std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t j = 0; j < n; ++j)
    for (const bool of_velocity : {false, true}) {
      for (const bool above : {false, true}) {
        std::vector<double> q = place.q, v = place.qd, unit(n);
        unit[j] = 1;
        const double dx = above ? kDifference : -kDifference;
        if (of_velocity)
          v[j] += dx;
        else
          system.advance(q, unit, dx);
        system.acceleration(place.t, q, v, side[above]);
      }
      Eigen::MatrixXd& slope = of_velocity ? slopes.D : slopes.K;
      for (std::size_t i = 0; i < n; ++i)
        slope(Eigen::Index(i), Eigen::Index(j)) = (side[1][i] - side[0][i]) / (2 * kDifference);
    }
  return slopes;
}

// What differences leave where there is nothing: it would make slow rates of none.
LinearMotion without_noise(LinearMotion motion) {
  if (motion.n() == 0) return motion;  // constraints leave nothing free
  const double rate = std::max(std::sqrt(motion.K.cwiseAbs().maxCoeff()), motion.D.cwiseAbs().maxCoeff());
  const auto clean = [](double least) { return [least](double x) { return std::abs(x) < least ? 0.0 : x; }; };
  motion.K = motion.K.unaryExpr(clean(kNoise * rate * rate)).eval();
  motion.D = motion.D.unaryExpr(clean(kNoise * rate)).eval();
  return motion;
}

bool is_rest(const std::vector<double>& qdd, const Slopes& slopes) {
  return largest_of(qdd) <= kNoise * std::max(1.0, slopes.K.cwiseAbs().maxCoeff());
}

// The equilibrium that Newton's method comes to from a pose, where it rests for the whole duration and deviations do not grow.
std::optional<State> equilibrium_from(ChainSystem& system, const Simulation& simulation, const std::vector<double>& guess) {
  constexpr int kMostSteps = 60;
  constexpr double kLongest = 0.3;   // of a step, rad or m
  constexpr double kGrowing = 1e-6;  // of the fastest rate: less is rounding
  const std::size_t n = guess.size();
  State place{guess, std::vector<double>(n)};
  std::vector<double> qdd(n);
  const auto look = [&](double t) { system.acceleration(t, place.q, place.qd, qdd); };
  for (int step = 0; step < kMostSteps; ++step) {
    look(0);
    const Slopes slopes = slopes_of(system, simulation, place);
    if (!slopes.K.allFinite() || !slopes.D.allFinite() || !std::isfinite(largest_of(qdd))) return std::nullopt;
    if (is_rest(qdd, slopes)) {
      for (const double part : kLooks) {
        look(part * simulation.duration);
        if (!is_rest(qdd, slopes)) return std::nullopt;
      }
      double fastest = 0, growing = 0;
      for (const std::complex<double>& rate : rates_of(without_noise({slopes.K, slopes.D})))
        fastest = std::max(fastest, std::abs(rate)), growing = std::max(growing, rate.real());
      return growing <= kGrowing * fastest ? std::optional(place) : std::nullopt;
    }
    Eigen::VectorXd way = slopes.K.completeOrthogonalDecomposition().solve(-Eigen::Map<const Eigen::VectorXd>(qdd.data(), Eigen::Index(n)));
    if (!way.allFinite()) return std::nullopt;
    way *= std::min(1.0, kLongest / std::max(way.cwiseAbs().maxCoeff(), kLongest));
    for (std::size_t i = 0; i < n; ++i) place.q[i] += way[Eigen::Index(i)];
  }
  return std::nullopt;
}

// Where feedback brings the robot to rest: not its target where that sags, nor where other joints hang.
std::optional<State> held_state(ChainSystem& system, const Simulation& simulation) {
  const std::optional<std::vector<double>> wished = wished_pose(simulation);
  if (!wished) return std::nullopt;
  for (const std::vector<double>& guess : {*wished, simulation.q0})
    if (std::optional<State> held = equilibrium_from(system, simulation, guess)) return held;
  return std::nullopt;
}

// A run by another method, which gets its own back.
class LookedAt {
 public:
  explicit LookedAt(Simulation& simulation)
      : simulation_(simulation), own_{simulation.method, simulation.options, simulation.step}, motion_only_(simulation.motion_only), most_(simulation.most_evaluations) {}
  ~LookedAt() {
    apply(own_, simulation_);
    simulation_.motion_only = motion_only_;
    simulation_.most_evaluations = most_;
  }
  LookedAt(const LookedAt&) = delete;
  LookedAt& operator=(const LookedAt&) = delete;

 private:
  Simulation& simulation_;
  MethodSetting own_;
  bool motion_only_;
  long most_;
};

// At the ends of the steps of a method that takes shorter ones where more happens, as far as that is cheap.
std::vector<State> states_along(Simulation& simulation) {
  constexpr long kMostEvaluations = 20000;
  const LookedAt own(simulation);
  apply({&find_method("dop853"), {1e-6, 0}, 0}, simulation);
  simulation.motion_only = true;
  simulation.most_evaluations = kMostEvaluations;
  const Trajectory trajectory = simulate_every_step(simulation);
  std::vector<State> states;
  for (int k = 0; k < trajectory.size(); ++k) {
    const ConstVec q = trajectory.q_at(k), qd = trajectory.qd_at(k);
    states.push_back({{q.begin(), q.end()}, {qd.begin(), qd.end()}, trajectory.t[std::size_t(k)]});
  }
  return states;
}

// Along what the constraints leave free there.
LinearMotion free_motion(ChainSystem& system, const Simulation& simulation, const Slopes& slopes, ConstVec q) {
  if (!system.constrained()) return without_noise({slopes.K, slopes.D});
  const Eigen::MatrixXd T = free_directions(simulation.chain, system.workspace(), system.constrained()->set(), q);
  return without_noise({product(T.transpose(), product(slopes.K, T)), product(T.transpose(), product(slopes.D, T))});
}

// The motion at the stiffest instants of the run and at some others, and about the rest near its start and its end. Under constraints as
// if it stood still there: what they bend of a motion is no part of it.
std::vector<LinearMotion> motions_along(ChainSystem& system, Simulation& simulation) {
  constexpr std::size_t kStiffest = 12, kOthers = 20;
  constexpr double kSame = 1e-7;  // what differences leave of slopes
  struct Seen {
    double stiffness;
    LinearMotion motion;
  };
  std::vector<Seen> seen;
  const auto add = [&](State place) {
    if (system.constrained()) std::fill(place.qd.begin(), place.qd.end(), 0.0);
    const Slopes slopes = slopes_of(system, simulation, place);
    if (!slopes.K.allFinite() || !slopes.D.allFinite()) return;
    LinearMotion motion = free_motion(system, simulation, slopes, place.q);
    if (motion.n() == 0) return;
    seen.push_back({std::max(std::sqrt(motion.K.cwiseAbs().maxCoeff()), motion.D.cwiseAbs().maxCoeff()), std::move(motion)});
  };
  const std::vector<State> states = states_along(simulation);
  simulation.torque->leave_pieces();
  for (const State& place : states) add(place);
  // Where nothing bends, as of a slider on a spring, all are one.
  std::vector<LinearMotion> motions;
  const auto keep = [&](const LinearMotion& motion) {
    const auto is_same = [&](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.rows() == b.rows() && (a - b).cwiseAbs().maxCoeff() <= kSame * a.cwiseAbs().maxCoeff(); };
    if (std::ranges::none_of(motions, [&](const LinearMotion& one) { return is_same(one.K, motion.K) && is_same(one.D, motion.D); })) motions.push_back(motion);
  };
  for (std::size_t k = 0; k < kOthers && !seen.empty(); ++k) keep(seen[k * (seen.size() - 1) / (kOthers - 1)].motion);
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.stiffness > b.stiffness; });
  for (std::size_t k = 0; k < std::min(kStiffest, seen.size()); ++k) keep(seen[k].motion);
  seen.clear();
  if (!system.constrained())
    for (const std::vector<double>& guess : {simulation.q0, states.empty() ? simulation.q0 : states.back().q})
      if (const std::optional<State> rest = equilibrium_from(system, simulation, guess)) add(*rest);
  for (const Seen& one : seen) keep(one.motion);
  return motions;
}

}  // namespace

std::complex<double> Linearisation::fastest() const {
  std::complex<double> fastest = rates.empty() ? 0 : rates.back();
  for (const LinearMotion& one : along) {
    const std::vector<std::complex<double>> own = rates_of(one);
    if (!own.empty() && std::abs(own.back()) > std::abs(fastest)) fastest = own.back();
  }
  return fastest;
}

Linearisation linearise(const Simulation& simulation) {
  Linearisation start;
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  const std::optional<State> held = held_state(system, simulation);
  const State place = held ? *held : State{simulation.q0, simulation.qd0};
  start.about_target = held.has_value();
  std::vector<double> qdd(place.qd.size());
  system.acceleration(0, place.q, place.qd, qdd);
  start.rate = largest_of(place.qd);
  start.acceleration = largest_of(qdd);
  // Bodies that turn and constraints that bend carry deviations along: these terms are not in it.
  if (start.rate > 0 && (simulation.chain.nq != simulation.chain.nv || system.constrained())) {
    start.trouble = "a floating base or a chain with constraints is linearised at rest alone";
    return start;
  }
  const Slopes slopes = slopes_of(system, simulation, place);
  if (!slopes.K.allFinite() || !slopes.D.allFinite()) {
    start.trouble = "accelerations about the start are not finite";
    return start;
  }
  LinearMotion motion = free_motion(system, simulation, slopes, simulation.q0);
  if (motion.n() == 0) {
    start.trouble = "constraints leave nothing free";
    return start;
  }
  start.motion = std::move(motion);
  start.rates = rates_of(*start.motion);
  if (start.rates.empty()) start.trouble = "nothing swings or decays about the start";
  start.is_equilibrium = start.rate == 0 && is_rest(qdd, slopes);
  return start;
}

Linearisation linearise_along(Simulation& simulation) {
  Linearisation start = linearise(simulation);
  // What is stiffer than the start, a run that begins elsewhere than at rest may pass.
  const bool stays = start.trouble.empty() && start.is_equilibrium && !start.about_target;
  if (!stays && simulation.chain.nq == simulation.chain.nv) {
    ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
    start.along = motions_along(system, simulation);
  }
  // What holds constraints down by Baumgarte decays by itself: phi'' + 2 g phi' + g^2 phi = 0.
  if (const ConstraintPlan& plan = simulation.constraints; !plan.empty() && plan.stabilize == Stabilization::baumgarte)
    start.along.push_back({Eigen::MatrixXd::Constant(1, 1, -plan.gain * plan.gain), Eigen::MatrixXd::Constant(1, 1, -2 * plan.gain)});
  if (start.trouble.empty() || start.along.empty()) return start;
  // The start itself may have none.
  const auto swings = std::ranges::find_if(start.along, [](const LinearMotion& one) { return !rates_of(one).empty(); });
  if (swings == start.along.end()) return start;
  start.motion = *swings;
  start.rates = rates_of(*swings);
  start.trouble.clear();
  start.is_equilibrium = false;
  return start;
}

std::optional<double> longest_stable_step(const Method& method, const Linearisation& start) {
  std::optional<double> shortest = start.motion ? stability_limit(method, *start.motion) : std::nullopt;
  for (const LinearMotion& one : start.along)
    if (const auto limit = stability_limit(method, one)) shortest = std::min(shortest.value_or(*limit), *limit);
  return shortest;
}

std::optional<bool> is_stable_step(const Method& method, const Linearisation& start, double h) {
  std::optional<bool> stable = start.motion ? is_stable(method, *start.motion, h) : std::nullopt;
  for (const LinearMotion& one : start.along)
    if (const auto here = is_stable(method, one, h)) stable = stable.value_or(true) && *here;
  return stable;
}

}  // namespace chainreel

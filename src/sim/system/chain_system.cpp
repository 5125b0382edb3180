#include "sim/system/chain_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "expr/affine.hpp"

namespace chainreel {
namespace {

constexpr int kMostPasses = 5;   // of the sides that hold corners
constexpr double kHeld = 1e-12;  // what is left of a rate then, of what the sides change in it

}  // namespace

ChainSystem::ChainSystem(const Chain& chain, TorqueLaw& torque, LimitPolicy limit,
                         const ConstraintPlan& constraints)
    : chain_(&chain),
      torque_(&torque),
      limit_(limit),
      limits_(chain),
      ws_(chain),
      constrained_(constraints.empty() ? nullptr : std::make_unique<ConstrainedChain>(chain, constraints)),
      pushes_(torque.pushes()),
      tau_(std::size_t(chain.nv)),
      tau_applied_(pushes_ == nullptr ? 0 : tau_.size()),
      tau_net_(chain.has_dissipation ? tau_.size() : 0) {}

void ChainSystem::evaluate_torque(double t, ConstVec q, ConstVec qd) {
  if (torque_is_known_) return;
  if (!held_.empty()) find_holding_sides(t, q, qd);
  evaluate_law(t, q, qd);
}

void ChainSystem::evaluate_law(double t, ConstVec q, ConstVec qd) {
  const bool presses = constrained_ && constrained_->presses();
  torque_is_known_ = torque_->is_constant() && !presses;
  evaluate_uncut(t, q, qd);
  limits_.check_effort(t, tau_, limit_ == LimitPolicy::clamp);
  if (pushes_ != nullptr) {
    std::copy(tau_.begin(), tau_.end(), tau_applied_.begin());
    pushes_->add_to(*chain_, ws_, t, q, qd, tau_applied_);
  }
  if (bad_torque_ >= 0) return;
  for (std::size_t i = 0; i < tau_.size(); ++i) {
    if (!std::isfinite(tau_[i])) {
      bad_torque_ = int(i);
      return;
    }
  }
}

void ChainSystem::evaluate_uncut(double t, ConstVec q, ConstVec qd) {
  if (takes_means_)
    evaluate_mean(t, q, qd);
  else
    torque_->evaluate(*chain_, ws_, t, q, qd, tau_);
  if (!constrained_ || !constrained_->presses()) return;
  // Pushes press on constraints, too.
  if (pushes_ != nullptr) {
    std::copy(tau_.begin(), tau_.end(), tau_applied_.begin());
    pushes_->add_to(*chain_, ws_, t, q, qd, tau_applied_);
  }
  constrained_->press(ws_, q, qd, applied(), tau_);
}

// Over the branches that meet at the corners that are held, each with both of its sides.
void ChainSystem::evaluate_mean(double t, ConstVec q, ConstVec qd) {
  StateCorners& corners = *torque_->corners();
  const std::size_t m = held_.size();
  for (std::size_t i = 0; i < m; ++i) held_sides_[i] = corners.side(held_[i]);
  std::fill(tau_.begin(), tau_.end(), 0.0);
  for (std::size_t branch = 0; branch < std::size_t(1) << m; ++branch) {
    double weight = 1;
    for (std::size_t i = 0; i < m; ++i) {
      const double side = (branch >> i) & 1 ? 1 : -1;
      corners.set_side(held_[i], side * kJumpsAlone);
      weight *= 0.5 * (1 + side * held_sides_[i]);
    }
    if (weight == 0) continue;
    torque_->evaluate(*chain_, ws_, t, q, qd, tau_branch_);
    if (limit_ == LimitPolicy::clamp) limits_.cut(tau_branch_);
    for (std::size_t i = 0; i < tau_.size(); ++i) tau_[i] += weight * tau_branch_[i];
  }
  for (std::size_t i = 0; i < m; ++i) corners.set_side(held_[i], held_sides_[i]);
}

ConstVec ChainSystem::uncut_torque(double t, ConstVec q, ConstVec qd) {
  if (!held_.empty()) find_holding_sides(t, q, qd);
  torque_is_known_ = false;
  evaluate_uncut(t, q, qd);
  return tau_;
}

ConstVec ChainSystem::torque(double t, ConstVec q, ConstVec qd) {
  evaluate_torque(t, q, qd);
  return tau_;
}

ConstVec ChainSystem::applied_torque(double t, ConstVec q, ConstVec qd) {
  evaluate_torque(t, q, qd);
  return applied();
}

ConstVec ChainSystem::net_torque(double t, ConstVec q, ConstVec qd) {
  const ConstVec tau = applied_torque(t, q, qd);
  if (!chain_->has_dissipation) return tau;
  compute_friction(*chain_, ws_, qd);
  for (std::size_t i = 0; i < tau.size(); ++i) tau_net_[i] = tau[i] - ws_.tau_f[i];
  return tau_net_;
}

Wrench ChainSystem::pushed(double t, ConstVec q, ConstVec qd) {
  return pushes_ == nullptr ? Wrench{} : pushes_->wrench(*chain_, ws_, t, q, qd);
}

void ChainSystem::acceleration(double t, std::span<const double> q, std::span<const double> v,
                               std::span<double> vd) {
  ++evaluations_;
  evaluate_torque(t, q, v);
  accelerate(q, v, vd);
  // To the last bit: rounding would make rates of both signs of what rests.
  for (const int i : resting_) vd[std::size_t(i)] = 0;
}

void ChainSystem::accelerate(ConstVec q, ConstVec qd, Vec qdd) {
  if (constrained_) return constrained_->accelerate(ws_, q, qd, applied(), qdd);
  compute_forward_dynamics(*chain_, ws_, q, qd, applied(), qdd);
}

void ChainSystem::hold(std::vector<int> held) {
  held_ = std::move(held);
  resting_.clear();
  for (const int k : held_)
    if (const int i = torque_->corners()->rate_of(k, chain_->nq, chain_->nv); i >= 0 && !constrained_) resting_.push_back(i);
  takes_means_ = !held_.empty() && limit_ == LimitPolicy::clamp && limits_.have_effort();
  for (const int k : held_) takes_means_ = takes_means_ || torque_->corners()->is_curved(k);
  held_sides_.resize(held_.size());
  tau_branch_.resize(tau_.size());
  const std::size_t m = held_.size();
  for (std::vector<double>* of_each : {&wanted_, &sought_, &sides_}) of_each->resize(m);
  changes_.resize(m * m);
  lu_ = DenseLu<double>(m);
  even_ = EvenSides(m);
}

ConstVec ChainSystem::corner_rates(double t, ConstVec q, ConstVec qd) {
  StateCorners& corners = *torque_->corners();
  q_dot_.resize(q.size());
  qdd_.resize(qd.size());
  rates_.resize(std::size_t(corners.count()));
  evaluate_law(t, q, qd);
  accelerate(q, qd, qdd_);
  ++evaluations_;
  q_rate(q, qd, q_dot_);
  corners.rates(*chain_, ws_, t, q, q_dot_, qd, qdd_, rates_);
  return rates_;
}

bool ChainSystem::find_holding_sides(double t, ConstVec q, ConstVec qd) {
  StateCorners& corners = *torque_->corners();
  const std::size_t m = held_.size();
  for (const int k : held_) corners.set_side(k, 0);
  // Newton's iteration. The rates are affine in each side, so that one pass is enough unless two multiply.
  double scale = 0;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    corner_rates(t, q, qd);
    double largest = 0;
    for (std::size_t i = 0; i < m; ++i) {
      wanted_[i] = -rates_[std::size_t(held_[i])];
      largest = std::max(largest, std::fabs(wanted_[i]));
    }
    if (pass > 0 && largest <= kHeld * scale) return true;
    for (std::size_t j = 0; j < m; ++j) {
      const double side = corners.side(held_[j]);
      corners.set_side(held_[j], side + 1);
      corner_rates(t, q, qd);
      corners.set_side(held_[j], side);
      for (std::size_t i = 0; i < m; ++i) {
        changes_[i * m + j] = rates_[std::size_t(held_[i])] + wanted_[i];
        scale = std::max(scale, std::fabs(changes_[i * m + j]));
      }
    }
    scale = std::max(scale, largest);
    solve_for_sides();
    for (std::size_t j = 0; j < m; ++j) {
      if (!std::isfinite(sides_[j])) return false;
      corners.set_side(held_[j], sides_[j]);
    }
  }
  return false;
}

// Into sides_, from those that stand: what makes the rates change as wanted.
void ChainSystem::solve_for_sides() {
  const StateCorners& corners = *torque_->corners();
  const std::size_t m = held_.size();
  for (std::size_t i = 0; i < m; ++i) {
    sought_[i] = wanted_[i];
    for (std::size_t j = 0; j < m; ++j) {
      sought_[i] += changes_[i * m + j] * corners.side(held_[j]);
      lu_(i, j) = changes_[i * m + j];
    }
  }
  if (m > 1 && even_.solve(changes_, sought_, sides_)) return;
  lu_.factor();
  lu_.solve(wanted_);
  for (std::size_t j = 0; j < m; ++j) sides_[j] = corners.side(held_[j]) + wanted_[j];
}

double ChainSystem::power(double t, ConstVec q, ConstVec qd) {
  const ConstVec tau = net_torque(t, q, qd);
  double sum = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) sum += qd[i] * tau[i];
  return sum;
}

void ChainSystem::q_rate(std::span<const double> q, std::span<const double> v,
                         std::span<double> q_dot) const {
  chainreel::q_rate(*chain_, q, v, q_dot);
}

void ChainSystem::advance(std::span<double> q, std::span<const double> v, double h) const {
  if (!chain_->has_floating) return SecondOrder::advance(q, v, h);
  chainreel::advance(*chain_, q, v, h);
}

void ChainSystem::normalize(std::span<double> q) const {
  chainreel::normalize(*chain_, q);
}

namespace {

bool has_effort_limit(const Chain& chain) {
  for (std::size_t i = 1; i < chain.bodies.size(); ++i)
    if (std::isfinite(chain.bodies[i].joint.limit.effort)) return true;
  return false;
}

class ChainSeries final : public Series {
 public:
  ChainSeries(ChainSystem& system, const AffineTorque& torque, int highest_order)
      : system_(system),
        series_(system.chain(), torque, highest_order),
        watches_effort_(has_effort_limit(system.chain())) {}

  int n() const override { return system_.nv(); }

  void expand(double t, std::span<const double> q, std::span<const double> v, int order,
              std::span<double> c) override {
    system_.count_evaluation();
    if (watches_effort_) system_.torque(t, q, v);  // which reports what passes a limit
    series_.expand(t, q, v, order, c);
  }

 private:
  ChainSystem& system_;
  PlanarSeries<double> series_;
  bool watches_effort_;
};

}  // namespace

bool cuts_torques(const Chain& chain, LimitPolicy limit) {
  return limit == LimitPolicy::clamp && has_effort_limit(chain);
}

std::optional<std::string> why_no_series(const Chain& chain, const TorqueLaw& law, LimitPolicy limit) {
  if (auto why = why_no_planar_series(chain)) return why;
  if (law.pushes() != nullptr) return "something pushes it from outside";
  if (cuts_torques(chain, limit)) return "torques are cut at the joints' effort";
  if (!law.affine()) return "a torque is neither a polynomial in t, of degree " + std::to_string(kHighestPowerOfTime) + " at most, nor affine in the state";
  return {};
}

std::unique_ptr<Series> make_chain_series(ChainSystem& system, int highest_order) {
  if (const auto why = why_no_series(system.chain(), system.law(), system.limit_policy()))
    throw Error(ExitCode::bad_input,
                "method taylor does not take this scene, because " + *why + ": take dop853 instead");
  return std::make_unique<ChainSeries>(system, *system.law().affine(), highest_order);
}

}  // namespace chainreel

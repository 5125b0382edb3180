#include "sim/chain_system.hpp"

#include <cmath>

#include "dynamics/forward_dynamics.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {

ChainSystem::ChainSystem(const Chain& chain, TorqueLaw& torque, LimitPolicy limit,
                         const ConstraintPlan& constraints)
    : chain_(&chain),
      torque_(&torque),
      limit_(limit),
      limits_(chain),
      ws_(chain),
      constrained_(constraints.empty() ? nullptr : std::make_unique<ConstrainedChain>(chain, constraints)),
      tau_(std::size_t(chain.nv)),
      tau_net_(chain.has_dissipation ? tau_.size() : 0) {}

void ChainSystem::evaluate_torque(double t, ConstVec q, ConstVec qd) {
  if (torque_is_known_) return;
  const bool presses = constrained_ && constrained_->presses();
  torque_is_known_ = torque_->is_constant() && !presses;
  torque_->evaluate(*chain_, ws_, t, q, qd, tau_);
  if (presses) constrained_->press(ws_, q, qd, tau_);
  limits_.check_effort(t, tau_, limit_ == LimitPolicy::clamp);
  if (bad_torque_ >= 0) return;
  for (std::size_t i = 0; i < tau_.size(); ++i) {
    if (!std::isfinite(tau_[i])) {
      bad_torque_ = int(i);
      return;
    }
  }
}

ConstVec ChainSystem::torque(double t, ConstVec q, ConstVec qd) {
  evaluate_torque(t, q, qd);
  return tau_;
}

ConstVec ChainSystem::net_torque(double t, ConstVec q, ConstVec qd) {
  evaluate_torque(t, q, qd);
  if (!chain_->has_dissipation) return tau_;
  compute_friction(*chain_, ws_, qd);
  for (std::size_t i = 0; i < tau_.size(); ++i) tau_net_[i] = tau_[i] - ws_.tau_f[i];
  return tau_net_;
}

void ChainSystem::acceleration(double t, std::span<const double> q, std::span<const double> v,
                               std::span<double> vd) {
  ++evaluations_;
  evaluate_torque(t, q, v);
  if (constrained_) return constrained_->accelerate(ws_, q, v, tau_, vd);
  compute_forward_dynamics(*chain_, ws_, q, v, tau_, vd);
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

}  // namespace chainreel

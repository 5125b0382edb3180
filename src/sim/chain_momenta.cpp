#include "sim/chain_momenta.hpp"

#include <algorithm>

namespace chainreel {
namespace {

// Of a chain all of whose joints slide: what slides turns nothing.
bool has_constant_mass_matrix(const Chain& chain) {
  return std::all_of(chain.bodies.begin() + 1, chain.bodies.end(),
                     [](const Body& body) { return body.joint.kind == JointKind::prismatic; });
}

}  // namespace

ChainMomenta::ChainMomenta(ChainSystem& system, const LocalCoordinates* local)
    : system_(system),
      form_(system.chain()),
      separable_(has_constant_mass_matrix(system.chain()) && !system.chain().has_dissipation &&
                 !system.law().depends_on_velocity()),
      local_(local) {
  if (!local_) return;
  own_q_.resize(std::size_t(system.nq()));
  for (auto* numbers : {&own_v_, &own_p_, &own_p_dot_}) numbers->resize(std::size_t(system.nv()));
}

void ChainMomenta::momentum(std::span<const double> q, std::span<const double> v, std::span<double> p) {
  if (!local_) return form_.momentum(q, v, p);
  local_->place(q, own_q_);
  local_->to_velocity(q, v, own_v_);
  form_.momentum(own_q_, own_v_, own_p_);
  local_->to_momentum(q, own_p_, p);
}

void ChainMomenta::velocity(std::span<const double> q, std::span<const double> p, std::span<double> v) {
  if (!local_) return form_.velocity(q, p, v);
  local_->place(q, own_q_);
  local_->from_momentum(q, p, own_p_);
  form_.velocity(own_q_, own_p_, own_v_);
  local_->to_rate(q, own_v_, v);
}

void ChainMomenta::force(double t, std::span<const double> q, std::span<const double> v,
                         std::span<double> p_dot) {
  if (!local_) return own_force(t, q, v, p_dot);
  local_->place(q, own_q_);
  local_->to_velocity(q, v, own_v_);
  form_.momentum(own_q_, own_v_, own_p_);
  own_force(t, own_q_, own_v_, own_p_dot_);
  local_->to_force(q, v, own_p_, own_p_dot_, p_dot);
}

// In the chain's own coordinates.
void ChainMomenta::own_force(double t, std::span<const double> q, std::span<const double> v,
                             std::span<double> p_dot) {
  system_.count_evaluation();
  form_.force(q, v, p_dot);
  const ConstVec tau = system_.net_torque(t, q, v);
  for (std::size_t i = 0; i < p_dot.size(); ++i) p_dot[i] += tau[i];
}

}  // namespace chainreel

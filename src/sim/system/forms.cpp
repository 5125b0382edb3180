#include "sim/system/forms.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "sim/system/chain_points.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

ChainForms::ChainForms(ChainSystem& system, const Method& method) {
  forms_.second_order = &system;
  if (system.constrained() && method.form != Form::second_order)
    throw Error(ExitCode::bad_input,
                "the method " + method.name + " takes no constraints: take dop853, or `method: auto`");
  if (system.chain().has_floating && (method.plain_coordinates || method.form == Form::momenta)) {
    chart_ = std::make_unique<ChainChart>(system);
    forms_.second_order = chart_.get();
    forms_.chart = chart_.get();
  }
  switch (method.form) {
    case Form::second_order:
      return;
    case Form::momenta:
      momenta_ = std::make_unique<ChainMomenta>(system, chart_ ? &chart_->local() : nullptr);
      forms_.momenta = momenta_.get();
      return;
    case Form::series:
      series_ = make_chain_series(system, method.highest_order + 1);
      forms_.series = series_.get();
      return;
    case Form::linked_points:
      linked_points_ = make_chain_points(system, method.name);
      forms_.linked_points = linked_points_.get();
      return;
  }
}

ChainForms::~ChainForms() = default;

ChainChart::ChainChart(ChainSystem& system)
    : system_(system),
      local_(system.chain()),
      q_(std::size_t(system.nq())),
      v_(std::size_t(system.nv())),
      v_dot_(v_.size()) {}

void ChainChart::acceleration(double t, std::span<const double> x, std::span<const double> x_dot,
                              std::span<double> x_ddot) {
  local_.place(x, q_);
  local_.to_velocity(x, x_dot, v_);
  system_.acceleration(t, q_, v_, v_dot_);
  local_.to_second_rate(x, x_dot, v_dot_, x_ddot);
}

void ChainChart::move_to(std::span<const double> q, std::span<const double> v, std::span<double> x,
                         std::span<double> x_dot) {
  local_.move_to(q, x);
  local_.to_rate(x, v, x_dot);
}

void ChainChart::leave(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
                       std::span<double> v) const {
  local_.place(x, q);
  local_.to_velocity(x, x_dot, v);
}

namespace {

// All joints slide: what slides turns nothing.
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

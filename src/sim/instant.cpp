#include "sim/instant.hpp"

#include "dynamics/constraints/constrained_dynamics.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

Instant state_of(ChainSystem& system, double t, ConstVec q, ConstVec qd) {
  const Chain& chain = system.chain();
  Instant instant;
  instant.qdd.resize(std::size_t(chain.nv));
  system.acceleration(t, q, qd, instant.qdd);
  const ConstVec tau = system.torque(t, q, qd);
  instant.tau.assign(tau.begin(), tau.end());
  const ConstVec applied = system.applied_torque(t, q, qd);
  if (system.law().pushes() != nullptr)
    for (std::size_t i = 0; i < applied.size(); ++i) instant.tau_push.push_back(applied[i] - instant.tau[i]);
  if (!system.constrained()) return instant;

  const ConstraintSet& set = system.constrained()->set();
  const ConstrainedWorkspace& cws = system.constrained()->rows_at(system.workspace(), q, qd, applied);
  instant.rows = set.row_names();
  instant.phi = cws.phi;
  instant.Jcd_qd = cws.Jcd_qd;
  instant.lambda = cws.lambda;
  instant.status = to_string(cws.status);
  instant.Jc = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      cws.Jc.data(), set.rows(), chain.nv);
  for (std::size_t k = 0; k < set.constraints().size(); ++k) {
    instant.constraints.push_back(name_of(set.constraints()[k]));
    instant.forces.push_back(contact_force(chain, set, cws, k, cws.lambda));
  }
  return instant;
}

}  // namespace

Instant instant_of(const Simulation& simulation, const Trajectory& trajectory, int k) {
  ChainSystem system(simulation);
  const double t = trajectory.t[std::size_t(k)];
  hold_as_then(system, simulation, trajectory, t);
  Instant instant = state_of(system, t, trajectory.q_at(k), trajectory.qd_at(k));
  simulation.torque->leave_pieces();
  return instant;
}

Instant instant_of(const Simulation& simulation, double t, ConstVec q, ConstVec qd) {
  ChainSystem system(simulation);
  return state_of(system, t, q, qd);
}

TipMass::TipMass(const Chain& chain) : chain_(&chain) {}

TipMass::TipMass(const Chain& chain, const ConstraintPlan& constraints) : chain_(&chain) {
  if (constraints.empty()) return;
  set_ = std::make_unique<ConstraintSet>(chain, constraints.list);
  cws_ = std::make_unique<ConstrainedWorkspace>(chain, *set_);
}

EffectiveMass TipMass::at(Workspace& ws, ConstVec q, Task task) const {
  const int frame = chain_->end_effector;
  if (!set_) return effective_mass_of(*chain_, ws, q, frame, task);
  return constrained_effective_mass_of(*chain_, ws, *set_, *cws_, q, frame, task);
}

}  // namespace chainreel

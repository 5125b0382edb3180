#include "sim/tip.hpp"

namespace chainreel {

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

void require_frame_of(const Chain& chain, const Probe& probe, int slot, const Place& place) {
  // No other frame may be called G.
  const std::string& name = probe.names()[std::size_t(slot)];
  if (chain.end_effector >= 0 || !probe.is_kinematic(slot) || !name.ends_with("_G")) return;
  try {
    require_end_effector(chain);
  } catch (const Error& error) {
    throw Error(error.code(), name + " is of the end effector: " + error.problems().front().message, place);
  }
}

}  // namespace chainreel

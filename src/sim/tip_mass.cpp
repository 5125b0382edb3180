#include "sim/tip_mass.hpp"

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

}  // namespace chainreel

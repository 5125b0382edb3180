#include "draw/tip_mass.hpp"

namespace chainreel {

TipMass::TipMass(const Chain& chain, const Simulation* simulation) : chain_(&chain) {
  if (!simulation || simulation->constraints.empty()) return;
  set_ = std::make_unique<ConstraintSet>(chain, simulation->constraints.list);
  cws_ = std::make_unique<ConstrainedWorkspace>(chain, *set_);
}

EffectiveMass TipMass::at(Workspace& ws, ConstVec q) const {
  const int frame = chain_->end_effector;
  if (!set_) return effective_mass_of(*chain_, ws, q, frame, Task::linear);
  return constrained_effective_mass_of(*chain_, ws, *set_, *cws_, q, frame, Task::linear);
}

}  // namespace chainreel

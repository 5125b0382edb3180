// The effective mass at a chain's end effector: under the run's constraints, where it has some. All that shows it,
// films, figures and tables, takes it from here.
#pragma once

#include <memory>

#include "core/error.hpp"
#include "dynamics/constraints/constrained_mass.hpp"
#include "sim/choice/probe.hpp"
#include "sim/constraint_plan.hpp"

namespace chainreel {

class TipMass {
 public:
  // For a chain without constraints. The chain must outlive it.
  explicit TipMass(const Chain& chain);
  // Throws Error where the constraints do not fit the chain.
  TipMass(const Chain& chain, const ConstraintPlan& constraints);

  const Chain& chain() const { return *chain_; }
  bool is_constrained() const { return set_ != nullptr; }

  // `q` on the constraints. Throws nothing; the chain has an end effector.
  EffectiveMass at(Workspace& ws, ConstVec q) const { return at(ws, q, Task::linear); }
  EffectiveMass at(Workspace& ws, ConstVec q, Task task) const;

 private:
  const Chain* chain_;
  std::unique_ptr<ConstraintSet> set_;  // null: none
  std::unique_ptr<ConstrainedWorkspace> cws_;
};

// Expressions that read the end effector. Internal.

// Throws Error (bad input) where the slot of the probe is x_G or another of the end effector and the chain has none.
void require_frame_of(const Chain& chain, const Probe& probe, int slot, const Place& place);

}  // namespace chainreel

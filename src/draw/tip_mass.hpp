// The effective mass at the end effector that a panel draws: under the run's constraints, where it has some.
#pragma once

#include <memory>

#include "dynamics/constrained_effective_mass.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

class TipMass {
 public:
  // `simulation` may be null: a chain without constraints. Both must outlive it.
  TipMass(const Chain& chain, const Simulation* simulation);

  EffectiveMass at(Workspace& ws, ConstVec q) const;

 private:
  const Chain* chain_;
  std::unique_ptr<ConstraintSet> set_;  // null: none
  std::unique_ptr<ConstrainedWorkspace> cws_;
};

}  // namespace chainreel

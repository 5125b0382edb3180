// A chain under constraints, as a run needs it: accelerations with multipliers, forces pressed on purpose,
// the way back onto the constraints, and how far the motion is from them.
#pragma once

#include <optional>

#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_projection.hpp"
#include "sim/system/constraint_plan.hpp"

namespace chainreel {

class ConstrainedChain {
 public:
  // Throws Error where the constraints do not fit the chain.
  ConstrainedChain(const Chain& chain, const ConstraintPlan& plan);

  const ConstraintSet& set() const { return set_; }
  bool projects() const { return stabilize_ == Stabilization::project; }
  bool presses() const { return !contact_forces_.empty(); }

  void accelerate(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau, Vec qdd);
  // The multipliers of the last acceleration: rows numbers.
  ConstVec lambda() const { return cws_.lambda; }

  // Adds to tau the joint torques that bring the multipliers of the pressed constraints to what they are to
  // bear: tau + Jc^T (lambda_d - lambda), which changes lambda alone, and no acceleration.
  void press(Workspace& ws, ConstVec q, ConstVec qd, ConstVec applied, Vec tau);

  // Positions and velocities back onto the constraints.
  Projection project(Workspace& ws, Vec q, Vec qd);

  // A look from outside a run's steps: what the run remembers stays as it was.
  struct Look {
    double position_error, velocity_error;  // the largest |phi| and |Jc qd|
  };
  Look look(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau);
  void project_sample(Workspace& ws, Vec q, Vec qd);
  // phi, Jc, Jc_dot qd and the multipliers that answer tau at this state; valid until the next call of anything.
  const ConstrainedWorkspace& rows_at(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau);

  // A row that no acceleration fulfils, seen since this was last asked for, if only at a stage of a step.
  bool take_suspicion();
  struct Unmet {
    int row = 0;
    double residual = 0;  // of its acceleration, m/s^2 or rad/s^2
    ConstraintStatus status = ConstraintStatus::regular;
  };
  // The row that cannot be met at this state, where there is one.
  std::optional<Unmet> unmet(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau);

 private:
  bool is_unmet() const;

  const Chain* chain_;
  ConstraintSet set_;
  ConstrainedWorkspace cws_;
  Stabilization stabilize_;
  std::vector<ContactForce> contact_forces_;
  ConstrainedOptions options_;
  std::vector<double> wanted_, qdd_, curve_s_;
  bool suspicion_ = false;
};

}  // namespace chainreel

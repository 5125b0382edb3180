// The work of the joint torques less friction, W = integral of qd^T (tau - tau_f) dt, accumulated step by
// step. Constant torques on joints without friction: tau . (q - q(0)), exact and free. Else Simpson's rule on
// each step's Hermite interpolant (error h^5/2880 of the power's fourth derivative a step).
#pragma once

#include "sim/chain_system.hpp"
#include "sim/simulate.hpp"
#include "sim/step_span.hpp"

namespace chainreel {

class WorkIntegral {
 public:
  WorkIntegral(const Simulation& simulation, ChainSystem& system);

  // After each step: work up to its end.
  void add_step(ChainSystem& system, StepSpan& span, ConstVec q, ConstVec qd);
  // Work up to the step's end, and up to the state that the span has been moved to (time t).
  double at_end() const { return total_; }
  double at(ChainSystem& system, StepSpan& span, double t);

 private:
  double work_of_constant(ConstVec q) const;
  double simpson(ChainSystem& system, StepSpan& span, double t, double end_power);

  bool constant_ = false;
  std::vector<double> q0_, tau_;
  double total_ = 0;        // up to the end of the last step
  double before_ = 0;       // up to its beginning
  double begin_power_ = 0;  // W, at the beginning of the last step
  double end_power_ = 0;    // W, at its end
  bool has_power_ = false;
};

}  // namespace chainreel

// The work of the joint torques less friction, W = integral of qd^T (tau - tau_f) dt, accumulated step by
// step. Constant torques on joints without friction: tau . (q - q(0)), exact and free. Else Gauss's rule on
// the dense output of each step, with as many points as the order of that output deserves.
#pragma once

#include "sim/chain_system.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

class WorkIntegral {
 public:
  WorkIntegral(const Simulation& simulation, ChainSystem& system, int dense_order);

  // After each step, which leads to q: work up to its end.
  void add_step(ChainSystem& system, Integrator& integrator, ConstVec q);
  // Work up to the last step's end, and up to an instant within it, where q is the chain's position.
  double at_end() const { return total_; }
  double at(ChainSystem& system, Integrator& integrator, double t, ConstVec q);

 private:
  double work_of_constant(ConstVec q) const;
  double integral(ChainSystem& system, Integrator& integrator, double end);

  bool constant_ = false;
  std::vector<double> q0_, tau_;
  std::vector<double> q_, qd_;           // at a node
  std::vector<double> nodes_, weights_;  // on [0, 1]
  double total_ = 0;                     // up to the end of the last step
  double before_ = 0;                    // up to its beginning
};

}  // namespace chainreel

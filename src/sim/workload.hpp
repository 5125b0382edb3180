// What runs are going to take, counted before the first one begins: a mistake in a step or a duration is told at once
// instead of after a year.
#pragma once

#include <string>

#include "sim/simulate.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

inline constexpr double kMostSteps = 1e10;  // of one run
inline constexpr double kMostWork = 1e14;   // ns by the table of costs, of all runs of a command: some 28 hours

// Whole steps of a method of fixed step; 0 of one that chooses its steps.
double steps_of(const Simulation& simulation);

// ns at least, by the table of costs; of a method that chooses its steps 0.
double least_work(const Simulation& simulation);

// Throws Error (exit 7) with the count where so many runs like this one are more than may be asked for.
void require_possible(const Simulation& simulation, double runs = 1);

// The same for the sum of several runs' least_work.
void require_possible(double work, double runs);

// The work of the joint torques less friction, W = integral of qd^T (tau - tau_f) dt, accumulated step by
// step. Constant torques on joints without friction: tau . (q - q(0)), exact and free. Else Gauss's rule on
// each step's path, with as many points as the order of that path deserves.

class WorkIntegral {
 public:
  WorkIntegral(const Simulation& simulation, ChainSystem& system, int path_order);

  // After each step, which leads to q: work up to its end.
  void add_step(ChainSystem& system, Integrator& integrator, ConstVec q);
  // Work up to the last step's end, and up to an instant within it, where q is the chain's position.
  double at_end() const { return total_; }
  double at(ChainSystem& system, Integrator& integrator, double t, ConstVec q);
  bool is_free() const { return constant_; }  // needs nothing of a step

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

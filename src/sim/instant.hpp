// One state of a run, with all that its equation of motion holds there:
//
//   tau = M qdd + nle + tau_f + Jc^T lambda,   Jc qdd + Jcd_qd = 0
//
// by the system that the run steps, so that numbers of an instant are those of the film.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "dynamics/constraints/constrained_mass.hpp"
#include "dynamics/workspace.hpp"
#include "sim/simulate.hpp"
#include "sim/system/constraint_plan.hpp"

namespace chainreel {

struct Instant {
  std::vector<double> tau;  // as the run feels it: with what presses on constraints, cut by the limit policy; N m or N
  std::vector<double> tau_push;  // J^T F of what pushes from outside; empty where nothing does
  std::vector<double> qdd;       // nv

  // The names of the constraints' rows; empty where there are none.
  std::vector<std::string> rows;
  std::vector<double> phi;     // m or rad
  Eigen::MatrixXd Jc;          // rows x nv
  std::vector<double> Jcd_qd;  // the rows' accelerations at qdd = 0
  std::vector<double> lambda;  // N or N m; +Jc^T lambda is what the robot exerts on its surroundings
  std::string status;          // "regular", "redundant", ..

  // A constraint each: its name, and the force that the robot exerts at its (first) frame, N along W.
  std::vector<std::string> constraints;
  std::vector<Eigen::Vector3d> forces;
};

// Of sample k of a run: what stuck there, as dry friction at rest, sticks here.
Instant instant_of(const Simulation& simulation, const Trajectory& trajectory, int k);
// At t in the state q, qd, which lie on the constraints, and nothing sticks.
Instant instant_of(const Simulation& simulation, double t, ConstVec q, ConstVec qd);

// The effective mass at a chain's end effector: under the run's constraints, where it has some. All that shows it,
// films, figures and tables, takes it from here.

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

}  // namespace chainreel

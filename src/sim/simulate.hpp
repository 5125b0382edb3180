// A run: chain, start state, torque and method give a trajectory.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "integrate/method.hpp"
#include "model/chain.hpp"
#include "model/visuals.hpp"
#include "sim/drive/limits.hpp"
#include "sim/drive/torque.hpp"
#include "sim/plots.hpp"
#include "sim/system/constraint_plan.hpp"
#include "sim/system/trajectory.hpp"
#include "sim/watch/events.hpp"

namespace chainreel {

class RecordedMotion;

// Everything that a run needs, resolved and checked.
struct Simulation {
  Chain chain;
  std::shared_ptr<const RecordedMotion> motion;  // null: it is computed; else shown as it was, see `replay`
  std::vector<double> q0;   // nq
  std::vector<double> qd0;  // nv
  std::unique_ptr<TorqueLaw> torque;
  const Method* method = nullptr;  // null: still to be chosen
  MethodOptions options;
  double step = 0.001;   // s; 0: the method chooses, see MethodOptions::tolerance
  double duration = 10;  // s
  double longest_step = 0;    // s, that a method which chooses its steps may take; 0: any
  double whole_duration = 0;  // s, of the run whose beginning this is, with its steps; less than duration: this is whole
  long most_evaluations = 0;  // behind that many the run ends with RunStatus::out_of_budget; 0: any number
  bool motion_only = false;   // without the torques' work and the multipliers, for who looks at q and qd alone
  LimitPolicy limit = LimitPolicy::report;
  std::shared_ptr<const EventSet> events;  // null: none
  ConstraintPlan constraints;
  std::shared_ptr<const PlotSet> plots;  // null: none; of no matter to the run
  Outline outline;                       // of what pictures show, for who judges by the eye; of no matter to the run
};

// How a run is stepped.
struct MethodSetting {
  const Method* method = nullptr;
  MethodOptions options;
  double step = 0;  // s; 0: by the tolerance
};

// The run is that of a recorded motion until `duration`: its method, start and torques.
void replay(Simulation& simulation, std::shared_ptr<const RecordedMotion> motion);

void apply(const MethodSetting& setting, Simulation& simulation);

// Two instants closer than this are one, s.
double same_instant(const Simulation& simulation);

// The longest step, s, of a run whose method chooses its steps; 0: any. Where torques may change, events happen or limits be
// passed, a part of the duration at most: a robot at rest or one that coasts lets a method take the whole run for a step,
// and what comes on the way would never be felt.
double longest_step_of(const Simulation& simulation);

// Throws Error (bad input) where the method does not take this chain or torque; says which to take instead.
void check_method(const Simulation& simulation);

// Throws Error (usage) where something that a run needs is missing or of another size: method, torque, q0, qd0; where step or
// duration are below zero or no numbers; where `times` do not rise from 0 to the duration.
void check_ready(const Simulation& simulation, std::span<const double> times = {});

// How much of the run lies before t, from 0 to 1.
inline double part_done(const Simulation& simulation, double t) {
  return simulation.duration > 0 ? std::clamp(t / simulation.duration, 0.0, 1.0) : 0;
}

// Asked now and then during a run, every some thousand evaluations; true stops it with RunStatus::interrupted.
using StopRequest = std::function<bool(double t)>;

// Told of the end of each step that belongs to the run: q, qd and the work of the torques up to there, J.
using StepObserver = std::function<void(double t, ConstVec q, ConstVec qd, double work)>;

// Samples at `times` (rising, within [0, duration]) on the method's dense output; t = 0 and the ends of steps
// give the steps' own values. Never throws for what happens during the run: see
// Trajectory::status; for what was not ready, see check_ready. Samples end where the run ended; where an event ended it, the last one stands at its
// instant. `between`, s: keeps the run at more instants, some so far apart between the samples, too (Trajectory::between); 0, or more than samples are apart: does not.
Trajectory simulate(const Simulation& simulation, std::span<const double> times, const StopRequest& stop = {},
                    const StepObserver& observer = {}, double between = 0);

// Samples at 0 and at the end of every step; the last one at the event that ended the run, if one did.
Trajectory simulate_every_step(const Simulation& simulation, const StopRequest& stop = {});

}  // namespace chainreel

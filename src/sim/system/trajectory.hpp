// A run as data: the state at the sampled instants and what became of it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/drive/limits.hpp"

namespace chainreel {

enum class RunStatus {
  finished,
  diverged,           // a coordinate left the finite numbers or grew beyond all bounds
  torque_not_finite,  // a torque expression gave no finite number
  stopped,            // a joint passed its limit or an event happened, and the scene stops there
  event_not_finite,   // an event's expression gave no finite number
  not_converged,      // the equations of an implicit step found no solution
  step_too_small,     // an adaptive method found no step that meets its tolerance
  inconsistent,       // constraints contradict each other: no acceleration fulfils them
  constraint_lost,    // the way back onto the constraints was not found
  chattering,         // a torque jumps to and fro at ever shorter intervals
  out_of_budget,      // it took all the evaluations that it was given
  interrupted,        // the user stopped it
};

std::string to_string(RunStatus status);

// The run came to an end that the scene asked for.
inline bool is_complete(RunStatus status) {
  return status == RunStatus::finished || status == RunStatus::stopped;
}

// The energy at the ends of steps, where a run was looked at (simulate_audited): how far it was off by the method's own
// error, without that of its dense output, and how much of it was at stake, also between samples.
struct EnergyAtSteps {
  double largest_error = 0;  // of |E(t) - E(0) - work|, J
  double signed_error = 0;   // that one with its sign
  double time = 0;           // of it, s
  double at_end = 0;         // of the last step, signed, J
  double largest_kinetic = 0;  // J
  double moved = 0;            // the largest of that and of the ranges of potential energy and of work, J
};

// The events that happened, in the order of time.
struct EventHits {
  std::vector<int> event;  // index into the scene's list
  std::vector<double> t;   // s
  std::vector<double> q;   // nq numbers a hit: the state at that instant
  std::vector<double> qd;  // nv numbers a hit
  std::vector<int> from_start;  // those that held at t = 0 already
  struct Hasty {
    int event;
    double t;  // s: when it was seen first
  };
  std::vector<Hasty> hasty;  // those whose values turn round from look to look: some of what happens is not seen

  int size() const { return int(t.size()); }
  std::span<const double> q_at(int k) const { return row(q, k); }
  std::span<const double> qd_at(int k) const { return row(qd, k); }

  void reserve(std::size_t hits, std::size_t nq, std::size_t nv) {
    event.reserve(hits);
    t.reserve(hits);
    q.reserve(hits * nq);
    qd.reserve(hits * nv);
  }
  void add(int which, double instant, std::span<const double> position, std::span<const double> rate) {
    event.push_back(which);
    t.push_back(instant);
    q.insert(q.end(), position.begin(), position.end());
    qd.insert(qd.end(), rate.begin(), rate.end());
  }

 private:
  std::span<const double> row(const std::vector<double>& values, int k) const {
    const std::size_t n = values.size() / t.size();
    return {values.data() + std::size_t(k) * n, n};
  }
};

struct Trajectory {
  int nq = 0;
  int nv = 0;
  std::vector<double> t;     // sampled instants, s
  std::vector<double> q;     // nq numbers a sample
  std::vector<double> qd;    // nv numbers a sample
  std::vector<double> work;  // a number a sample: integral of qd^T (tau - tau_f) dt since the start, J
  int rows = 0;                // of the constraints
  std::vector<double> lambda;  // rows numbers a sample: N or N m; +Jc^T lambda acts on the surroundings
  double position_error = 0;   // the largest |phi| over the samples, m or rad
  double velocity_error = 0;   // the largest |Jc qd|, m/s or rad/s

  RunStatus status = RunStatus::finished;
  double end_time = 0;   // reached, s
  long steps = 0;        // taken
  long evaluations = 0;  // of the forward dynamics
  std::string trouble;   // one sentence where the status is not `finished`: time, step and joint

  std::optional<EnergyAtSteps> energy_at_steps;  // where it was asked for

  std::vector<LimitEvent> limits;  // passed, each joint and quantity once
  // While corners of the torques were kept at zero, like dry friction at rest.
  struct Hold {
    double begin, end;         // s; infinite where the run ended in it
    std::vector<int> corners;  // see ChainSystem::hold
  };
  std::vector<Hold> holds;
  std::vector<double> start_sides;  // of the torques' corners that depend on the state, just behind the start; empty: there are none

  EventHits events;
  int ending_event = -1;  // the index of the one that ended the run

  // The same run at these samples, between them, and just before and behind the instants where its torques jump: of curves that
  // are seen. Between samples its work is no number. Null where it was not asked for, and where samples lie nearer to one another.
  std::shared_ptr<const Trajectory> between;

  int size() const { return int(t.size()); }
  std::span<const double> q_at(int k) const {
    return {q.data() + std::size_t(k) * std::size_t(nq), std::size_t(nq)};
  }
  std::span<const double> qd_at(int k) const {
    return {qd.data() + std::size_t(k) * std::size_t(nv), std::size_t(nv)};
  }
  std::span<const double> lambda_at(int k) const {
    return {lambda.data() + std::size_t(k) * std::size_t(rows), std::size_t(rows)};
  }
};

}  // namespace chainreel

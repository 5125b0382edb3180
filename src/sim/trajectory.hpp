// A run as data: the state at the sampled instants and what became of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/limits.hpp"

namespace chainreel {

enum class RunStatus {
  finished,
  diverged,           // a coordinate left the finite numbers or grew beyond all bounds
  torque_not_finite,  // a torque expression gave no finite number
  stopped,            // a joint passed its limit and the scene stops there
  not_converged,      // the equations of an implicit step found no solution
  step_too_small,     // an adaptive method found no step that meets its tolerance
  interrupted,        // the user stopped it
};

std::string to_string(RunStatus status);

// The run came to an end that the scene asked for.
inline bool is_complete(RunStatus status) {
  return status == RunStatus::finished || status == RunStatus::stopped;
}

struct Trajectory {
  int nq = 0;
  int nv = 0;
  std::vector<double> t;     // sampled instants, s
  std::vector<double> q;     // nq numbers a sample
  std::vector<double> qd;    // nv numbers a sample
  std::vector<double> work;  // a number a sample: integral of qd^T (tau - tau_f) dt since the start, J

  RunStatus status = RunStatus::finished;
  double end_time = 0;   // reached, s
  long steps = 0;        // taken
  long evaluations = 0;  // of the forward dynamics
  std::string trouble;   // one sentence where the status is not `finished`: time, step and joint

  std::vector<LimitEvent> limits;  // passed, each joint and quantity once

  int size() const { return int(t.size()); }
  std::span<const double> q_at(int k) const {
    return {q.data() + std::size_t(k) * std::size_t(nq), std::size_t(nq)};
  }
  std::span<const double> qd_at(int k) const {
    return {qd.data() + std::size_t(k) * std::size_t(nv), std::size_t(nv)};
  }
};

}  // namespace chainreel

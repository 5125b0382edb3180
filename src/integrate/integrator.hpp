// A method at work on one system.
#pragma once

#include <span>
#include <vector>

#include "integrate/system.hpp"

namespace chainreel {

enum class StepResult {
  ok,
  not_converged,   // the iteration of an implicit method
  step_too_small,  // no step that can be told from none meets the tolerance
};

class Integrator {
 public:
  Integrator(int nq, int nv) : q_(std::size_t(nq)), v_(std::size_t(nv)) {}
  virtual ~Integrator() = default;

  // Begins at a state: before the first step, and after each jump of the state or of a torque.
  virtual void start(double t, std::span<const double> q, std::span<const double> v) = 0;

  // Puts the state a little aside at time(), less than a step's error: what the method has learnt of the motion
  // stays, what it knew of the state itself goes. Dense output is not asked for until the next step.
  virtual void correct(std::span<const double> q, std::span<const double> v) { start(time_, q, v); }

  // Moves from time() to `end`, which is h away; an adaptive method may stop before it. Allocates nothing.
  // What is not ok leaves no state that could be used. Numbers that are not finite are the caller's to find.
  virtual StepResult step(double end, double h) = 0;

  // Where the last step ended; the state's numbers there.
  double time() const { return time_; }
  std::span<const double> q() const { return q_; }
  std::span<const double> v() const { return v_; }
  double begin_time() const { return begin_; }  // of the last step

  // Dense output: the state at t within the last step. Its error in q is of order dense_order() + 1 in h.
  virtual void interpolate(double t, std::span<double> q, std::span<double> v) = 0;
  virtual int dense_order() const = 0;

  // A path from the last step's begin to its end of which v is the rate: what work is reckoned along. It is the dense output where
  // that has such rates.
  virtual void path(double t, std::span<double> q, std::span<double> v) { interpolate(t, q, v); }
  virtual int path_order() const { return dense_order(); }

 protected:
  double begin_ = 0, time_ = 0;
  std::vector<double> q_, v_;
};

}  // namespace chainreel

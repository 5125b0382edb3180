// The motion within one step: cubic Hermite interpolation between the states at its ends. q from (q, q') at
// both ends (error h^4/384 of the fourth derivative); v as its derivative where q' = v, else cubic Hermite
// from (v, v').
#pragma once

#include <vector>

#include "integrate/system.hpp"

namespace chainreel {

class StepSpan {
 public:
  StepSpan(int nq, int nv);

  // Called before and after the stepper moved the state. The accelerations at the ends are asked of the
  // system only where nq != nv and a state inside the step is wanted.
  void begin(double t, std::span<const double> q, std::span<const double> v);
  void end(SecondOrder& system, double t, std::span<const double> q, std::span<const double> v);

  // The state at time t within the step, into q() and v().
  void move_to(SecondOrder& system, double t);
  std::span<const double> q() const { return q_; }
  std::span<const double> v() const { return v_; }
  double start_time() const { return t0_; }
  double end_time() const { return t1_; }

 private:
  void interpolate_v(SecondOrder& system, double s);

  double t0_ = 0, t1_ = 0;
  bool has_rates_ = false;  // of v, at both ends
  std::vector<double> q0_, v0_, q1_, v1_, q0_dot_, q1_dot_, v0_dot_, v1_dot_, q_, v_;
};

}  // namespace chainreel

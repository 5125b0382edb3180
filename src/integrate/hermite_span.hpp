// The motion within one step from what is known at its ends. Where q' = v: the quintic polynomial in q, q',
// q'' (error h^6 / 46080 of the sixth derivative), v its derivative. Else, with quaternions, or apart, where a crude step moves q
// by another v than those at its ends, which the quintic's derivative would have to make up for: cubic Hermite interpolation of q
// from (q, q') and of v from (v, v').
#pragma once

#include <vector>

#include "integrate/system.hpp"

namespace chainreel {

class HermiteSpan {
 public:
  HermiteSpan(int nq, int nv);

  void start();  // forgets the accelerations at the last step's end
  void begin(double t, std::span<const double> q, std::span<const double> v);
  void end(double t, std::span<const double> q, std::span<const double> v);

  // The state at time t within the step. Both ask the system for the accelerations at the step's ends when they are first
  // called.
  void interpolate(SecondOrder& system, double t, std::span<double> q, std::span<double> v);
  void interpolate_apart(SecondOrder& system, double t, std::span<double> q, std::span<double> v);

  // The state at its beginning.
  const std::vector<double>& first_q() const { return q0_; }
  const std::vector<double>& first_v() const { return v0_; }

  int order() const { return q0_.size() == v0_.size() ? 5 : 3; }

 private:
  void find_rates(SecondOrder& system);

  double t0_ = 0, t1_ = 0;
  bool has_rates_ = false;        // at both ends
  bool has_rate_at_end_ = false;  // of the last step, which is this one's beginning
  std::vector<double> q0_, v0_, q1_, v1_, q0_dot_, q1_dot_, v0_dot_, v1_dot_;
};

}  // namespace chainreel

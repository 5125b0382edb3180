// Step control of the adaptive Runge-Kutta methods: E. Hairer, S. Norsett, G. Wanner, Solving Ordinary
// Differential Equations I (1993), II.4 (norm, first step), and II (1996), IV.2 (PI control).
//
// y = (q, v) are the numbers of the state, e the estimate of a step's own error in them. The norm is
//   |e| = max_i |e_i| / (1 + max(|y0_i|, |y1_i|)),
// the largest component, absolute for numbers below 1 (rad, m, or per second) and relative above. A step is
// accepted where |e| <= tolerance; what is no number is never accepted. With r = |e| / tolerance, p the power
// of h in e, and r' of the accepted step before:
//   h_new = h safety r^-(1/p - 0.75 beta) r'^beta   within the limits of shrinking and growing.
#pragma once

#include <span>

#include "integrate/system.hpp"

namespace chainreel {

// NaN or infinite where an error is.
double error_norm(std::span<const double> e, std::span<const double> y0, std::span<const double> y1);

class StepControl {
 public:
  struct Rule {
    double power;    // p
    double beta;     // of the step before
    double slowest;  // least and largest h_new / h
    double fastest;
  };
  StepControl(double tolerance, const Rule& rule) : tolerance_(tolerance), rule_(rule) {}

  double tolerance() const { return tolerance_; }

  // Forgets all steps: the next one's length is not known.
  void start();
  bool knows_step() const { return h_ > 0; }

  // The first step from y = (q, v) at t towards `end`, where y' = f0; nothing is asked of behind the end, where forces may be no
  // numbers. h is positive unless f0 is not finite. `scratch` and
  // `f_scratch` hold as many numbers as y.
  void choose_first(SecondOrder& system, double t, double end, std::span<const double> y, std::span<const double> f0,
                    std::span<double> scratch, std::span<double> f_scratch);

  // Whether the step is lost: not told from none beside the time itself.
  bool is_lost(double t, double end) const;

  // The next attempt: the length that the control wants, or what brings it to `end` without a tiny last step.
  struct Attempt {
    double h;
    bool reaches_end;
  };
  Attempt next(double t, double end) const;

  // After an attempt of length h: whether it stands; sets the length of the next.
  bool accept(double h, double error);
  // Where the attempt has no result at all: the next is `factor` times as long.
  void reject(double h, double factor);
  // For a method to which an equal step is worth more than a somewhat longer one.
  void set_step(double h) { h_ = h; }
  double step() const { return h_; }

 private:
  double tolerance_;
  Rule rule_;
  double h_ = 0;  // wanted
  double last_ratio_ = 1e-4;
  bool rejected_ = false;  // the attempt before this one
};

// y' of y = (q, v), both as one vector of nq + nv numbers.
void state_rate(SecondOrder& system, double t, std::span<const double> y, std::span<double> f);

}  // namespace chainreel

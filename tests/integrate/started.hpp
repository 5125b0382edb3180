// A method at work on a system of one coordinate.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "integrate/method.hpp"
#include "oscillator.hpp"

namespace chainreel {

class Started {
 public:
  // `tolerance` 0: every step goes where it is told.
  Started(SecondOrder& system, const std::string& method, double tolerance, double t, double q, double v)
      : forms_(system),
        integrator_(
            make_integrator(find_method(method), forms_.forms(), {.tolerance = tolerance, .order = 0})) {
    integrator_->start(t, std::array{q}, std::array{v});
  }
  Integrator* operator->() { return integrator_.get(); }
  double q() const { return integrator_->q()[0]; }
  double v() const { return integrator_->v()[0]; }
  double time() const { return integrator_->time(); }

  // Steps to `end`; the last step's result.
  StepResult go(double end) {
    while (time() < end)
      if (const StepResult result = integrator_->step(end, end - time()); result != StepResult::ok)
        return result;
    return StepResult::ok;
  }

 private:
  AllForms forms_;
  std::unique_ptr<Integrator> integrator_;
};

// The largest error of q within `steps` fixed steps over [0, 2] on the oscillator q = cos t, at these parts
// of each step.
inline double largest_dense_error(const std::string& method, int steps, const std::array<double, 3>& parts) {
  Oscillator system(1);
  Started integrator(system, method, 0, 0, 1, 0);
  const double h = 2.0 / steps;
  double largest = 0, q[1], v[1];
  for (int k = 0; k < steps; ++k) {
    integrator->step((k + 1) * h, h);
    for (const double s : parts) {
      integrator->interpolate((k + s) * h, q, v);
      largest = std::max(largest, std::abs(q[0] - std::cos((k + s) * h)));
    }
  }
  return largest;
}

}  // namespace chainreel

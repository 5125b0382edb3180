// A method at work on a system of one coordinate.
#pragma once

#include <array>
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

}  // namespace chainreel

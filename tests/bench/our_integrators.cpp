#include <cmath>
#include <limits>

#include "bench/integrator_engines.hpp"
#include "sim/system/forms.hpp"

namespace chainreel::bench {
namespace {

class OurMethod final : public EndFinder {
 public:
  OurMethod(const MotionProblem& problem, const std::string& name, int order, std::vector<double> ladder)
      : EndFinder("chainreel " + name + (order > 0 ? " " + std::to_string(order) : ""), std::move(ladder)),
        run_(problem.run),
        method_(find_method(name)),
        order_(order),
        system_(run_),
        forms_(system_, method_) {}

  std::vector<double> end_of(double rung) override {
    if (rung != rung_)
      integrator_ = make_integrator(method_, forms_.forms(), {method_.adaptive ? rung : 0, order_});
    rung_ = rung;
    integrator_->start(0, run_.q0, run_.qd0);
    const StepResult result = method_.adaptive ? run_freely() : run_in_steps(rung);
    if (result != StepResult::ok) return {std::numeric_limits<double>::quiet_NaN()};
    return {integrator_->q().begin(), integrator_->q().end()};
  }

 private:
  StepResult run_freely() {
    StepResult result = StepResult::ok;
    while (result == StepResult::ok && integrator_->time() < run_.duration)
      result = integrator_->step(run_.duration, run_.duration - integrator_->time());
    return result;
  }

  StepResult run_in_steps(double step) {
    StepResult result = StepResult::ok;
    const long steps = std::lround(run_.duration / step);
    for (long k = 1; k <= steps && result == StepResult::ok; ++k)
      result = integrator_->step(double(k) * step, step);
    return result;
  }

  const Simulation& run_;
  const Method& method_;
  int order_;
  ChainSystem system_;
  ChainForms forms_;
  std::unique_ptr<Integrator> integrator_;
  double rung_ = 0;
};

}  // namespace

std::vector<double> decades(double first, double last, int each) {
  std::vector<double> rungs;
  for (int k = 0; first + double(k) / each <= last + 1e-9; ++k)
    rungs.push_back(std::pow(10, -(first + double(k) / each)));
  return rungs;
}

std::unique_ptr<EndFinder> by_our_method(const MotionProblem& problem, const std::string& method, int order,
                                         std::vector<double> rungs) {
  return std::make_unique<OurMethod>(problem, method, order, std::move(rungs));
}

}  // namespace chainreel::bench

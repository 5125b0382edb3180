#include "integrate/stepped.hpp"

#include <algorithm>
#include <utility>

namespace chainreel {
namespace {

class Stepped final : public Integrator {
 public:
  Stepped(SecondOrder& system, std::unique_ptr<Stepper> stepper)
      : Integrator(system.nq(), system.nv()),
        system_(system),
        stepper_(std::move(stepper)),
        span_(system.nq(), system.nv()) {}

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    std::copy(q.begin(), q.end(), q_.begin());
    std::copy(v.begin(), v.end(), v_.begin());
    span_.start();
  }

  StepResult step(double end, double h) override {
    begin_ = time_;
    span_.begin(begin_, q_, v_);
    stepper_->step(system_, begin_, h, q_, v_);
    time_ = end;
    span_.end(end, q_, v_);
    return StepResult::ok;
  }

  void interpolate(double t, std::span<double> q, std::span<double> v) override {
    span_.interpolate(system_, t, q, v);
  }

  int dense_order() const override { return span_.order(); }

 private:
  SecondOrder& system_;
  std::unique_ptr<Stepper> stepper_;
  HermiteSpan span_;
};

}  // namespace

std::unique_ptr<Integrator> make_stepped(SecondOrder& system, std::unique_ptr<Stepper> stepper) {
  return std::make_unique<Stepped>(system, std::move(stepper));
}

}  // namespace chainreel

#include "integrate/in_chart.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace chainreel {
namespace {

class InChart final : public Integrator {
 public:
  InChart(Chart& chart, std::unique_ptr<Integrator> inside)
      : Integrator(chart.own_coordinates(), int(inside->v().size())),
        chart_(chart),
        inside_(std::move(inside)),
        x_(v_.size()),
        x_dot_(v_.size()) {}

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    take(q, v);
    chart_.move_to(q_, v_, x_, x_dot_);
    inside_->start(t, x_, x_dot_);
    is_at_base_ = true;
  }

  void correct(std::span<const double> q, std::span<const double> v) override {
    take(q, v);
    is_at_base_ = false;
  }

  StepResult step(double end, double h) override {
    begin_ = time_;
    if (!is_at_base_) {
      chart_.move_to(q_, v_, x_, x_dot_);
      inside_->correct(x_, x_dot_);
    }
    is_at_base_ = false;
    const StepResult result = inside_->step(end, h);
    if (result != StepResult::ok) return result;
    time_ = inside_->time();
    chart_.leave(inside_->q(), inside_->v(), q_, v_);
    return StepResult::ok;
  }

  void interpolate(double t, std::span<double> q, std::span<double> v) override {
    inside_->interpolate(t, x_, x_dot_);
    chart_.leave(x_, x_dot_, q, v);
  }

  int dense_order() const override { return inside_->dense_order(); }

 private:
  void take(std::span<const double> q, std::span<const double> v) {
    std::copy(q.begin(), q.end(), q_.begin());
    std::copy(v.begin(), v.end(), v_.begin());
  }

  Chart& chart_;
  std::unique_ptr<Integrator> inside_;
  std::vector<double> x_, x_dot_;
  bool is_at_base_ = false;  // the state is the chart's base, and known inside
};

}  // namespace

std::unique_ptr<Integrator> make_in_chart(Chart& chart, std::unique_ptr<Integrator> inside) {
  return std::make_unique<InChart>(chart, std::move(inside));
}

namespace {

class Stepped final : public Integrator {
 public:
  Stepped(SecondOrder& system, std::unique_ptr<Stepper> stepper, int dense_order)
      : Integrator(system.nq(), system.nv()),
        system_(system),
        stepper_(std::move(stepper)),
        span_(system.nq(), system.nv()),
        dense_order_(std::min(dense_order, span_.order())) {}

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
    std::copy(span_.first_q().begin(), span_.first_q().end(), q.begin());
    std::copy(span_.first_v().begin(), span_.first_v().end(), v.begin());
    if (!stepper_->step_shorter(system_, t - begin_, q, v)) span_.interpolate(system_, t, q, v);
  }

  int dense_order() const override { return dense_order_; }

  void path(double t, std::span<double> q, std::span<double> v) override { span_.interpolate(system_, t, q, v); }
  int path_order() const override { return span_.order(); }

 private:
  SecondOrder& system_;
  std::unique_ptr<Stepper> stepper_;
  HermiteSpan span_;
  int dense_order_;
};

}  // namespace

std::unique_ptr<Integrator> make_stepped(SecondOrder& system, std::unique_ptr<Stepper> stepper, int dense_order) {
  return std::make_unique<Stepped>(system, std::move(stepper), dense_order);
}

}  // namespace chainreel

#include "sim/work.hpp"

#include <algorithm>

namespace chainreel {

WorkIntegral::WorkIntegral(const Simulation& simulation, ChainSystem& system)
    : q0_(simulation.q0), tau_(std::size_t(simulation.chain.nv)) {
  const Chain& chain = simulation.chain;
  if (!simulation.torque->is_constant() || chain.has_dissipation) return;
  const ConstVec tau = system.torque(0, simulation.q0, simulation.qd0);
  std::copy(tau.begin(), tau.end(), tau_.begin());
  // With a floating base qd is no derivative of q: the short form holds there only where nothing pushes.
  constant_ = chain.nq == chain.nv || std::all_of(tau_.begin(), tau_.end(), [](double x) { return x == 0; });
}

double WorkIntegral::work_of_constant(ConstVec q) const {
  double sum = 0;
  for (std::size_t i = 0; i < tau_.size(); ++i) sum += tau_[i] == 0 ? 0 : tau_[i] * (q[i] - q0_[i]);
  return sum;
}

double WorkIntegral::simpson(ChainSystem& system, StepSpan& span, double t, double end_power) {
  const double t0 = span.start_time();
  const double middle = t0 + 0.5 * (t - t0);
  span.move_to(system, middle);
  const double middle_power = system.power(middle, span.q(), span.v());
  return (t - t0) / 6 * (begin_power_ + 4 * middle_power + end_power);
}

void WorkIntegral::add_step(ChainSystem& system, StepSpan& span, ConstVec q, ConstVec qd) {
  if (constant_) {
    total_ = work_of_constant(q);
    return;
  }
  if (!has_power_) {
    span.move_to(system, span.start_time());
    end_power_ = system.power(span.start_time(), span.q(), span.v());
    has_power_ = true;
  }
  before_ = total_;
  begin_power_ = end_power_;
  end_power_ = system.power(span.end_time(), q, qd);
  total_ = before_ + simpson(system, span, span.end_time(), end_power_);
}

double WorkIntegral::at(ChainSystem& system, StepSpan& span, double t) {
  if (constant_) return work_of_constant(span.q());
  const double power = system.power(t, span.q(), span.v());
  const double work = before_ + simpson(system, span, t, power);
  span.move_to(system, t);
  return work;
}

}  // namespace chainreel

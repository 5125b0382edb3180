#include "sim/step_span.hpp"

#include <algorithm>

namespace chainreel {
namespace {

// Cubic Hermite polynomials on s in [0, 1]: value y0, slope h y0', value y1, slope h y1'.
struct Hermite {
  double y0, m0, y1, m1;
};

Hermite value_weights(double s) {
  const double r = 1 - s;
  return {(1 + 2 * s) * r * r, s * r * r, s * s * (3 - 2 * s), -s * s * r};
}

Hermite slope_weights(double s) {
  return {6 * s * (s - 1), (1 - s) * (1 - 3 * s), 6 * s * (1 - s), s * (3 * s - 2)};
}

}  // namespace

StepSpan::StepSpan(int nq, int nv)
    : q0_(std::size_t(nq)),
      v0_(std::size_t(nv)),
      q1_(q0_),
      v1_(v0_),
      q0_dot_(q0_),
      q1_dot_(q0_),
      v0_dot_(v0_),
      v1_dot_(v0_),
      q_(q0_),
      v_(v0_) {}

void StepSpan::begin(double t, std::span<const double> q, std::span<const double> v) {
  t0_ = t;
  std::copy(q.begin(), q.end(), q0_.begin());
  std::copy(v.begin(), v.end(), v0_.begin());
}

void StepSpan::end(SecondOrder& system, double t, std::span<const double> q, std::span<const double> v) {
  t1_ = t;
  std::copy(q.begin(), q.end(), q1_.begin());
  std::copy(v.begin(), v.end(), v1_.begin());
  system.q_rate(q0_, v0_, q0_dot_);
  system.q_rate(q1_, v1_, q1_dot_);
  has_rates_ = false;
}

void StepSpan::move_to(SecondOrder& system, double t) {
  const double h = t1_ - t0_;
  const double s = (t - t0_) / h;
  const Hermite w = value_weights(s);
  for (std::size_t i = 0; i < q_.size(); ++i)
    q_[i] = w.y0 * q0_[i] + h * w.m0 * q0_dot_[i] + w.y1 * q1_[i] + h * w.m1 * q1_dot_[i];
  system.normalize(q_);
  interpolate_v(system, s);
}

void StepSpan::interpolate_v(SecondOrder& system, double s) {
  const double h = t1_ - t0_;
  if (q_.size() == v_.size()) {
    const Hermite w = slope_weights(s);
    for (std::size_t i = 0; i < v_.size(); ++i)
      v_[i] = (w.y0 * q0_[i] + w.y1 * q1_[i]) / h + w.m0 * v0_[i] + w.m1 * v1_[i];
    return;
  }
  if (!has_rates_) {
    system.acceleration(t0_, q0_, v0_, v0_dot_);
    system.acceleration(t1_, q1_, v1_, v1_dot_);
    has_rates_ = true;
  }
  const Hermite w = value_weights(s);
  for (std::size_t i = 0; i < v_.size(); ++i)
    v_[i] = w.y0 * v0_[i] + h * w.m0 * v0_dot_[i] + w.y1 * v1_[i] + h * w.m1 * v1_dot_[i];
}

}  // namespace chainreel

#include "integrate/hermite_span.hpp"

#include <algorithm>
#include <utility>

namespace chainreel {
namespace {

// Cubic Hermite polynomials on s in [0, 1]: value y0, slope h y0', value y1, slope h y1'.
struct Cubic {
  double y0, m0, y1, m1;
  explicit Cubic(double s)
      : y0((1 + 2 * s) * (1 - s) * (1 - s)),
        m0(s * (1 - s) * (1 - s)),
        y1(s * s * (3 - 2 * s)),
        m1(-s * s * (1 - s)) {}
};

// Coefficients of y0 + h y0' s + h^2 y0''/2 s^2 + s^3 (A + B s + C s^2), by what the first three leave of
// value, slope and curvature at s = 1.
struct Quintic {
  double a0, a1, a2, A, B, C;
  Quintic(double h, double y0, double m0, double k0, double y1, double m1, double k1)
      : a0(y0), a1(h * m0), a2(0.5 * h * h * k0) {
    const double value = (y1 - y0) - a1 - a2, slope = h * m1 - a1 - 2 * a2, curvature = h * h * k1 - 2 * a2;
    A = 10 * value - 4 * slope + 0.5 * curvature;
    B = -15 * value + 7 * slope - curvature;
    C = 6 * value - 3 * slope + 0.5 * curvature;
  }
  double value(double s) const { return a0 + s * (a1 + s * (a2 + s * (A + s * (B + s * C)))); }
  double slope(double s) const { return a1 + s * (2 * a2 + s * (3 * A + s * (4 * B + s * 5 * C))); }
};

}  // namespace

HermiteSpan::HermiteSpan(int nq, int nv)
    : q0_(std::size_t(nq)),
      v0_(std::size_t(nv)),
      q1_(q0_),
      v1_(v0_),
      q0_dot_(q0_),
      q1_dot_(q0_),
      v0_dot_(v0_),
      v1_dot_(v0_) {}

void HermiteSpan::start() {
  has_rates_ = has_rate_at_end_ = false;
}

void HermiteSpan::begin(double t, std::span<const double> q, std::span<const double> v) {
  t0_ = t;
  std::copy(q.begin(), q.end(), q0_.begin());
  std::copy(v.begin(), v.end(), v0_.begin());
  has_rate_at_end_ = has_rates_;
  has_rates_ = false;
}

void HermiteSpan::end(double t, std::span<const double> q, std::span<const double> v) {
  t1_ = t;
  std::copy(q.begin(), q.end(), q1_.begin());
  std::copy(v.begin(), v.end(), v1_.begin());
}

void HermiteSpan::find_rates(SecondOrder& system) {
  if (has_rate_at_end_)
    std::swap(v0_dot_, v1_dot_);
  else
    system.acceleration(t0_, q0_, v0_, v0_dot_);
  system.acceleration(t1_, q1_, v1_, v1_dot_);
  system.q_rate(q0_, v0_, q0_dot_);
  system.q_rate(q1_, v1_, q1_dot_);
  has_rates_ = true;
}

void HermiteSpan::interpolate(SecondOrder& system, double t, std::span<double> q, std::span<double> v) {
  if (q.size() != v.size()) return interpolate_apart(system, t, q, v);
  if (!has_rates_) find_rates(system);
  const double h = t1_ - t0_;
  const double s = (t - t0_) / h;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Quintic y(h, q0_[i], v0_[i], v0_dot_[i], q1_[i], v1_[i], v1_dot_[i]);
    q[i] = y.value(s);
    v[i] = y.slope(s) / h;
  }
}

void HermiteSpan::interpolate_apart(SecondOrder& system, double t, std::span<double> q, std::span<double> v) {
  if (!has_rates_) find_rates(system);
  const double h = t1_ - t0_;
  const Cubic w((t - t0_) / h);
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] = w.y0 * q0_[i] + h * w.m0 * q0_dot_[i] + w.y1 * q1_[i] + h * w.m1 * q1_dot_[i];
  system.normalize(q);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = w.y0 * v0_[i] + h * w.m0 * v0_dot_[i] + w.y1 * v1_[i] + h * w.m1 * v1_dot_[i];
}

}  // namespace chainreel

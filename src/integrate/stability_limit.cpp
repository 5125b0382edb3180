#include "integrate/stability_limit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chainreel {
namespace {

// omega h is looked for on this grid, then by halving; the widest of the explicit methods reaches 6.4.
constexpr double kFinest = 0.01, kWidest = 20;
// A step of unit length multiplies rounding errors by as much; growth below it is none.
constexpr double kRounding = 1e-12;

struct Oscillator final : SecondOrder {
  double omega, damping;
  Oscillator(double omega_, double damping_) : omega(omega_), damping(damping_) {}
  int nq() const override { return 1; }
  int nv() const override { return 1; }
  void acceleration(double, std::span<const double> q, std::span<const double> v,
                    std::span<double> vd) override {
    vd[0] = -omega * omega * q[0] - 2 * damping * omega * v[0];
  }
};

// Of unit mass.
struct OscillatorMomenta final : Momenta {
  explicit OscillatorMomenta(Oscillator& given) : system(given) {}
  int n() const override { return 1; }
  void momentum(std::span<const double>, std::span<const double> v, std::span<double> p) override {
    p[0] = v[0];
  }
  void velocity(std::span<const double>, std::span<const double> p, std::span<double> v) override {
    v[0] = p[0];
  }
  void force(double t, std::span<const double> q, std::span<const double> v,
             std::span<double> p_dot) override {
    system.acceleration(t, q, v, p_dot);
  }
  Oscillator& system;
};

}  // namespace

double amplification(const Method& method, double omega, double damping_ratio, double h) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (method.form == Form::series || method.form == Form::linked_points) return kNaN;
  Oscillator system(omega, damping_ratio);
  OscillatorMomenta momenta(system);
  const auto integrator = make_integrator(method, {&system, &momenta, nullptr, nullptr});
  // The columns of the map, from unit displacement and from unit rate (in units of omega).
  double map[2][2];
  for (int column = 0; column < 2; ++column) {
    integrator->start(0, std::array{column == 0 ? 1.0 : 0.0}, std::array{column == 1 ? omega : 0.0});
    if (integrator->step(h, h) != StepResult::ok) return kNaN;
    map[0][column] = integrator->q()[0];
    map[1][column] = integrator->v()[0] / omega;
  }
  const double half_trace = 0.5 * (map[0][0] + map[1][1]);
  const double det = map[0][0] * map[1][1] - map[0][1] * map[1][0];
  const double discriminant = half_trace * half_trace - det;
  if (discriminant <= 0) return std::sqrt(std::max(det, 0.0));
  return std::abs(half_trace) + std::sqrt(discriminant);
}

double stability_limit(const Method& method, double damping_ratio) {
  const auto is_stable = [&](double h) {
    return amplification(method, 1, damping_ratio, h) <= 1 + kRounding;
  };
  if (!is_stable(kFinest)) return 0;
  double stable = kFinest, unstable = 0;
  for (double h = 2 * kFinest; h <= kWidest; h += kFinest) {
    if (!is_stable(h)) {
      unstable = h;
      break;
    }
    stable = h;
  }
  if (unstable == 0) return std::numeric_limits<double>::infinity();
  while (unstable - stable > 1e-9 * stable) {
    const double middle = 0.5 * (stable + unstable);
    (is_stable(middle) ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace chainreel

#include "integrate/in_momenta.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kStill = 1e-4;  // rad, of 1 + |q|, in a step

}  // namespace

MomentaIntegrator::MomentaIntegrator(const Forms& forms)
    : Integrator(forms.momenta->n(), forms.momenta->n()),
      n_(q_.size()),
      system_(*forms.momenta),
      p_(n_),
      q_carry_(n_),
      p_carry_(n_),
      q_weight_(n_),
      p_weight_(n_),
      second_order_(*forms.second_order),
      span_(int(n_), int(n_)),
      p_largest_(n_),
      force_(n_),
      mass_(n_) {}

void MomentaIntegrator::start(double t, std::span<const double> q, std::span<const double> v) {
  begin_ = time_ = t;
  std::fill(p_largest_.begin(), p_largest_.end(), 0.0);
  is_first_ = true;
  correct(q, v);
  forget();
}

void MomentaIntegrator::correct(std::span<const double> q, std::span<const double> v) {
  std::copy(q.begin(), q.end(), q_.begin());
  std::copy(v.begin(), v.end(), v_.begin());
  system_.momentum(q_, v_, p_);
  for (auto* carry : {&q_carry_, &p_carry_}) std::fill(carry->begin(), carry->end(), 0.0);
  span_.start();
}

StepResult MomentaIntegrator::step(double end, double h) {
  begin_ = time_;
  span_.begin(begin_, q_, v_);
  measure(h);
  if (!move(begin_, h)) return StepResult::not_converged;
  system_.velocity(q_, p_, v_);
  time_ = end;
  span_.end(end, q_, v_);
  return StepResult::ok;
}

void MomentaIntegrator::interpolate(double t, std::span<double> q, std::span<double> v) {
  if (is_crude())
    span_.interpolate_apart(second_order_, t, q, v);
  else
    span_.interpolate(second_order_, t, q, v);
}

// The largest momentum so far; before the first step, what the forces give in it. One that is a thousand
// times smaller than another is measured by that one, and one that moves its joint by less than a ten thousandth in a step by what
// would move it so: at rest in an equilibrium all is rounding of forces, which has no size of its own.
void MomentaIntegrator::measure(double h) {
  for (std::size_t i = 0; i < n_; ++i) p_largest_[i] = std::max(p_largest_[i], std::fabs(p_[i]));
  const std::vector<double>& size = is_first_ ? force_ : p_largest_;
  if (is_first_) {
    system_.force(begin_, q_, v_, force_);
    for (std::size_t i = 0; i < n_; ++i) force_[i] = std::max(std::fabs(h * force_[i]), p_largest_[i]);
    find_masses();
  }
  is_first_ = false;
  const double largest = *std::max_element(size.begin(), size.end());
  const double least = largest > 0 ? 1e-3 * largest : 1;
  for (std::size_t i = 0; i < n_; ++i) {
    q_weight_[i] = 1 / (1 + std::fabs(q_[i]));
    const double still = kStill * mass_[i] / (h * q_weight_[i]);
    p_weight_[i] = 1 / std::max({size[i], least, still});
  }
}

// Of each freedom by itself at the start; q_carry_ and p_carry_ are zero there, and so they are behind it.
void MomentaIntegrator::find_masses() {
  for (std::size_t i = 0; i < n_; ++i) {
    q_carry_[i] = 1;
    system_.momentum(q_, q_carry_, p_carry_);
    mass_[i] = p_carry_[i];
    q_carry_[i] = 0;
  }
  std::fill(p_carry_.begin(), p_carry_.end(), 0.0);
}

void MomentaIntegrator::add(std::span<const double> dx, std::span<double> x, std::span<double> carry) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double before = x[i];
    carry[i] += dx[i];
    x[i] = before + carry[i];
    carry[i] += before - x[i];
  }
}

void MomentaIntegrator::stage(std::span<const double> x, std::span<const double> carry,
                              std::span<const double> dx, std::span<double> y) {
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] + (carry[i] + dx[i]);
}

bool Extrapolation::predict(double h, std::span<double> x) const {
  if (known_ == 0 || h != h_) return false;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = known_ == 1 ? last_[i] : 2 * last_[i] - before_[i];
  return true;
}

void Extrapolation::learn(double h, std::span<const double> x) {
  if (h != h_) known_ = 0;
  h_ = h;
  std::swap(last_, before_);
  std::copy(x.begin(), x.end(), last_.begin());
  known_ = std::min(known_ + 1, 2);
}

}  // namespace chainreel

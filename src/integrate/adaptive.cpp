#include "integrate/adaptive.hpp"

#include <algorithm>
#include <cmath>

#include "core/scalar.hpp"

namespace chainreel {
namespace {

constexpr double kSafety = 0.9;
constexpr double kLeastRatio = 1e-4;    // a lucky step says little about the next
constexpr double kLost = 16 * 0x1p-52;  // of the time: below it, stages fall on the same instants
constexpr double kNearlyThere = 1.01;   // a step may stretch by this to spare a tiny last one

// max_i |x_i| / (1 + |y_i|); NaN where an x is.
double size_of(std::span<const double> x, std::span<const double> y) {
  return error_norm(x, y, y);
}

}  // namespace

double error_norm(std::span<const double> e, std::span<const double> y0, std::span<const double> y1) {
  double largest = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double part = std::fabs(e[i]) / (1 + std::max(std::fabs(y0[i]), std::fabs(y1[i])));
    if (!(part <= largest)) largest = part;
    if (std::isnan(part)) return part;
  }
  return largest;
}

void state_rate(SecondOrder& system, double t, std::span<const double> y, std::span<double> f) {
  const std::size_t nq = std::size_t(system.nq());
  if (2 * nq == y.size())
    std::copy(y.begin() + std::ptrdiff_t(nq), y.end(), f.begin());
  else
    system.q_rate(y.first(nq), y.subspan(nq), f.first(nq));
  system.acceleration(t, y.first(nq), y.subspan(nq), f.subspan(nq));
}

void StepControl::start() {
  h_ = 0;
  last_ratio_ = kLeastRatio;
  rejected_ = false;
}

void StepControl::choose_first(SecondOrder& system, double t, double end, std::span<const double> y,
                               std::span<const double> f0, std::span<double> scratch,
                               std::span<double> f_scratch) {
  // An explicit Euler step that moves y by a hundredth of itself shows how fast y' changes.
  const double d0 = size_of(y, y) / tolerance_, d1 = size_of(f0, y) / tolerance_;
  const double h0 = std::min(d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1, end - t);
  for (std::size_t i = 0; i < y.size(); ++i) scratch[i] = y[i] + h0 * f0[i];
  state_rate(system, t + h0, scratch, f_scratch);
  for (std::size_t i = 0; i < y.size(); ++i) f_scratch[i] -= f0[i];
  const double d2 = size_of(f_scratch, y) / tolerance_ / h0;
  const double steepest = std::max(d1, d2);
  const double h1 = steepest <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : power(0.01 / steepest, 1 / rule_.power);
  h_ = std::min(100 * h0, h1);
}

bool StepControl::is_lost(double t, double end) const {
  return !(h_ > kLost * std::max(std::fabs(t), std::fabs(end)));
}

StepControl::Attempt StepControl::next(double t, double end) const {
  const double left = end - t;
  if (kNearlyThere * h_ >= left) return {left, true};
  if (2 * h_ > left) return {0.5 * left, false};
  return {h_, false};
}

bool StepControl::accept(double h, double error) {
  const double ratio = error / tolerance_;
  if (!std::isfinite(ratio)) {
    reject(h, 0.1);
    return false;
  }
  const double proportional = power(std::max(ratio, 1e-30), -(1 / rule_.power - 0.75 * rule_.beta));
  if (!(ratio <= 1)) {
    h_ = h * std::clamp(kSafety * proportional, rule_.slowest, 1.0);
    rejected_ = true;
    return false;
  }
  const double factor = kSafety * proportional * power(last_ratio_, rule_.beta);
  const double wanted = h * std::clamp(factor, rule_.slowest, rejected_ ? 1.0 : rule_.fastest);
  // A step cut short by its end says nothing against the length that was wanted.
  h_ = h < h_ && !rejected_ ? std::max(h_, wanted) : wanted;
  last_ratio_ = std::max(ratio, kLeastRatio);
  rejected_ = false;
  return true;
}

void StepControl::reject(double h, double factor) {
  h_ = factor * h;
  rejected_ = true;
}

}  // namespace chainreel

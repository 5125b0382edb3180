#include "sim/quad_extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kFirstStep = 0.05;  // s
constexpr double kSafety = 0.8, kSlowest = 0.2, kFastest = 2;
constexpr double kShortest = 1e-12;  // s

}  // namespace

QuadExtrapolation::QuadExtrapolation(QuadSystem& system, int columns, double tolerance)
    : system_(system),
      n_(std::size_t(system.n())),
      tolerance_(tolerance),
      table_(std::size_t(columns), std::vector<Quad>(2 * n_)),
      y_(2 * n_),
      before_(2 * n_),
      f_(2 * n_) {}

void QuadExtrapolation::start(Quad t, std::vector<Quad> q, std::vector<Quad> v) {
  t_ = t;
  h_ = kFirstStep;
  q_ = std::move(q);
  v_ = std::move(v);
}

void QuadExtrapolation::rate(Quad t, const std::vector<Quad>& y, std::vector<Quad>& f) {
  const std::span<const Quad> q(y.data(), n_), v(y.data() + n_, n_);
  std::copy(v.begin(), v.end(), f.begin());
  system_.acceleration(t, q, v, std::span(f).subspan(n_));
}

void QuadExtrapolation::midpoint(Quad h, int substeps, std::vector<Quad>& y) {
  const Quad part = h / substeps;
  std::copy(q_.begin(), q_.end(), before_.begin());
  std::copy(v_.begin(), v_.end(), before_.begin() + std::ptrdiff_t(n_));
  rate(t_, before_, f_);
  for (std::size_t i = 0; i < 2 * n_; ++i) y[i] = before_[i] + part * f_[i];
  for (int k = 1; k < substeps; ++k) {
    rate(t_ + k * part, y, f_);
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      const Quad next = before_[i] + 2 * part * f_[i];
      before_[i] = y[i];
      y[i] = next;
    }
  }
}

double QuadExtrapolation::attempt(Quad h) {
  double error = 0;
  for (std::size_t j = 0; j < table_.size(); ++j) {
    midpoint(h, 2 * int(j + 1), y_);
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      Quad better = y_[i];
      for (std::size_t k = 0; k < j; ++k) {
        const Quad ratio = Quad(double(j + 1)) / Quad(double(j - k));
        const Quad next = better + (better - table_[k][i]) / (ratio * ratio - 1);
        table_[k][i] = better;
        better = next;
      }
      table_[j][i] = better;
    }
  }
  const std::vector<Quad>&best = table_.back(), &worse = table_[table_.size() - 2];
  for (std::size_t i = 0; i < 2 * n_; ++i) {
    const double part = std::abs(double(best[i] - worse[i])) / (1 + std::abs(double(best[i])));
    if (!(part <= error)) error = part;
  }
  return error / tolerance_;
}

bool QuadExtrapolation::run_to(Quad end) {
  const double power = 1.0 / (2 * double(table_.size()) - 1);
  while (t_ < end) {
    const bool last = t_ + h_ >= end;
    const Quad h = last ? end - t_ : h_;
    const double error = attempt(h);
    const double factor =
        std::isfinite(error)
            ? std::clamp(kSafety * std::pow(std::max(error, 1e-30), -power), kSlowest, kFastest)
            : kSlowest;
    if (error <= 1) {
      t_ = last ? end : t_ + h;
      std::copy_n(table_.back().begin(), n_, q_.begin());
      std::copy_n(table_.back().begin() + std::ptrdiff_t(n_), n_, v_.begin());
      if (!last || factor < 1) h_ = h * factor;
    } else {
      h_ = h * std::min(factor, 0.9);
      if (h_ < kShortest) return false;
    }
  }
  return true;
}

}  // namespace chainreel

#include "sim/spline.hpp"

#include <algorithm>

namespace chainreel {
namespace {

// Solves the tridiagonal system in place (Thomas); diagonally dominant for splines of rising t.
void solve_tridiagonal(std::vector<double>& lower, std::vector<double>& diagonal, std::vector<double>& upper,
                       std::vector<double>& right) {
  const std::size_t n = right.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - upper[i] * right[i + 1]) / diagonal[i];
}

// Second derivatives M_i: h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (slope_i - slope_{i-1}),
// the ends eliminated by the not-a-knot condition (the third derivative continues over the second and the
// last but one sample).
std::vector<double> curvatures(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> curvature(n, 0.0);
  if (n < 3) return curvature;
  const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
  if (n == 3) {
    const double all = 2 * (slope(1) - slope(0)) / (h(0) + h(1));
    return {all, all, all};
  }
  const std::size_t inner = n - 2;
  std::vector<double> lower(inner), diagonal(inner), upper(inner), right(inner);
  for (std::size_t k = 0; k < inner; ++k) {
    lower[k] = h(k);
    diagonal[k] = 2 * (h(k) + h(k + 1));
    upper[k] = h(k + 1);
    right[k] = 6 * (slope(k + 1) - slope(k));
  }
  const double first = h(0) / h(1), last = h(n - 2) / h(n - 3);
  diagonal.front() += h(0) * (1 + first);
  upper.front() -= h(0) * first;
  diagonal.back() += h(n - 2) * (1 + last);
  lower.back() -= h(n - 2) * last;
  solve_tridiagonal(lower, diagonal, upper, right);
  std::copy(right.begin(), right.end(), curvature.begin() + 1);
  curvature[0] = curvature[1] + first * (curvature[1] - curvature[2]);
  curvature[n - 1] = curvature[n - 2] + last * (curvature[n - 2] - curvature[n - 3]);
  return curvature;
}

}  // namespace

Spline::Spline(std::vector<double> t, std::vector<double> y)
    : t_(std::move(t)), y_(std::move(y)), curvature_(curvatures(t_, y_)) {}

Spline::Value Spline::at(double t) const {
  if (t < t_.front() || t_.size() == 1) return {y_.front(), 0, 0};
  if (t > t_.back()) return {y_.back(), 0, 0};
  const auto above = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  const auto i = std::size_t(above - t_.begin()) - 1;
  const double h = t_[i + 1] - t_[i], s = t - t_[i], r = t_[i + 1] - t;
  const double c0 = curvature_[i], c1 = curvature_[i + 1];
  const double a0 = y_[i] / h - c0 * h / 6, a1 = y_[i + 1] / h - c1 * h / 6;
  return {c0 * r * r * r / (6 * h) + c1 * s * s * s / (6 * h) + a0 * r + a1 * s,
          (c1 * s * s - c0 * r * r) / (2 * h) + a1 - a0, (c0 * r + c1 * s) / h};
}

}  // namespace chainreel

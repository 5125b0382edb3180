// x = g(x), solved to round-off: by fixed-point iteration where it contracts, else by simplified Newton
// iteration (I - g') dx = g(x) - x with g' from differences, kept while it serves.
//
// When to stop: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), VIII.6. An iteration
// is over when its increments no longer decrease, or when the next one, by their ratio so far, would be a
// hundredth of round-off. A tolerance instead would leave an error of one sign in each step, and the energy
// would drift with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "integrate/dense_lu.hpp"

namespace chainreel {

class ImplicitEquation {
 public:
  explicit ImplicitEquation(std::size_t n)
      : next_(n),
        guess_(n),
        column_(n),
        matrix_(n <= kMostUnknowns ? n : 0),
        has_newton_(n <= kMostUnknowns) {}

  // Begins anew: the system may have changed.
  void forget() { contracts_ = true, has_matrix_ = false; }
  // Newton's iteration is at work: g is steep, and what it says is less exact than x.
  bool is_steep() const { return !contracts_; }

  // x: the guess, then the solution; weight: of each unknown, one over its size. g(x, gx) writes g(x). False
  // where neither iteration finds a solution.
  template <class G>
  bool solve(G&& g, std::span<const double> weight, std::span<double> x) {
    std::copy(x.begin(), x.end(), guess_.begin());
    if (contracts_) {
      if (iterate(weight, x, [&] { g(x, next_); })) return true;
      std::copy(guess_.begin(), guess_.end(), x.begin());
      if (!has_newton_) return false;
    }
    for (int attempt = 0; attempt < kMostMatrices; ++attempt) {
      if (!has_matrix_) find_matrix(g, weight, x);
      const bool found = iterate(weight, x, [&] {
        g(x, next_);
        for (std::size_t i = 0; i < x.size(); ++i) next_[i] -= x[i];
        matrix_.solve(next_);
        for (std::size_t i = 0; i < x.size(); ++i) next_[i] += x[i];
      });
      if (found) {
        contracts_ = false;
        return true;
      }
      has_matrix_ = false;
      if (!is_finite(x)) std::copy(guess_.begin(), guess_.end(), x.begin());
    }
    return false;
  }

 private:
  static constexpr std::size_t kMostUnknowns = 600;  // whose matrix is worth its 3 MB
  static constexpr int kMostIterations = 40, kMostMatrices = 6;
  static constexpr double kRoundOff = 0x1p-53;
  // Increments that no longer decrease are round-off if they are this small, else the iteration has failed.
  static constexpr double kSolved = 1e-11;

  static bool is_finite(std::span<const double> x) {
    return std::all_of(x.begin(), x.end(), [](double one) { return std::isfinite(one); });
  }

  template <class Next>
  bool iterate(std::span<const double> weight, std::span<double> x, Next&& find_next) {
    double last = std::numeric_limits<double>::infinity();
    int growths = 0;
    for (int k = 0; k < kMostIterations; ++k) {
      find_next();
      double increment = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double part = std::fabs(next_[i] - x[i]) * weight[i];
        if (!(part <= increment)) increment = part;  // also NaN
        x[i] = next_[i];
      }
      if (!std::isfinite(increment)) return false;
      if (increment == 0 || (k > 0 && increment * increment < 0.01 * kRoundOff * last)) return true;
      if (increment >= last) {
        if (increment < kSolved) return true;
        if (++growths > 2) return false;
      }
      last = increment;
    }
    return last < kSolved;
  }

  // I - g' at x.
  template <class G>
  void find_matrix(G&& g, std::span<const double> weight, std::span<double> x) {
    const std::size_t n = x.size();
    g(x, next_);
    for (std::size_t j = 0; j < n; ++j) {
      const double kept = x[j];
      x[j] = kept + 0x1p-26 / weight[j];
      g(x, column_);
      const double dx = x[j] - kept;
      for (std::size_t i = 0; i < n; ++i) matrix_(i, j) = (i == j) - (column_[i] - next_[i]) / dx;
      x[j] = kept;
    }
    matrix_.factor();
    has_matrix_ = true;
  }

  std::vector<double> next_, guess_, column_;
  DenseLu<double> matrix_;
  bool has_newton_;
  bool contracts_ = true, has_matrix_ = false;
};

}  // namespace chainreel

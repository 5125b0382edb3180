#include "sim/choice/quad_series.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr int kLastTerms = 4;
constexpr double kLongestStep = 0.25;  // s; also where the last terms are all missing
constexpr double kShortestStep = 1e-12;        // s

}  // namespace

QuadSeries::QuadSeries(const Chain& chain, const AffineTorque& torque, int order, double tolerance)
    : series_(chain, torque, order),
      n_(std::size_t(chain.nv)),
      order_(order),
      tolerance_(tolerance),
      c_(n_ * std::size_t(order + 1)) {}

void QuadSeries::start(Quad t, std::vector<Quad> q, std::vector<Quad> v) {
  t_ = t;
  q_ = std::move(q);
  v_ = std::move(v);
}

double QuadSeries::longest_step() const {
  double longest = kLongestStep;
  for (int k = order_; k > order_ - kLastTerms; --k) {
    for (std::size_t i = 0; i < n_; ++i) {
      const double c = std::abs(double(c_[std::size_t(k) * n_ + i]));
      if (c > 0) longest = std::min(longest, std::pow(tolerance_ / (k * c), 1.0 / (k - 1)));
      if (std::isnan(c)) return 0;
    }
  }
  return longest;
}

bool QuadSeries::run_to(Quad end) {
  while (t_ < end) {
    if (expansions_ >= most_) return false;
    ++expansions_;
    series_.expand(t_, q_, v_, order_, c_);
    const Quad longest = longest_step();
    if (longest < kShortestStep) return false;
    const bool last = t_ + longest >= end;
    const Quad h = last ? end - t_ : longest;
    for (std::size_t i = 0; i < n_; ++i) {
      Quad q = 0, v = 0;
      for (int k = order_; k >= 0; --k) {
        v = v * h + q;
        q = q * h + c_[std::size_t(k) * n_ + i];
      }
      q_[i] = q, v_[i] = v;
    }
    t_ = last ? end : t_ + h;
  }
  return true;
}

}  // namespace chainreel

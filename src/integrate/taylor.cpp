// The Taylor method: q(t + s) = sum_k c_k s^k, with a step from the coefficients themselves. A method of
// order N has terms up to N + 1 in q, so that v, the derivative, has them up to N. A. Jorba, M. Zou,
// Experimental Mathematics 14 (2005) 99-117, section 3.
//
// With a tolerance, the step is the longest for which each of the last four terms stays below it,
//
//   |c_k| h^k <= tolerance (1 + |q|),   k |c_k| h^(k-1) <= tolerance (1 + |v|)   in every component.
//
// Four, because motions with a symmetry lack terms: a chain released at rest lacks the odd ones, and all but
// every fourth where it starts along the horizontal. A rule that looks at two would see none and take any
// step. Where all four are missing, the last term that is there decides; where none is there the motion is
// uniform. Whatever the rule says is then verified: at the step's end the accelerations of the old series are
// compared with those of the next one, which has to be made anyway. Where they differ by more than the terms
// left out explain, the step is halved. Rounding does not fall with the step and is no reason to halve.
//
// Sums of steps carry what rounding takes off each (W. Kahan, Communications of the ACM 8 (1965) 40).

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/scalar.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

constexpr int kLastTerms = 4;
constexpr double kStretch = 1.05;  // a step may stretch by this to spare a tiny last one
// Terms left out of the acceleration are N/h of those of the rate, give or take the shape of the series.
constexpr double kDefectMargin = 20;
constexpr double kDefectRounding = 1e-9;  // of the accelerations: nothing is concluded from less
constexpr double kMostRounding = 1e-3;    // beyond it, a defect is never rounding

// log2 to 0.01, from the bits: a step needs no more, and every machine gets the same.
double rough_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double exponent = double(int(bits >> 52 & 0x7ff) - 1023);
  const double m = std::bit_cast<double>((bits & 0xfffffffffffff) | 0x3ff0000000000000);
  return exponent + (m - 1) * (1 + 0.3465735902799727 * (2 - m));
}

// 2^x to 1 %, for |x| <= 1000.
double rough_exp2(double x) {
  const double whole = std::floor(x), f = x - whole;
  const double m = 1 + f * (1 - 0.3431457505076198 * (1 - f));
  return m * std::bit_cast<double>(std::uint64_t(int(whole) + 1023) << 52);
}


// sum += x with what rounding takes off in `rest`, for |x| of any size.
void add_exactly(double& sum, double& rest, double x) {
  const double y = x + rest;
  const double total = sum + y;
  const double taken = total - sum;
  rest = (sum - (total - taken)) + (y - taken);
  sum = total;
}

class Taylor final : public Integrator {
 public:
  Taylor(Series& series, int order, double tolerance)
      : Integrator(series.n(), series.n()),
        series_(series),
        last_(order + 1),
        tolerance_(tolerance),
        log_tolerance_(tolerance > 0 ? rough_log2(tolerance) : 0),
        n_(std::size_t(series.n())),
        c_(n_ * std::size_t(last_ + 1)),
        next_c_(c_),
        weights_(std::size_t(last_ + 1)),
        inverse_(std::size_t(last_ + 1)),
        now_(n_),
        next_(n_) {
    for (std::size_t k = 1; k < inverse_.size(); ++k) inverse_[k] = 1.0 / double(k);
  }

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    std::copy(q.begin(), q.end(), q_.begin());
    std::copy(v.begin(), v.end(), v_.begin());
    std::fill(now_.begin(), now_.end(), Joint{});
    for (std::size_t i = 0; i < n_; ++i) now_[i].q = q[i], now_[i].v = v[i];
    has_next_ = false;
  }

  StepResult step(double end, double h) override {
    if (has_next_)
      c_.swap(next_c_);
    else
      series_.expand(time_, q_, v_, last_, c_);
    has_next_ = false;
    if (tolerance_ <= 0) {
      move(h);
      return accept(end);
    }
    const double longest = longest_step();
    if (std::isnan(longest)) {  // the state is unfit: the caller finds it in what comes of the step
      move(h);
      return accept(end);
    }
    bool whole = longest * kStretch >= h;
    double length = whole ? h : longest;
    for (double last_excess = kInfinity;; length *= 0.5, whole = false) {
      const double t = whole ? end : time_ + length;
      if (!whole) length = t - time_;  // what the clock can show
      if (!(length > 0)) return StepResult::step_too_small;
      move(length);
      const Defect defect = defect_at(t, length);
      const bool is_rounding = defect.relative < kMostRounding && defect.excess > 0.5 * last_excess;
      if (defect.excess <= 1 || is_rounding) return accept(t);
      last_excess = defect.excess;
    }
  }

  void interpolate(double t, std::span<double> q, std::span<double> v) override {
    const double h = t - begin_;
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0, slope = 0;
      for (std::size_t k = std::size_t(last_); k >= 1; --k) {
        const double c = c_[k * n_ + i];
        sum = (sum + c) * h;
        slope = slope * h + double(k) * c;
      }
      q[i] = c_[i] + sum;
      v[i] = slope;
    }
  }

  int dense_order() const override { return last_ - 1; }

 private:
  // At the beginning and at the end of the step.
  struct Joint {
    double q = 0, q_rest = 0, v = 0, v_rest = 0, vd = 0;
    double q_weight = 0, v_weight = 0;  // 1 / (1 + |q|), 1 / (1 + |v|)
  };
  // Row k: h^k, k h^(k-1), k (k-1) h^(k-2).
  struct Weights {
    double q = 1, v = 0, vd = 0;
  };

  // log2 of what 1/h must at least be for the terms of order k; minus infinity where there are none.
  double need_of(int k) const {
    const double* const c = c_.data() + std::size_t(k) * n_;
    double q_size = 0, v_size = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double size = std::fabs(c[i]);
      if (std::isnan(size)) return size;
      q_size = std::max(q_size, size * now_[i].q_weight);
      v_size = std::max(v_size, size * now_[i].v_weight);
    }
    if (q_size == 0) return -kInfinity;
    return std::max((rough_log2(q_size) - log_tolerance_) * inverse_[std::size_t(k)],
                    (rough_log2(v_size * k) - log_tolerance_) * inverse_[std::size_t(k - 1)]);
  }

  // Infinite for uniform motion, NaN where a coefficient is no number.
  double longest_step() {
    for (std::size_t i = 0; i < n_; ++i) {
      now_[i].q_weight = 1 / (1 + std::fabs(q_[i]));
      now_[i].v_weight = 1 / (1 + std::fabs(v_[i]));
    }
    double need = -kInfinity;
    int k = last_;
    for (; k > last_ - kLastTerms; --k) {
      const double one = need_of(k);
      if (std::isnan(one)) return one;
      need = std::max(need, one);
    }
    while (need == -kInfinity && k >= 2) need = need_of(k--);
    return need == -kInfinity ? kInfinity : rough_exp2(-std::clamp(need, -1000.0, 1000.0));
  }

  // The state and its acceleration at the end of a step of length h.
  void move(double h) {
    const std::size_t last = std::size_t(last_);
    weights_[1] = {h, 1, 0};
    for (std::size_t k = 2; k <= last; ++k) {
      // A product of halves: a short chain of products, and less rounding.
      const double lower = weights_[(k - 1) / 2].q * weights_[k - 1 - (k - 1) / 2].q;
      weights_[k] = {lower * h, double(k) * lower, 0};
      weights_[k].vd = double(k) * weights_[k - 1].v;
    }
    for (std::size_t i = 0; i < n_; ++i) {
      double dq = 0, dv = 0, vd = 0;
      for (std::size_t k = last; k >= 2; --k) {
        const double c = c_[k * n_ + i];
        dq += weights_[k].q * c;
        dv += weights_[k].v * c;
        vd += weights_[k].vd * c;
      }
      Joint& joint = next_[i] = now_[i];
      add_exactly(joint.q, joint.q_rest, dq + h * c_[n_ + i]);
      add_exactly(joint.v, joint.v_rest, dv);
      joint.vd = vd;
    }
  }

  // By how much the next series' acceleration differs from this one's, in units of what is allowed, and of
  // the acceleration.
  struct Defect {
    double excess, relative;
  };

  // Makes the next series.
  Defect defect_at(double t, double h) {
    for (std::size_t i = 0; i < n_; ++i) {
      q_[i] = next_[i].q, v_[i] = next_[i].v;
      if (!std::isfinite(q_[i]) || !std::isfinite(v_[i])) return {kInfinity, kInfinity};
    }
    series_.expand(t, q_, v_, last_, next_c_);
    has_next_ = true;
    double size = 0, largest = 0, excess = 0;
    for (std::size_t i = 0; i < n_; ++i)
      size = std::max({size, std::fabs(next_[i].vd), 2 * std::fabs(next_c_[2 * n_ + i])});
    const double allowed = kDefectMargin * tolerance_ * last_ / h;
    for (std::size_t i = 0; i < n_; ++i) {
      const double defect = std::fabs(next_[i].vd - 2 * next_c_[2 * n_ + i]);
      if (!(defect < kInfinity)) return {kInfinity, kInfinity};
      largest = std::max(largest, defect);
      excess = std::max(excess, defect / (allowed * (1 + std::fabs(v_[i])) + kDefectRounding * size));
    }
    return {excess, largest > 0 ? largest / size : 0};
  }

  StepResult accept(double t) {
    begin_ = time_;
    time_ = t;
    now_.swap(next_);
    for (std::size_t i = 0; i < n_; ++i) q_[i] = now_[i].q, v_[i] = now_[i].v;
    return StepResult::ok;
  }

  Series& series_;
  int last_;  // term of q: the order plus 1
  double tolerance_;
  double log_tolerance_;
  std::size_t n_;
  std::vector<double> c_, next_c_;  // of the last step, and of the next one where has_next_
  bool has_next_ = false;
  std::vector<Weights> weights_;
  std::vector<double> inverse_;  // 1/k
  std::vector<Joint> now_, next_;
};

}  // namespace

std::unique_ptr<Integrator> make_taylor(const Forms& forms, const MethodOptions& options) {
  constexpr int kUsualOrder = 20;
  return std::make_unique<Taylor>(*forms.series, options.order > 0 ? options.order : kUsualOrder,
                                  options.tolerance);
}

}  // namespace chainreel

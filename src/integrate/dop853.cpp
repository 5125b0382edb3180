// DOP853 on y = (q, v), y' = (N(q) v, f(t, q, v)); see dop853_tableau.hpp for the numbers and their source
// and adaptive.hpp for the norm and the choice of steps. The estimate of a step's error is, as there
// (II.10, 10.17), |e5| |e5| / sqrt(|e5|^2 + 0.01 |e3|^2), which goes with h^8.
//
// 12 evaluations per step: the rate at the end of a step is that at the beginning of the next, and is asked
// for when one of the two needs it. A step that is looked into costs 3 more.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "integrate/adaptive.hpp"
#include "integrate/dop853_tableau.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

using namespace dop853;

constexpr StepControl::Rule kRule{.power = 8, .beta = 0.02, .slowest = 1.0 / 3, .fastest = 6};

// The entries of a row that are not zero.
struct Sum {
  struct Term {
    std::uint32_t stage;
    double factor;
  };
  std::size_t size = 0;
  std::array<Term, kAllStages> terms{};
  constexpr explicit Sum(const Row& row) {
    for (std::uint32_t j = 0; j < kAllStages; ++j)
      if (row[j] != 0) terms[size++] = {j, row[j]};
  }
};

template <std::size_t... I>
constexpr std::array<Sum, sizeof...(I)> sums_of(const Row* rows, std::index_sequence<I...>) {
  return {Sum(rows[I])...};
}
constexpr auto kA = sums_of(a.data(), std::make_index_sequence<kAllStages>());
constexpr auto kD = sums_of(d.data(), std::make_index_sequence<d.size()>());
constexpr Sum kE5(e5), kE3(e3);
constexpr std::size_t kTerms = 7;  // r0 .. r6 of the continuous extension

class Dop853 final : public Integrator {
 public:
  Dop853(SecondOrder& system, double tolerance)
      : Integrator(system.nq(), system.nv()),
        system_(system),
        nq_(std::size_t(system.nq())),
        n_(nq_ + std::size_t(system.nv())),
        y0_(n_),
        y1_(n_),
        stage_(n_),
        e5_(n_),
        e3_(n_),
        k_(kAllStages * n_),
        r_(kTerms * n_) {
    if (tolerance > 0) control_.emplace(tolerance, kRule);
  }

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    std::copy(q.begin(), q.end(), y1_.begin());
    std::copy(v.begin(), v.end(), y1_.begin() + std::ptrdiff_t(nq_));
    publish();
    end_rate_is_known_ = false;
    if (control_) control_->start();
  }

  void correct(std::span<const double> q, std::span<const double> v) override {
    std::copy(q.begin(), q.end(), y1_.begin());
    std::copy(v.begin(), v.end(), y1_.begin() + std::ptrdiff_t(nq_));
    publish();
    end_rate_is_known_ = false;
  }

  StepResult step(double end, double h) override {
    begin_step();
    if (!control_) {
      make_step(h);
      end_step(end);
      return StepResult::ok;
    }
    if (!control_->knows_step()) control_->choose_first(system_, begin_, end, y0_, k(0), stage_, k(1));
    while (!control_->is_lost(begin_, end)) {
      const StepControl::Attempt attempt = control_->next(begin_, end);
      h_ = attempt.h;
      make_step(attempt.h);
      if (control_->accept(attempt.h, error())) {
        end_step(attempt.reaches_end ? end : begin_ + attempt.h);
        return StepResult::ok;
      }
    }
    return StepResult::step_too_small;
  }

  void interpolate(double t, std::span<double> q, std::span<double> v) override {
    if (!is_continuous_) make_continuous();
    const double s = (t - begin_) / (time_ - begin_);
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0;
      for (std::size_t j = kTerms; j-- > 0;) sum = (sum + r_[j * n_ + i]) * (j % 2 == 0 ? s : 1 - s);
      (i < nq_ ? q[i] : v[i - nq_]) = y0_[i] + sum;
    }
    system_.normalize(q);
  }

  int dense_order() const override { return 7; }

 private:
  std::span<double> k(std::size_t stage) { return {k_.data() + stage * n_, n_}; }
  void find_rate(std::size_t stage, std::span<const double> y) {
    state_rate(system_, begin_ + c[stage] * h_, y, k(stage));
  }

  // out = sum of the terms' k; of short states in registers.
  void add_up(const Sum& sum, std::span<double> out) const {
    if (n_ == 4) return add_pairs<2>(sum, out.data());
    if (n_ == 6) return add_pairs<3>(sum, out.data());
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t j = 0; j < sum.size; ++j) {
      const double factor = sum.terms[j].factor;
      const double* rate = k_.data() + sum.terms[j].stage * n_;
      for (std::size_t i = 0; i < n_; ++i) out[i] += factor * rate[i];
    }
  }
  template <std::size_t pairs>
  void add_pairs(const Sum& sum, double* out) const {
    using Pair [[gnu::vector_size(16), gnu::may_alias, gnu::aligned(8)]] = double;
    Pair total[pairs] = {};
    for (std::size_t j = 0; j < sum.size; ++j) {
      const double factor = sum.terms[j].factor;
      const Pair* rate = reinterpret_cast<const Pair*>(k_.data() + sum.terms[j].stage * 2 * pairs);
      for (std::size_t p = 0; p < pairs; ++p) total[p] += factor * rate[p];
    }
    std::copy_n(total, pairs, reinterpret_cast<Pair*>(out));
  }
  // out = y0 + h sum of the terms' k.
  void move(const Sum& sum, std::span<double> out) const {
    add_up(sum, out);
    for (std::size_t i = 0; i < n_; ++i) out[i] = y0_[i] + h_ * out[i];
  }

  void begin_step() {
    if (end_rate_is_known_)
      std::copy_n(k(kEnd).begin(), n_, k(0).begin());
    else
      state_rate(system_, time_, y1_, k(0));
    end_rate_is_known_ = is_continuous_ = false;
    begin_ = time_;
    std::swap(y0_, y1_);
  }

  void make_step(double h) {
    h_ = h;
    for (std::size_t s = 1; s < kStages; ++s) {
      move(kA[s], stage_);
      find_rate(s, stage_);
    }
    move(kA[kEnd], y1_);
    system_.normalize(std::span(y1_).first(nq_));
  }

  double error() {
    add_up(kE5, e5_);
    add_up(kE3, e3_);
    const double norm5 = error_norm(e5_, y0_, y1_), norm3 = error_norm(e3_, y0_, y1_);
    const double larger = std::sqrt(norm5 * norm5 + 0.01 * norm3 * norm3);
    return larger == 0 ? 0 : h_ * norm5 * (norm5 / larger);
  }

  void end_step(double end) {
    time_ = end;
    publish();
  }

  void publish() {
    std::copy_n(y1_.begin(), nq_, q_.begin());
    std::copy(y1_.begin() + std::ptrdiff_t(nq_), y1_.end(), v_.begin());
  }

  void make_continuous() {
    state_rate(system_, time_, y1_, k(kEnd));
    end_rate_is_known_ = is_continuous_ = true;
    for (std::size_t s = kEnd + 1; s < kAllStages; ++s) {
      move(kA[s], stage_);
      find_rate(s, stage_);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      const double change = y1_[i] - y0_[i], r1 = h_ * k(0)[i] - change;
      r_[i] = change;
      r_[n_ + i] = r1;
      r_[2 * n_ + i] = change - h_ * k(kEnd)[i] - r1;
    }
    for (std::size_t j = 0; j < kD.size(); ++j) {
      const std::span<double> r(r_.data() + (3 + j) * n_, n_);
      add_up(kD[j], r);
      for (double& x : r) x *= h_;
    }
  }

  SecondOrder& system_;
  std::optional<StepControl> control_;
  std::size_t nq_, n_;
  double h_ = 0;  // of the last step
  bool end_rate_is_known_ = false;
  bool is_continuous_ = false;
  std::vector<double> y0_, y1_, stage_, e5_, e3_, k_, r_;
};

}  // namespace

std::unique_ptr<Integrator> make_dop853(const Forms& forms, const MethodOptions& options) {
  return std::make_unique<Dop853>(*forms.second_order, options.tolerance);
}

}  // namespace chainreel

// Gauss's collocation in coordinates and momenta, y = (q, p), with s = 1 (the implicit midpoint rule), 2 and
// 3 stages: order 2 s, symplectic, symmetric, A-stable.
//
//   Z_i = h sum_j a_ij y'(t_0 + c_j h, y_0 + Z_j),   y_1 = y_0 + h sum_j b_j y'(t_0 + c_j h, y_0 + Z_j)
//
// E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), II.1.3 (table 1.1), VIII.6. The
// increments Z are found to round-off. Where y' is so steep that Newton's iteration finds them, y_1 is taken
// from them instead, as the collocation polynomial through 0 and the Z_i at the step's end, since y' would
// multiply their rounding errors.

#include <algorithm>
#include <array>

#include "integrate/implicit_equation.hpp"
#include "integrate/in_momenta.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

constexpr double kRoot3 = 0x1.bb67ae8584caap+0, kRoot15 = 0x1.efbdeb14f4edap+1;

struct Tableau {
  static constexpr std::size_t kMost = 3;
  std::size_t stages = 1;
  std::array<double, kMost> c{};
  std::array<std::array<double, kMost>, kMost> a{};
  // b_j = weight_j / denominator, all integers: no b is rounded.
  std::array<double, kMost> weight{};
  double denominator = 1;
};

constexpr Tableau kMidpoint{1, {0.5}, {{{0.5}}}, {1}, 1};
constexpr Tableau kGauss4{2,
                          {0.5 - kRoot3 / 6, 0.5 + kRoot3 / 6},
                          {{{0.25, 0.25 - kRoot3 / 6}, {0.25 + kRoot3 / 6, 0.25}}},
                          {1, 1},
                          2};
constexpr Tableau kGauss6{3,
                          {0.5 - kRoot15 / 10, 0.5, 0.5 + kRoot15 / 10},
                          {{{5.0 / 36, 2.0 / 9 - kRoot15 / 15, 5.0 / 36 - kRoot15 / 30},
                            {5.0 / 36 + kRoot15 / 24, 2.0 / 9, 5.0 / 36 - kRoot15 / 24},
                            {5.0 / 36 + kRoot15 / 30, 2.0 / 9 + kRoot15 / 15, 5.0 / 36}}},
                          {5, 8, 5},
                          18};

// The Lagrange polynomial of node j at x.
double lagrange(std::span<const double> nodes, std::size_t j, double x) {
  double product = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (i != j) product *= (x - nodes[i]) / (nodes[j] - nodes[i]);
  return product;
}

// The integral of that polynomial from 0 to x, exactly: its degree is below 6.
double lagrange_integral(std::span<const double> nodes, std::size_t j, double x) {
  double sum = 0;
  for (std::size_t k = 0; k < kGauss6.stages; ++k)
    sum += kGauss6.weight[k] * lagrange(nodes, j, kGauss6.c[k] * x);
  return sum * x / kGauss6.denominator;
}

class Gauss final : public MomentaIntegrator {
 public:
  Gauss(const Forms& forms, const Tableau& tableau)
      : MomentaIntegrator(forms),
        tableau_(tableau),
        s_(tableau.stages),
        q_stage_(n_),
        p_stage_(n_),
        rates_(2 * n_ * s_),
        last_(rates_.size()),
        before_(rates_.size()),
        increments_(rates_.size()),
        weight_(rates_.size()),
        dq_(n_),
        dp_(n_),
        equation_(rates_.size()) {
    // Nodes of the last two steps, seen from the end of the last.
    std::array<double, 2 * Tableau::kMost> nodes;
    for (std::size_t j = 0; j < s_; ++j) nodes[j] = tableau.c[j] - 1, nodes[s_ + j] = tableau.c[j] - 2;
    std::array<double, Tableau::kMost + 1> ends{};
    for (std::size_t i = 0; i < s_; ++i) {
      ends[i + 1] = tableau.c[i];
      for (std::size_t j = 0; j < s_; ++j)
        from_one_[i][j] = lagrange_integral(std::span(nodes).first(s_), j, tableau.c[i]);
      for (std::size_t j = 0; j < 2 * s_; ++j)
        from_two_[i][j] = lagrange_integral(std::span(nodes).first(2 * s_), j, tableau.c[i]);
    }
    for (std::size_t i = 0; i < s_; ++i) to_end_[i] = lagrange(std::span(ends).first(s_ + 1), i + 1, 1);
  }

 private:
  void forget() override {
    known_ = 0;
    equation_.forget();
  }

  // Numbers of stage i: those of q, then those of p.
  std::span<double> q_of(std::vector<double>& stages, std::size_t i) const {
    return std::span(stages).subspan(2 * n_ * i, n_);
  }
  std::span<double> p_of(std::vector<double>& stages, std::size_t i) const {
    return std::span(stages).subspan(2 * n_ * i + n_, n_);
  }
  std::span<const double> q_of(std::span<const double> stages, std::size_t i) const {
    return stages.subspan(2 * n_ * i, n_);
  }
  std::span<const double> p_of(std::span<const double> stages, std::size_t i) const {
    return stages.subspan(2 * n_ * i + n_, n_);
  }

  bool move(double t, double h) override {
    for (std::size_t i = 0; i < s_; ++i) {
      std::copy(q_weight_.begin(), q_weight_.end(), q_of(weight_, i).begin());
      std::copy(p_weight_.begin(), p_weight_.end(), p_of(weight_, i).begin());
    }
    guess(t, h);
    const auto next = [&](std::span<const double> z, std::span<double> z_next) {
      find_rates(t, h, z);
      for (std::size_t i = 0; i < s_; ++i)
        combine(h, tableau_.a[i], rates_, z_next.subspan(2 * n_ * i, 2 * n_));
    };
    if (!equation_.solve(next, weight_, increments_)) return false;
    finish(h);
    std::swap(before_, last_);
    std::swap(last_, rates_);
    known_ = known_ > 0 && h == h_ ? 2 : 1;
    h_ = h;
    return true;
  }

  // rates_ <- y' at the stages y_0 + z
  void find_rates(double t, double h, std::span<const double> z) {
    for (std::size_t i = 0; i < s_; ++i) {
      stage(q_, q_carry_, q_of(z, i), q_stage_);
      stage(p_, p_carry_, p_of(z, i), p_stage_);
      const std::span<double> v = q_of(rates_, i);
      system_.velocity(q_stage_, p_stage_, v);
      system_.force(t + tableau_.c[i] * h, q_stage_, v, p_of(rates_, i));
    }
  }

  // sum <- h sum_j weights_j rates_j
  template <class Weights>
  void combine(double h, const Weights& weights, std::span<const double> rates, std::span<double> sum) const {
    for (std::size_t k = 0; k < 2 * n_; ++k) {
      double total = weights[0] * rates[k];
      for (std::size_t j = 1; j < s_; ++j) total += weights[j] * rates[2 * n_ * j + k];
      sum[k] = h * total;
    }
  }

  // The polynomial through the stages of one or two steps before, continued.
  void guess(double t, double h) {
    if (equation_.is_steep()) {
      std::fill(increments_.begin(), increments_.end(), 0.0);
      return;
    }
    if (known_ == 0 || h != h_) {
      system_.force(t, q_, v_, dp_);
      for (std::size_t i = 0; i < s_; ++i) {
        for (std::size_t k = 0; k < n_; ++k) {
          q_of(increments_, i)[k] = tableau_.c[i] * h * v_[k];
          p_of(increments_, i)[k] = tableau_.c[i] * h * dp_[k];
        }
      }
      return;
    }
    for (std::size_t i = 0; i < s_; ++i) {
      for (std::size_t k = 0; k < 2 * n_; ++k) {
        double total = 0;
        for (std::size_t j = 0; j < s_; ++j) {
          if (known_ == 1)
            total += from_one_[i][j] * last_[2 * n_ * j + k];
          else
            total += from_two_[i][j] * last_[2 * n_ * j + k] + from_two_[i][s_ + j] * before_[2 * n_ * j + k];
        }
        increments_[2 * n_ * i + k] = h * total;
      }
    }
  }

  void finish(double h) {
    const bool steep = equation_.is_steep();
    const std::vector<double>& parts = steep ? increments_ : rates_;
    const std::array<double, Tableau::kMost>& weights = steep ? to_end_ : tableau_.weight;
    const double factor = steep ? 1 : h;
    const double divisor = steep ? 1 : tableau_.denominator;
    for (std::size_t k = 0; k < n_; ++k) {
      double q = 0, p = 0;
      for (std::size_t i = 0; i < s_; ++i) {
        q += weights[i] * q_of(parts, i)[k];
        p += weights[i] * p_of(parts, i)[k];
      }
      dq_[k] = factor * q / divisor;
      dp_[k] = factor * p / divisor;
    }
    add(dq_, q_, q_carry_);
    add(dp_, p_, p_carry_);
  }

  const Tableau& tableau_;
  const std::size_t s_;
  std::array<std::array<double, Tableau::kMost>, Tableau::kMost> from_one_{};
  std::array<std::array<double, 2 * Tableau::kMost>, Tableau::kMost> from_two_{};
  std::array<double, Tableau::kMost> to_end_{};
  std::vector<double> q_stage_, p_stage_;
  std::vector<double> rates_, last_, before_;  // y' at the stages of this step and the two before
  int known_ = 0;                              // steps before, of equal length
  double h_ = 0;
  std::vector<double> increments_, weight_, dq_, dp_;
  ImplicitEquation equation_;
};

}  // namespace

std::unique_ptr<Integrator> make_implicit_midpoint(const Forms& forms, const MethodOptions&) {
  return std::make_unique<Gauss>(forms, kMidpoint);
}

std::unique_ptr<Integrator> make_gauss4(const Forms& forms, const MethodOptions&) {
  return std::make_unique<Gauss>(forms, kGauss4);
}

std::unique_ptr<Integrator> make_gauss6(const Forms& forms, const MethodOptions&) {
  return std::make_unique<Gauss>(forms, kGauss6);
}

}  // namespace chainreel

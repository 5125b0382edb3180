// Radau IIA of order 5, L-stable, for q' = v, v' = f(t, q, v): E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II (1996), IV.8; see radau5_tableau.hpp for A, c, T, gamma, alpha, beta and
// adaptive.hpp for the norm and the choice of steps.
//
// The stages are v_i = v0 + z_i and, because q' = v, q_i = q0 + h (c_i v0 + sum_j a_ij z_j): the z_i alone
// are unknown, z = h A f. With z = T w and the Jacobians Jq = df/dq and Jv = df/dv held fixed, Newton's
// iteration falls apart into one real and one complex system of n equations each, not 2 n:
//   (lambda/h - Jv - h/lambda Jq) dw = T^-1 f - lambda/h w,   lambda = gamma and alpha + i beta.
// Dense output: with steps from a tolerance, which resolve what is stiff where it moves, the quintic
// polynomial in q, q', q'' at a step's ends: measured on stiff and other chains three to ten times nearer
// than that of the stages. With steps as told, where h^2 q'' may be far from any motion: v is the cubic
// polynomial through v0 and the stages, which knows no q'', and q its integral (order 4).
//
// The estimate of a step's error e = (e_q, e_v) is that of a method of order 3, filtered (8.19, 8.20):
//   (gamma/h - J) e = f(y0) + sum_i d_i (y_i - y0) / h.
// It goes with h^4, the error itself with h^6; e is held below 0.1 tolerance^(2/3), so that the error goes in
// proportion to the tolerance.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/scalar.hpp"
#include "integrate/adaptive.hpp"
#include "integrate/dense_lu.hpp"
#include "integrate/hermite_span.hpp"
#include "integrate/makers.hpp"
#include "integrate/radau5_tableau.hpp"

namespace chainreel {
namespace {

using namespace radau5;

constexpr StepControl::Rule kRule{.power = 4, .beta = 0.04, .slowest = 0.2, .fastest = 8};
constexpr int kMostPasses = 7, kMostPassesOfFixedStep = 30;
constexpr double kFixedStepLimit = 1e-15;  // of the last correction: all that doubles can show
constexpr double kStagnation = 1e-11;      // corrections that small which fall no more are rounding
constexpr double kGoodContraction = 1e-3;  // of the iteration: its Jacobians serve the next step too
constexpr double kSameStep = 1.2;          // a step that could grow by less keeps its factors
constexpr double kShrinkWithoutSolution = 0.5;
constexpr double kDifference = 0x1p-26;  // sqrt of the rounding unit: errors of both kinds alike

class Radau5 final : public Integrator {
 public:
  Radau5(SecondOrder& system, double tolerance)
      : Integrator(system.nq(), system.nv()),
        system_(system),
        n_(std::size_t(system.nv())),
        span_(system.nq(), system.nv()),
        y0_(2 * n_),
        y1_(2 * n_),
        f0_(2 * n_),
        error_(2 * n_),
        moved_(2 * n_),
        scratch_(2 * n_),
        Jq_(n_ * n_),
        Jv_(n_ * n_),
        real_(n_),
        complex_(n_),
        z_(3 * n_),
        w_(3 * n_),
        f_(3 * n_),
        Tf_(3 * n_),
        dw_(n_),
        dw_complex_(n_),
        p_(3 * n_) {
    if (tolerance > 0) {
      control_.emplace(0.1 * power(tolerance, 2.0 / 3), kRule);
      limit_ = control_->tolerance() * std::min(0.03, std::sqrt(control_->tolerance()));
    }
  }

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    std::copy(q.begin(), q.end(), y1_.begin());
    std::copy(v.begin(), v.end(), y1_.begin() + std::ptrdiff_t(n_));
    publish();
    has_polynomial_ = jacobian_serves_ = was_rejected_ = false;
    factored_h_ = 0;
    rest_ = 1;
    if (control_) control_->start();
    span_.start();
    is_first_ = true;
  }

  void correct(std::span<const double> q, std::span<const double> v) override {
    std::copy(q.begin(), q.end(), y1_.begin());
    std::copy(v.begin(), v.end(), y1_.begin() + std::ptrdiff_t(n_));
    publish();
    span_.start();
  }

  StepResult step(double end, double h) override {
    begin_step();
    if (!control_) return fixed_step(end, h);
    if (!control_->knows_step()) control_->choose_first(system_, begin_, end, y0_, f0_, scratch_, moved_);
    while (!control_->is_lost(begin_, end)) {
      const StepControl::Attempt attempt = control_->next(begin_, end);
      if (!solve(attempt.h, limit_, kMostPasses)) {
        control_->reject(attempt.h, kShrinkWithoutSolution);
        was_rejected_ = true;
        continue;
      }
      if (control_->accept(attempt.h, estimate(attempt.h))) {
        end_step(attempt.reaches_end ? end : begin_ + attempt.h, attempt.h);
        return StepResult::ok;
      }
      was_rejected_ = true;
      jacobian_serves_ = jacobian_is_here_;
    }
    return StepResult::step_too_small;
  }

  void interpolate(double t, std::span<double> q, std::span<double> v) override {
    if (control_) return span_.interpolate(system_, t, q, v);
    const double s = (t - begin_) / (time_ - begin_), h = time_ - begin_;
    for (std::size_t i = 0; i < n_; ++i) {
      const double p1 = p_[i], p2 = p_[n_ + i], p3 = p_[2 * n_ + i];
      q[i] = y0_[i] + h * s * (y0_[n_ + i] + s * (p1 / 2 + s * (p2 / 3 + s * (p3 / 4))));
      v[i] = y0_[n_ + i] + s * (p1 + s * (p2 + s * p3));
    }
  }

  int dense_order() const override { return control_ ? span_.order() : 4; }

 private:
  void begin_step() {
    begin_ = time_;
    span_.begin(begin_, q_, v_);
    std::swap(y0_, y1_);
    state_rate(system_, begin_, y0_, f0_);
    jacobian_is_here_ = false;
  }

  StepResult fixed_step(double end, double h) {
    if (!solve(h, kFixedStepLimit, kMostPassesOfFixedStep)) return StepResult::not_converged;
    end_step(end, h);
    return StepResult::ok;
  }

  void end_step(double end, double h) {
    find_polynomial();
    step_ = h;
    has_polynomial_ = true;
    is_first_ = was_rejected_ = false;
    jacobian_serves_ = contraction_ <= kGoodContraction;
    if (control_ && jacobian_serves_ && control_->step() >= h && control_->step() <= kSameStep * h)
      control_->set_step(h);
    time_ = end;
    publish();
    span_.end(time_, q_, v_);
  }

  void publish() {
    std::copy_n(y1_.begin(), n_, q_.begin());
    std::copy(y1_.begin() + std::ptrdiff_t(n_), y1_.end(), v_.begin());
  }

  // The stages of a step of length h, into z and y1. False where Newton's iteration does not get there.
  bool solve(double h, double limit, int most_passes) {
    if (!jacobian_serves_ && !jacobian_is_here_) find_jacobian();
    for (;;) {
      if (h != factored_h_) factor(h);
      predict(h);
      if (iterate(h, limit, most_passes)) return true;
      if (jacobian_is_here_) return false;
      find_jacobian();
    }
  }

  // Jq and Jv by forward differences.
  void find_jacobian() {
    for (std::size_t j = 0; j < 2 * n_; ++j) {
      std::copy(y0_.begin(), y0_.end(), moved_.begin());
      moved_[j] += kDifference * (1 + std::fabs(y0_[j]));
      const double difference = moved_[j] - y0_[j];
      const std::span<double> f(scratch_.data(), n_);
      acceleration(begin_, moved_, f);
      std::vector<double>& J = j < n_ ? Jq_ : Jv_;
      for (std::size_t i = 0; i < n_; ++i) J[i * n_ + j % n_] = (f[i] - f0_[n_ + i]) / difference;
    }
    jacobian_is_here_ = true;
    factored_h_ = 0;
  }

  void acceleration(double t, std::span<const double> y, std::span<double> f) {
    system_.acceleration(t, y.first(n_), y.subspan(n_), f);
  }

  void factor(double h) {
    // h / (alpha + i beta)
    const double square = alpha * alpha + beta * beta, re = h * alpha / square, im = -h * beta / square;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        const double jq = Jq_[i * n_ + j], jv = Jv_[i * n_ + j];
        const double unit = i == j ? 1 / h : 0;
        real_(i, j) = gamma * unit - jv - h / gamma * jq;
        complex_(i, j) = {alpha * unit - jv - re * jq, beta * unit - im * jq};
      }
    real_.factor();
    complex_.factor();
    factored_h_ = h;
  }

  // First values of the stages: the polynomial of the last step, carried on.
  void predict(double h) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double s = 1 + c[k] * h / step_;
      for (std::size_t i = 0; i < n_; ++i) {
        double z = 0;
        if (has_polynomial_) {
          const double p1 = p_[i], p2 = p_[n_ + i], p3 = p_[2 * n_ + i];
          z = (s - 1) * (p1 + (s + 1) * p2 + (s * s + s + 1) * p3);
        }
        z_[k * n_ + i] = z;
      }
    }
    multiply(T_inv, z_, w_);
  }

  // out = M x for three vectors side by side.
  void multiply(const Matrix& M, std::span<const double> x, std::span<double> out) const {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < n_; ++i)
        out[k * n_ + i] = M[k][0] * x[i] + M[k][1] * x[n_ + i] + M[k][2] * x[2 * n_ + i];
  }

  // y of stage k.
  void place_stage(double h, std::size_t k, std::span<double> y) const {
    for (std::size_t i = 0; i < n_; ++i) {
      const double sum = A[k][0] * z_[i] + A[k][1] * z_[n_ + i] + A[k][2] * z_[2 * n_ + i];
      y[i] = y0_[i] + h * (c[k] * y0_[n_ + i] + sum);
      y[n_ + i] = y0_[n_ + i] + z_[k * n_ + i];
    }
  }

  bool iterate(double h, double limit, int most_passes) {
    contraction_ = 0;
    // Before the second correction what is left behind one is only known from the steps before.
    rest_ = power(std::max(rest_, 0x1p-52), 0.8);
    double last_size = 0;
    for (int pass = 1; pass <= most_passes; ++pass) {
      const double size = improve(h);
      if (!std::isfinite(size)) return false;
      if (pass > 1) {
        const double theta = size / last_size;
        if (theta >= 0.99) return size <= kStagnation && !control_ ? finish(h) : false;
        contraction_ = pass == 2 ? theta : std::sqrt(theta * contraction_);
        rest_ = theta / (1 - theta);
      }
      if (rest_ * size <= limit) return finish(h);
      if (pass > 1 && control_ && !gets_there(rest_ * size, limit, most_passes - pass)) return false;
      last_size = size;
    }
    return false;
  }

  // Whether `passes` more, each as good as the last, bring what is left below the limit.
  bool gets_there(double left, double limit, int passes) const {
    for (int i = 0; i < passes; ++i) left *= contraction_;
    return left <= limit;
  }

  bool finish(double h) {
    place_stage(h, 2, y1_);
    return true;
  }

  // One pass of Newton's iteration; the size of its correction.
  double improve(double h) {
    for (std::size_t k = 0; k < 3; ++k) {
      place_stage(h, k, moved_);
      acceleration(begin_ + c[k] * h, moved_, std::span(f_).subspan(k * n_, n_));
    }
    multiply(T_inv, f_, Tf_);
    double size = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double w1 = w_[i], w2 = w_[n_ + i], w3 = w_[2 * n_ + i];
      dw_[i] = Tf_[i] - gamma / h * w1;
      dw_complex_[i] = {Tf_[n_ + i] - (alpha * w2 - beta * w3) / h,
                        Tf_[2 * n_ + i] - (beta * w2 + alpha * w3) / h};
    }
    real_.solve(dw_);
    complex_.solve(dw_complex_);
    for (std::size_t i = 0; i < n_; ++i) {
      w_[i] += dw_[i];
      w_[n_ + i] += dw_complex_[i].re;
      w_[2 * n_ + i] += dw_complex_[i].im;
      const double sum = std::fabs(dw_[i]) + magnitude(dw_complex_[i]);
      const double part = sum / (1 + std::fabs(y0_[n_ + i])) + h * sum / (1 + std::fabs(y0_[i]));
      if (!(part <= size)) size = part;
      if (std::isnan(part)) return part;
    }
    multiply(T, w_, z_);
    return size;
  }

  // The polynomial v(s) = v0 + p1 s + p2 s^2 + p3 s^3 through the stages, by divided differences.
  void find_polynomial() {
    for (std::size_t i = 0; i < n_; ++i) {
      const double z1 = z_[i], z2 = z_[n_ + i], z3 = z_[2 * n_ + i];
      const double d1 = z1 / c[0], d12 = (z2 - z1) / (c[1] - c[0]), d23 = (z3 - z2) / (c[2] - c[1]);
      const double e1 = (d12 - d1) / c[1], e2 = (d23 - d12) / (c[2] - c[0]), g = e2 - e1;
      p_[i] = d1 - c[0] * e1 + c[0] * c[1] * g;
      p_[n_ + i] = e1 - (c[0] + c[1]) * g;
      p_[2 * n_ + i] = g;
    }
  }

  // The norm of e. Where it is too large at the first step or after a rejection, f(y0 + e) in the place of
  // f(y0) takes what stiff parts leave in it (8.20).
  double estimate(double h) {
    filter(h, std::span(f0_).subspan(n_), std::span(f0_).first(n_));
    double size = error_norm(error_, y0_, y1_);
    if (!(is_first_ || was_rejected_) || size <= control_->tolerance()) return size;
    for (std::size_t i = 0; i < 2 * n_; ++i) moved_[i] = y0_[i] + error_[i];
    const std::span<double> f(scratch_.data(), n_);
    acceleration(begin_, moved_, f);
    filter(h, f, std::span(moved_).subspan(n_));
    return error_norm(error_, y0_, y1_);
  }

  // e from y' = (q_dot, f): e_q is eliminated by gamma/h e_q - e_v = r_q.
  void filter(double h, std::span<const double> f, std::span<const double> q_dot) {
    for (std::size_t i = 0; i < n_; ++i) {
      const double z1 = z_[i], z2 = z_[n_ + i], z3 = z_[2 * n_ + i];
      error_[i] = (q_dot[i] - y0_[n_ + i]) + dA[0] * z1 + dA[1] * z2 + dA[2] * z3;  // r_q
      dw_[i] = f[i] + (d[0] * z1 + d[1] * z2 + d[2] * z3) / h;
    }
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j) dw_[i] += h / gamma * Jq_[i * n_ + j] * error_[j];
    real_.solve(dw_);
    for (std::size_t i = 0; i < n_; ++i) {
      error_[n_ + i] = dw_[i];
      error_[i] = h / gamma * (error_[i] + dw_[i]);
    }
  }

  SecondOrder& system_;
  std::optional<StepControl> control_;
  double limit_ = kFixedStepLimit;  // of Newton's last correction
  std::size_t n_;
  HermiteSpan span_;
  double step_ = 1;         // of the polynomial
  double factored_h_ = 0;   // of the factors; 0: none
  double contraction_ = 0;  // of Newton's iteration, from pass to pass; 0 where one was enough
  double rest_ = 1;         // what a pass leaves, relative to its correction
  bool has_polynomial_ = false;
  bool jacobian_serves_ = false;   // though it may be of an earlier step
  bool jacobian_is_here_ = false;  // of this step's beginning
  bool is_first_ = true, was_rejected_ = false;
  std::vector<double> y0_, y1_, f0_, error_, moved_, scratch_, Jq_, Jv_;
  DenseLu<double> real_;
  DenseLu<Complex> complex_;
  std::vector<double> z_, w_, f_, Tf_, dw_;  // Tf: T^-1 f
  std::vector<Complex> dw_complex_;
  std::vector<double> p_;
};

}  // namespace

std::unique_ptr<Integrator> make_radau5(const Forms& forms, const MethodOptions& options) {
  return std::make_unique<Radau5>(*forms.second_order, options.tolerance);
}

}  // namespace chainreel

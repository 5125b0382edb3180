// The Stoermer-Verlet method in coordinates and momenta, for any T(q, p):
//
//   p_m = p_0 + h/2 p'(t_0, q_0, p_m)
//   q_1 = q_0 + h/2 (M(q_0)^-1 p_m + M(q_1)^-1 p_m)
//   p_1 = p_m + h/2 p'(t_1, q_1, p_m)
//
// E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), VI.3, (3.4). Half a step of
// symplectic Euler and half a step of its adjoint: symplectic, symmetric, order 2. Where M is constant and no
// force depends on v all three are explicit, and the force at the end is that at the next beginning.

#include "integrate/implicit_equation.hpp"
#include "integrate/in_momenta.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

class Verlet final : public MomentaIntegrator {
 public:
  explicit Verlet(const Forms& forms)
      : MomentaIntegrator(forms),
        separable_(system_.is_separable()),
        q_stage_(n_),
        p_stage_(n_),
        v_stage_(n_),
        v_begin_(n_),
        increment_(n_),
        force_(n_),
        kick_(n_),
        drift_(n_),
        kick_equation_(n_),
        drift_equation_(n_) {}

 private:
  bool is_crude() const override { return true; }
  void forget() override {
    has_force_ = false;
    kick_.forget();
    drift_.forget();
    kick_equation_.forget();
    drift_equation_.forget();
  }

  bool move(double t, double h) override {
    if (!kick_implicitly(t, h)) return false;
    add(increment_, p_, p_carry_);
    system_.velocity(q_, p_, v_begin_);
    if (!drift(h)) return false;
    add(increment_, q_, q_carry_);
    system_.velocity(q_, p_, v_stage_);
    kick_from(t + h, h, v_stage_, increment_);
    add(increment_, p_, p_carry_);
    return true;
  }

  // dp <- h/2 p' at q_
  void kick_from(double t, double h, std::span<const double> v, std::span<double> dp) {
    system_.force(t, q_, v, force_);
    has_force_ = separable_;
    for (std::size_t i = 0; i < n_; ++i) dp[i] = 0.5 * h * force_[i];
  }

  bool kick_implicitly(double t, double h) {
    if (has_force_) {
      for (std::size_t i = 0; i < n_; ++i) increment_[i] = 0.5 * h * force_[i];
      return true;
    }
    if (!kick_.predict(h, increment_)) kick_from(t, h, v_, increment_);
    if (separable_) return true;
    const auto from_increment = [&](std::span<const double> dp, std::span<double> next) {
      stage(p_, p_carry_, dp, p_stage_);
      system_.velocity(q_, p_stage_, v_stage_);
      kick_from(t, h, v_stage_, next);
    };
    if (!kick_equation_.solve(from_increment, p_weight_, increment_)) return false;
    kick_.learn(h, increment_);
    return true;
  }

  // increment_ <- q_1 - q_0
  bool drift(double h) {
    if (separable_ || !drift_.predict(h, increment_))
      for (std::size_t i = 0; i < n_; ++i) increment_[i] = h * v_begin_[i];
    if (separable_) return true;
    const auto from_increment = [&](std::span<const double> dq, std::span<double> next) {
      stage(q_, q_carry_, dq, q_stage_);
      system_.velocity(q_stage_, p_, v_stage_);
      for (std::size_t i = 0; i < n_; ++i) next[i] = 0.5 * h * (v_begin_[i] + v_stage_[i]);
    };
    if (!drift_equation_.solve(from_increment, q_weight_, increment_)) return false;
    drift_.learn(h, increment_);
    return true;
  }

  const bool separable_;
  bool has_force_ = false;  // force_ is that at q_
  std::vector<double> q_stage_, p_stage_, v_stage_, v_begin_, increment_, force_;
  Extrapolation kick_, drift_;
  ImplicitEquation kick_equation_, drift_equation_;
};

}  // namespace

std::unique_ptr<Integrator> make_verlet(const Forms& forms, const MethodOptions&) {
  return std::make_unique<Verlet>(forms);
}

}  // namespace chainreel

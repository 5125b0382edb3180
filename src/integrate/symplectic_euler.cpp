// The symplectic Euler method in coordinates and momenta, for any T(q, p):
//
//   p_1 = p_0 + h p'(t_0, q_0, p_1),   q_1 = q_0 + h M(q_0)^-1 p_1.
//
// E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), VI.3, (3.1). The first equation is
// implicit where M depends on q or a force on v; that is what semi-implicit Euler in (q, qd) leaves out, and
// with it the conserved modified energy.

#include "integrate/implicit_equation.hpp"
#include "integrate/in_momenta.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

class SymplecticEuler final : public MomentaIntegrator {
 public:
  explicit SymplecticEuler(const Forms& forms)
      : MomentaIntegrator(forms),
        separable_(system_.is_separable()),
        p_stage_(n_),
        v_stage_(n_),
        increment_(n_),
        kick_(n_),
        equation_(n_) {}

 private:
  bool is_crude() const override { return true; }
  void forget() override {
    kick_.forget();
    equation_.forget();
  }

  bool move(double t, double h) override {
    if (!kick(t, h)) return false;
    add(increment_, p_, p_carry_);
    system_.velocity(q_, p_, v_stage_);
    for (std::size_t i = 0; i < n_; ++i) increment_[i] = h * v_stage_[i];
    add(increment_, q_, q_carry_);
    return true;
  }

  // increment_ <- p_1 - p_0
  bool kick(double t, double h) {
    const auto from_velocity = [&](std::span<const double> v, std::span<double> dp) {
      system_.force(t, q_, v, dp);
      for (double& one : dp) one *= h;
    };
    if (separable_) {
      from_velocity(v_, increment_);
      return true;
    }
    if (!kick_.predict(h, increment_)) from_velocity(v_, increment_);
    const auto from_increment = [&](std::span<const double> dp, std::span<double> next) {
      stage(p_, p_carry_, dp, p_stage_);
      system_.velocity(q_, p_stage_, v_stage_);
      from_velocity(v_stage_, next);
    };
    if (!equation_.solve(from_increment, p_weight_, increment_)) return false;
    kick_.learn(h, increment_);
    return true;
  }

  const bool separable_;
  std::vector<double> p_stage_, v_stage_, increment_;
  Extrapolation kick_;
  ImplicitEquation equation_;
};

}  // namespace

std::unique_ptr<Integrator> make_symplectic_euler(const Forms& forms, const MethodOptions&) {
  return std::make_unique<SymplecticEuler>(forms);
}

}  // namespace chainreel

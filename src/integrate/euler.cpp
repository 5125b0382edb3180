// Explicit Euler: q += h q'(q, v), v += h f(t, q, v), both from the state at the beginning of the step.
// Its region of absolute stability meets the imaginary axis in 0 alone: an undamped oscillation grows at any
// step.
#include <vector>

#include "integrate/makers.hpp"

namespace chainreel {
namespace {

class ExplicitEuler final : public Stepper {
 public:
  ExplicitEuler(int nv) : vd_(std::size_t(nv)) {}

  void step(SecondOrder& system, double t, double h, std::span<double> q, std::span<double> v) override {
    system.acceleration(t, q, v, vd_);
    step_shorter(system, h, q, v);
  }
  bool step_shorter(SecondOrder& system, double h, std::span<double> q, std::span<double> v) override {
    system.advance(q, v, h);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += h * vd_[i];
    return true;
  }

 private:
  std::vector<double> vd_;
};

}  // namespace

std::unique_ptr<Stepper> make_explicit_euler(int, int nv) {
  return std::make_unique<ExplicitEuler>(nv);
}

// Semi-implicit Euler, the lecture's method: v += h f(t, q, v), then q += h q'(q, v) with the new v.
// Symplectic where the mass matrix is constant. In (q, qd) of a chain whose M depends on q it is not: the map
// that would be is the same one in (q, p), p = M qd. Between steps q moves evenly, by that v: so the motion goes no farther than
// its steps do, however long they are.

namespace {

class SemiImplicitEuler final : public Stepper {
 public:
  SemiImplicitEuler(int nv) : vd_(std::size_t(nv)), last_v_(vd_) {}

  void step(SecondOrder& system, double t, double h, std::span<double> q, std::span<double> v) override {
    system.acceleration(t, q, v, vd_);
    for (std::size_t i = 0; i < v.size(); ++i) last_v_[i] = v[i] += h * vd_[i];
    system.advance(q, v, h);
  }
  bool step_shorter(SecondOrder& system, double h, std::span<double> q, std::span<double> v) override {
    system.advance(q, last_v_, h);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += h * vd_[i];
    return true;
  }

 private:
  std::vector<double> vd_, last_v_;  // of the last step
};

}  // namespace

std::unique_ptr<Stepper> make_semi_implicit_euler(int, int nv) {
  return std::make_unique<SemiImplicitEuler>(nv);
}

}  // namespace chainreel

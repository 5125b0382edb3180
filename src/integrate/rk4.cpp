// The classical Runge-Kutta method of order 4 on y = (q, v), y' = (N(q) v, f(t, q, v)):
// k_s = y'(t + c_s h, y + a_s h k_{s-1}), y += h sum b_s k_s.

#include <algorithm>
#include <array>
#include <vector>

#include "integrate/makers.hpp"

namespace chainreel {
namespace {

constexpr std::array<double, 4> a{0, 0.5, 0.5, 1};  // also c: the tableau's only entries below its diagonal
constexpr std::array<double, 4> b{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

class Rk4 final : public Stepper {
 public:
  Rk4(int nq, int nv)
      : q_stage_(std::size_t(nq)),
        q_dot_(std::size_t(nq)),
        q_sum_(std::size_t(nq)),
        v_stage_(std::size_t(nv)),
        v_dot_(std::size_t(nv)),
        v_sum_(std::size_t(nv)) {}

  void step(SecondOrder& system, double t, double h, std::span<double> q, std::span<double> v) override {
    std::fill(q_sum_.begin(), q_sum_.end(), 0.0);
    std::fill(v_sum_.begin(), v_sum_.end(), 0.0);
    for (std::size_t s = 0; s < b.size(); ++s) {
      add(q, a[s] * h, q_dot_, q_stage_);
      add(v, a[s] * h, v_dot_, v_stage_);
      system.q_rate(q_stage_, v_stage_, q_dot_);
      system.acceleration(t + a[s] * h, q_stage_, v_stage_, v_dot_);
      add(q_sum_, b[s], q_dot_, q_sum_);
      add(v_sum_, b[s], v_dot_, v_sum_);
    }
    add(q, h, q_sum_, q);
    add(v, h, v_sum_, v);
    system.normalize(q);
  }

 private:
  // out = x + factor * rate; a factor of 0 leaves x, whatever an unused rate holds.
  static void add(std::span<const double> x, double factor, std::span<const double> rate,
                  std::span<double> out) {
    for (std::size_t i = 0; i < x.size(); ++i) out[i] = factor == 0 ? x[i] : x[i] + factor * rate[i];
  }

  std::vector<double> q_stage_, q_dot_, q_sum_, v_stage_, v_dot_, v_sum_;
};

}  // namespace

std::unique_ptr<Stepper> make_rk4(int nq, int nv) {
  return std::make_unique<Rk4>(nq, nv);
}

}  // namespace chainreel

// RATTLE for points linked to a chain, and its symmetric compositions of order 4, 6 and 8.
// E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), VII.1.4, (1.26) and (1.27), after
// H. Andersen (1983). With the link vectors d_i = x_i - x_{i-1}, forces f, and impulses nu, mu along the
// links' vectors at the step's beginning (G_0^T) and end (G_1^T):
//
//   u_m = u_0 + M^-1 (h/2 f(t_0, x_0, u_m) - G_0^T nu),   x_1 = x_0 + h u_m,   |d_i at x_1| = |d_i at x_0|
//   u_1 = u_m + M^-1 (h/2 f(t_1, x_1, u_m) - G_1^T mu),   d_i . d_i' = 0 at (x_1, u_1)
//
// Symplectic, symmetric, order 2, whatever f depends on; implicit in u_m only where f depends on velocities.
// nu by Newton's method: as the lengths are quadratic, what one iteration leaves of them is the square of
// what it moved.
//
// Compositions: steps of gamma_s h one after another (ibid. V.3.2). Between two of them mu is left out, since
// the next nu does its work. gamma: M. Suzuki (1990), order 4; W. Kahan, R.-C. Li (1997), methods s9odr6a and
// s17odr8a, orders 6 and 8.
//
// Round-off: lengths are kept by the links' increments, not by their squares, and positions and velocities
// are sums with a carry. Computed from the positions, the impulses would have an error of 2^-53 / h^2.

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "integrate/hermite_span.hpp"
#include "integrate/linked_masses.hpp"
#include "integrate/makers.hpp"

namespace chainreel {
namespace {

// The steps before the middle one; the middle one is what is left of 1, and the rest mirrors the first.
using HalfComposition = std::vector<double>;
const HalfComposition kOrder2{};
const HalfComposition kOrder4{0.41449077179437573714, 0.41449077179437573714};
const HalfComposition kOrder6{0.39216144400731413928, 0.33259913678935943860, -0.70624617255763935981,
                              0.08221359629355080023};
const HalfComposition kOrder8{0.13020248308889008088, 0.56116298177510838456,  -0.38947496264484728641,
                              0.15884190655515560090, -0.39590389413323757734, 0.18453964097831570709,
                              0.25837438768632204729, 0.29501172360931029887};

std::vector<double> composition(const HalfComposition& half) {
  std::vector<double> gamma(half);
  double middle = 1;
  for (const double one : half) middle -= 2 * one;
  gamma.push_back(middle);
  gamma.insert(gamma.end(), half.rbegin(), half.rend());
  return gamma;
}

constexpr int kMostIterations = 30;
// What an iteration may leave of the square of a link's length: a millionth of round-off.
constexpr double kLeft = 1e-22;
constexpr double kRoundOff = 0x1p-53;

// For k links with single masses, unrolled; k = 0: for any chain.
template <std::size_t k>
class Rattle final : public Integrator {
 public:
  Rattle(const Forms& forms, const HalfComposition& half)
      : Integrator(forms.second_order->nq(), forms.second_order->nv()),
        points_(*forms.linked_points),
        second_order_(*forms.second_order),
        masses_(points_.links()),
        gamma_(composition(half)),
        links_(points_.links().size()),
        needs_velocity_(points_.force_depends_on_velocity()),
        span_(int(links_), int(links_)) {
    if constexpr (k == 0) {
      for (auto* points :
           {&x_, &u_, &x_carry_, &u_carry_, &f_, &d_, &e_, &kick_, &drift_, &move_, &u_middle_})
        points->resize(links_);
      for (auto* numbers : {&change_, &lambda_, &nu_}) numbers->resize(links_);
    }
    for (auto& impulses : past_) impulses.resize(links_ * gamma_.size());
  }

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    std::copy(q.begin(), q.end(), q_.begin());
    std::copy(v.begin(), v.end(), v_.begin());
    points_.place(q_, v_, numbers_of(x_), numbers_of(u_));
    std::fill(x_carry_.begin(), x_carry_.end(), Vec2{});
    std::fill(u_carry_.begin(), u_carry_.end(), Vec2{});
    has_force_ = false;
    known_ = 0;
    span_.start();
  }

  StepResult step(double end, double h) override {
    begin_ = time_;
    span_.begin(begin_, q_, v_);
    if (h != h_) known_ = 0;
    h_ = h;
    double c = 0;
    for (std::size_t s = 0; s < gamma_.size(); ++s) {
      guess_impulses(s);
      if (!substep(begin_ + c * h, gamma_[s] * h)) return StepResult::not_converged;
      std::copy(nu_.begin(), nu_.end(), past_[2].begin() + std::ptrdiff_t(s * size()));
      c += gamma_[s];
    }
    std::rotate(past_.begin(), past_.begin() + 2, past_.end());
    known_ = std::min(known_ + 1, 3);
    project();
    points_.read(numbers_of(x_), numbers_of(u_), q_, v_);
    time_ = end;
    span_.end(end, q_, v_);
    return StepResult::ok;
  }

  void interpolate(double t, std::span<double> q, std::span<double> v) override {
    span_.interpolate(second_order_, t, q, v);
  }
  int dense_order() const override { return span_.order(); }

 private:
  using Points = std::conditional_t<k == 0, std::vector<Vec2>, std::array<Vec2, k>>;
  using Numbers = std::conditional_t<k == 0, std::vector<double>, std::array<double, k>>;
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  static std::span<double> numbers_of(Points& points) { return {&points.data()->x, 2 * points.size()}; }

  std::size_t size() const { return k > 0 ? k : links_; }

  void accelerate(Points& f) const {
    if constexpr (k > 0)
      masses_.accelerate_single(f);
    else
      masses_.accelerate(f);
  }
  void correct_points(const Points& e) {
    if constexpr (k > 0)
      masses_.correct_single(e, d_, change_, lambda_, move_);
    else
      masses_.correct(e, d_, change_, lambda_, move_);
  }

  static void add(const Points& dx, Points& x, Points& carry) {
    const auto add_one = [](double change, double& value, double& lost) {
      const double before = value;
      lost += change;
      value = before + lost;
      lost += before - value;
    };
    for (std::size_t i = 0; i < x.size(); ++i) {
      add_one(dx[i].x, x[i].x, carry[i].x);
      add_one(dx[i].y, x[i].y, carry[i].y);
    }
  }

  // nu_ <- the quadratic through those of this part of the last three steps, continued.
  void guess_impulses(std::size_t s) {
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t j = s * size() + i;
      const double a = past_[0][j], b = past_[1][j], c = past_[2][j];
      nu_[i] = known_ == 0 ? 0 : known_ == 1 ? a : known_ == 2 ? 2 * a - b : 3 * (a - b) + c;
    }
  }

  void find_links(const Points& x, const Points& carry, Points& links) const {
    links[0] = x[0] + carry[0];
    for (std::size_t i = 1; i < size(); ++i) links[i] = (x[i] - x[i - 1]) + (carry[i] - carry[i - 1]);
  }

  bool substep(double t, double h) {
    find_links(x_, x_carry_, d_);
    if (!has_force_) points_.force(t, numbers_of(x_), numbers_of(u_), numbers_of(f_));
    if (!find_drift(h)) return false;
    if (needs_velocity_ && !iterate_on_velocity(t, h)) return false;
    add(drift_, x_, x_carry_);
    add(kick_, u_, u_carry_);
    points_.force(t + h, numbers_of(x_), numbers_of(u_), numbers_of(f_));
    has_force_ = !needs_velocity_;
    for (std::size_t i = 0; i < size(); ++i) kick_[i] = f_[i] * (0.5 * h);
    accelerate(kick_);
    add(kick_, u_, u_carry_);
    return true;
  }

  // f_ at u_m, which f_ itself decides: until the increments of u_m no longer decrease.
  bool iterate_on_velocity(double t, double h) {
    double last = 0;
    for (int m = 0; m < kMostIterations; ++m) {
      double increment = 0, speed = 0;
      for (std::size_t i = 0; i < size(); ++i) {
        const Vec2 u = u_[i] + (u_carry_[i] + kick_[i]);
        increment = std::max({increment, std::fabs(u.x - u_middle_[i].x), std::fabs(u.y - u_middle_[i].y)});
        speed = std::max({speed, std::fabs(u.x), std::fabs(u.y)});
        u_middle_[i] = u;
      }
      if (m > 0 && (increment <= 0.1 * kRoundOff * speed || (m > 1 && increment >= last)))
        return increment <= 1e3 * kRoundOff * (1 + speed);
      last = increment;
      points_.force(t, numbers_of(x_), numbers_of(u_middle_), numbers_of(f_));
      if (!find_drift(h)) return false;
    }
    return false;
  }

  // kick_ <- u_m - u_0, drift_ <- x_1 - x_0 with f_ and links that keep their lengths; nu_: the guess, then
  // the impulses.
  [[gnu::always_inline]] bool find_drift(double h) {
    for (std::size_t i = 0; i < size(); ++i) {
      const Vec2 handed_on = i + 1 < size() ? d_[i + 1] * nu_[i + 1] : Vec2{};
      kick_[i] = f_[i] * (0.5 * h) + (handed_on - d_[i] * nu_[i]);
    }
    accelerate(kick_);
    for (std::size_t i = 0; i < size(); ++i) drift_[i] = (u_[i] + (u_carry_[i] + kick_[i])) * h;
    const double h_inverse = 1 / h;
    for (int m = 0; m < kMostIterations; ++m) {
      for (std::size_t i = 0; i < size(); ++i) {
        const Vec2 turn = i > 0 ? drift_[i] - drift_[i - 1] : drift_[0];
        e_[i] = d_[i] + turn;
        change_[i] = -dot(d_[i] + turn * 0.5, turn);
      }
      correct_points(e_);
      bool done = true;
      for (std::size_t i = 0; i < size(); ++i) {
        const Vec2 part = i > 0 ? move_[i] - move_[i - 1] : move_[0];
        done = done && dot(part, part) <= kLeft * dot(d_[i], d_[i]);
        drift_[i] = drift_[i] + move_[i];
        kick_[i] = kick_[i] + move_[i] * h_inverse;
        nu_[i] += lambda_[i] * h_inverse;
      }
      if (done) return true;
    }
    return false;
  }

  // Velocities along the links are taken away.
  void project() {
    find_links(x_, x_carry_, d_);
    for (std::size_t i = 0; i < size(); ++i) change_[i] = -dot(d_[i], i > 0 ? u_[i] - u_[i - 1] : u_[0]);
    correct_points(d_);
    add(move_, u_, u_carry_);
  }

  LinkedPoints& points_;
  SecondOrder& second_order_;
  LinkedMasses masses_;
  const std::vector<double> gamma_;
  const std::size_t links_;
  const bool needs_velocity_;
  HermiteSpan span_;
  Points x_{}, u_{}, x_carry_{}, u_carry_{};
  Points f_{};
  bool has_force_ = false;  // f_ is that at x_
  Points d_{}, e_{};        // the links at a step's beginning, and as the iteration has turned them
  Points kick_{}, drift_{}, move_{}, u_middle_{};
  Numbers change_{}, lambda_{}, nu_{};
  std::array<std::vector<double>, 3> past_;  // nu of each part of the last steps, the latest first
  int known_ = 0;                            // how many of them, all of length h_
  double h_ = 0;
};

std::unique_ptr<Integrator> make_rattle(const Forms& forms, const HalfComposition& half) {
  const std::span<const LinkedPoints::Link> links = forms.linked_points->links();
  if (LinkedMasses(links).are_single()) {
    if (links.size() == 1) return std::make_unique<Rattle<1>>(forms, half);
    if (links.size() == 2) return std::make_unique<Rattle<2>>(forms, half);
    if (links.size() == 3) return std::make_unique<Rattle<3>>(forms, half);
  }
  return std::make_unique<Rattle<0>>(forms, half);
}

}  // namespace

std::unique_ptr<Integrator> make_rattle2(const Forms& forms, const MethodOptions&) {
  return make_rattle(forms, kOrder2);
}
std::unique_ptr<Integrator> make_rattle4(const Forms& forms, const MethodOptions&) {
  return make_rattle(forms, kOrder4);
}
std::unique_ptr<Integrator> make_rattle6(const Forms& forms, const MethodOptions&) {
  return make_rattle(forms, kOrder6);
}
std::unique_ptr<Integrator> make_rattle8(const Forms& forms, const MethodOptions&) {
  return make_rattle(forms, kOrder8);
}

}  // namespace chainreel

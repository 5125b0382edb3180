#include "integrate/stability_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense.hpp"

namespace chainreel {
namespace {

using Rate = std::complex<double>;

// Beside a fastest rate of 1: entries of the matrix are known to 1e-9, a double zero to the root of that.
constexpr double kNoRate = 3e-5, kNoRealPart = 1e-9;
// |R| - 1 that counts as growth where h |lambda| = y: equations of implicit steps leave 3e-12, rounding
// 1e-15; explicit Euler's growth is y^2 / 2 and must be seen down to the finest step.
double growth_of_a_mode(double y) {
  return 1e-9 * std::min(1.0, y * y) + 1e-14;
}
// By the whole step's eigenvalues: a double one is known to the root of rounding.
double growth_of_a_step(double y) {
  return 1e-7 * std::sqrt(std::min(1.0, y));
}
constexpr double kCommutes =
    1e-11;  // a step at h |lambda| = 3; the series, which is cut in q and v apart, is not

// Where a limit is looked for: evenly where explicit methods have theirs (the widest reaches some 12), by
// factors below and beyond.
constexpr double kFinestOfModes = 1e-6, kFinestOfSteps = 1e-4;
constexpr double kEven = 0.02, kWidest = 20, kSmallFactor = 1.2, kLargeFactor = 10, kFactor = 1.02;
constexpr double kFarthest = 1e6;

std::vector<double> steps_for_modes() {
  std::vector<double> steps;
  for (double y = kFinestOfModes; y < kEven; y *= kSmallFactor) steps.push_back(y);
  for (double y = kEven; y <= kWidest; y += kEven) steps.push_back(y);
  for (double y = kLargeFactor * kWidest; y <= kFarthest; y *= kLargeFactor) steps.push_back(y);
  return steps;
}

std::vector<double> steps_until(double last) {
  std::vector<double> steps;
  for (double y = kFinestOfSteps; y <= last; y *= kFactor) steps.push_back(y);
  return steps;
}

template <class IsStable>
double first_limit(const std::vector<double>& steps, const IsStable& holds) {
  const auto broken = std::find_if_not(steps.begin(), steps.end(), holds);
  if (broken == steps.begin()) return 0;
  if (broken == steps.end()) return std::numeric_limits<double>::infinity();
  double stable = *(broken - 1), unstable = *broken;
  while (unstable - stable > 1e-10 * stable) {
    const double middle = 0.5 * (stable + unstable);
    (holds(middle) ? stable : unstable) = middle;
  }
  return stable;
}

// Unit natural frequency, damping ratio -cos of the rate's angle: its two rates are `direction` and its
// mirror.
LinearMotion oscillator_of(const Rate& direction) {
  return {Eigen::MatrixXd::Constant(1, 1, -1), Eigen::MatrixXd::Constant(1, 1, 2 * direction.real())};
}

// R(y direction) and its mirror image are the eigenvalues: their product is |R|^2.
bool mode_holds(const Method& method, const Rate& direction, double y) {
  const auto map = step_map(method, oscillator_of(direction), y);
  if (!map) return false;
  const double det = (*map)(0, 0) * (*map)(1, 1) - (*map)(0, 1) * (*map)(1, 0);
  return std::sqrt(std::abs(det)) <= 1 + growth_of_a_mode(y);
}

bool acts_on_modes(const Method& method) {
  const LinearMotion motion = oscillator_of({-0.3, std::sqrt(1 - 0.09)});
  const auto map = step_map(method, motion, 3);
  if (!map) return false;
  const Eigen::MatrixXd A = motion.matrix();
  return (*map * A - A * *map).norm() <= kCommutes * map->norm() * A.norm();
}

// The motion in units of time in which its fastest rate is 1.
struct Scaled {
  explicit Scaled(const LinearMotion& given) : motion(given) {
    for (const Rate& rate : rates_of(given)) {
      fastest = std::max(fastest, std::abs(rate));
      (rate.real() > 0 ? growing : bounded).push_back(rate);
    }
    if (bounded.empty()) return;
    motion = given.in_units_of(1 / fastest);
    for (std::vector<Rate>* rates : {&bounded, &growing})
      for (Rate& rate : *rates) rate /= fastest;
  }

  // What grows in the motion itself may grow in the step: of the step's eigenvalues those nearest to what it grows by. Any
  // other that grows is the method's, however many of the former the step keeps within bounds.
  bool step_holds(const Method& method, double y) const {
    const auto map = step_map(method, motion, y);
    if (!map) return false;
    const Eigen::VectorXcd eigenvalues = eigenvalues_of(*map);
    std::vector<Rate> others(eigenvalues.begin(), eigenvalues.end());
    for (const Rate& rate : growing)
      for (const double side : {1.0, -1.0}) {
        if (side < 0 && rate.imag() == 0) continue;
        const Rate grown = std::exp(y * Rate{rate.real(), side * rate.imag()});
        const auto is_nearer = [&](const Rate& one, const Rate& other) { return std::abs(one - grown) < std::abs(other - grown); };
        if (!others.empty()) others.erase(std::min_element(others.begin(), others.end(), is_nearer));
      }
    return std::all_of(others.begin(), others.end(), [&](const Rate& one) { return std::abs(one) <= 1 + growth_of_a_step(y); });
  }

  LinearMotion motion;
  double fastest = 0;
  std::vector<Rate> bounded, growing;
};

bool is_known(const Method& method, const Scaled& scaled) {
  return method.form != Form::linked_points && !scaled.bounded.empty();
}

double limit_of_modes(const Method& method, const std::vector<Rate>& rates) {
  static const std::vector<double> steps = steps_for_modes();
  double limit = std::numeric_limits<double>::infinity();
  std::vector<std::pair<Rate, double>> known;  // many rates are real
  for (const Rate& rate : rates) {
    const Rate direction = rate / std::abs(rate);
    auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == direction; });
    if (found == known.end()) {
      const auto holds = [&](double y) { return mode_holds(method, direction, y); };
      found = known.insert(known.end(), {direction, first_limit(steps, holds)});
    }
    limit = std::min(limit, found->second / std::abs(rate));
  }
  return limit;
}

}  // namespace

std::vector<Rate> rates_of(const LinearMotion& motion) {
  std::vector<Rate> rates;
  if (motion.n() == 0) return rates;
  // Rates of one second may be 1e4 times those of another: the unit of time makes q and v alike.
  const double unit = std::max({std::sqrt(motion.K.cwiseAbs().maxCoeff()), motion.D.cwiseAbs().maxCoeff()});
  if (!(unit > 0) || !std::isfinite(unit)) return rates;
  const Eigen::VectorXcd all = eigenvalues_of(motion.in_units_of(1 / unit).matrix());
  const double fastest = all.cwiseAbs().maxCoeff();
  for (Rate one : all) {
    if (one.imag() < 0 || std::abs(one) < kNoRate * fastest) continue;
    if (std::abs(one.real()) < kNoRealPart * fastest) one.real(0);
    rates.push_back(one * unit);
  }
  std::sort(rates.begin(), rates.end(),
            [](const Rate& a, const Rate& b) { return std::abs(a) < std::abs(b); });
  return rates;
}

std::optional<bool> is_stable(const Method& method, const LinearMotion& motion, double h) {
  const Scaled scaled(motion);
  if (!is_known(method, scaled)) return std::nullopt;
  if (!acts_on_modes(method)) return scaled.step_holds(method, h * scaled.fastest);
  return std::all_of(scaled.bounded.begin(), scaled.bounded.end(), [&](const Rate& rate) {
    const double size = std::abs(rate);
    return mode_holds(method, rate / size, h * scaled.fastest * size);
  });
}

std::optional<double> stability_limit(const Method& method, const LinearMotion& motion) {
  const Scaled scaled(motion);
  if (!is_known(method, scaled)) return std::nullopt;
  if (acts_on_modes(method)) return limit_of_modes(method, scaled.bounded) / scaled.fastest;
  const double slowest = std::abs(scaled.bounded.front());
  const auto holds = [&](double y) { return scaled.step_holds(method, y); };
  return first_limit(steps_until(kWidest / slowest), holds) / scaled.fastest;
}

namespace {

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

ConstMap as_vector(std::span<const double> x) {
  return {x.data(), Eigen::Index(x.size())};
}
Map as_vector(std::span<double> x) {
  return {x.data(), Eigen::Index(x.size())};
}

struct LinearSystem final : SecondOrder {
  explicit LinearSystem(const LinearMotion& given) : motion(given) {}
  int nq() const override { return int(motion.n()); }
  int nv() const override { return int(motion.n()); }
  void acceleration(double, std::span<const double> q, std::span<const double> v,
                    std::span<double> vd) override {
    as_vector(vd) = motion.K * as_vector(q) + motion.D * as_vector(v);
  }
  const LinearMotion& motion;
};

// The momenta of unit mass. With any other constant mass the momenta are a linear map of these, and so are the steps.
struct LinearMomenta final : Momenta {
  explicit LinearMomenta(LinearSystem& given) : system(given) {}
  int n() const override { return system.nv(); }
  bool is_separable() const override { return system.motion.D.isZero(0); }
  void momentum(std::span<const double>, std::span<const double> v, std::span<double> p) override {
    as_vector(p) = as_vector(v);
  }
  void velocity(std::span<const double>, std::span<const double> p, std::span<double> v) override {
    as_vector(v) = as_vector(p);
  }
  void force(double t, std::span<const double> q, std::span<const double> v,
             std::span<double> p_dot) override {
    system.acceleration(t, q, v, p_dot);
  }
  LinearSystem& system;
};

// (k + 2)(k + 1) c_{k+2} = K c_k + (k + 1) D c_{k+1}
struct LinearSeries final : Series {
  explicit LinearSeries(const LinearMotion& given) : motion(given) {}
  int n() const override { return int(motion.n()); }
  void expand(double, std::span<const double> q, std::span<const double> v, int order,
              std::span<double> c) override {
    Eigen::Map<Eigen::MatrixXd> terms(c.data(), motion.n(), order + 1);
    terms.col(0) = as_vector(q);
    terms.col(1) = as_vector(v);
    for (int k = 0; k + 2 <= order; ++k)
      terms.col(k + 2) =
          (motion.K * terms.col(k) + (k + 1) * (motion.D * terms.col(k + 1))) / ((k + 2.0) * (k + 1.0));
  }
  const LinearMotion& motion;
};

}  // namespace

Eigen::MatrixXd LinearMotion::matrix() const {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n(), 2 * n());
  A.topRightCorner(n(), n()).setIdentity();
  A.bottomLeftCorner(n(), n()) = K;
  A.bottomRightCorner(n(), n()) = D;
  return A;
}

std::optional<Eigen::MatrixXd> step_map(const Method& method, const LinearMotion& motion, double h) {
  if (method.form == Form::linked_points) return std::nullopt;
  LinearSystem system(motion);
  LinearMomenta momenta(system);
  LinearSeries series(motion);
  const auto integrator = make_integrator(method, {&system, &momenta, &series, nullptr});
  const Eigen::Index n = motion.n();
  Eigen::MatrixXd map(2 * n, 2 * n);
  for (Eigen::Index column = 0; column < 2 * n; ++column) {
    const Eigen::VectorXd x = Eigen::VectorXd::Unit(2 * n, column);
    integrator->start(0, {x.data(), std::size_t(n)}, {x.data() + n, std::size_t(n)});
    if (integrator->step(h, h) != StepResult::ok) return std::nullopt;
    map.col(column) << as_vector(integrator->q()), as_vector(integrator->v());
  }
  if (!map.allFinite()) return std::nullopt;
  return map;
}

}  // namespace chainreel

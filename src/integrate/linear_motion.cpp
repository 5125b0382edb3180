#include "integrate/linear_motion.hpp"

namespace chainreel {
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

// Of unit mass. With any other constant mass the momenta are a linear map of these, and so are the steps.
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

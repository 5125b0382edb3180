// Mechanisms with constraints, and states that fulfil them, for the tests of constrained dynamics.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "dynamics/compare.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "support/chains.hpp"

namespace chainreel::test {

inline const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();

// A chain with its constraints and what is written for them.
struct Tied {
  Tied(Chain chain_, std::vector<Constraint> constraints)
      : chain(std::move(chain_)), set(chain, std::move(constraints)), ws(chain), cws(chain, set) {}

  ConstraintStatus move(const State& s, const ConstrainedOptions& options = {}) {
    return compute_constrained_dynamics(chain, ws, set, cws, s.q, s.qd, s.tau, options);
  }
  Eigen::MatrixXd Jc() const {
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        cws.Jc.data(), set.rows(), chain.nv);
  }
  Eigen::VectorXd Jcd_qd() const { return as_vector(cws.Jcd_qd); }
  Eigen::VectorXd phi() const { return as_vector(cws.phi); }
  Eigen::VectorXd lambda() const { return as_vector(cws.lambda); }
  Eigen::VectorXd qdd() const { return as_vector(ws.qdd); }

  Chain chain;
  ConstraintSet set;
  Workspace ws;
  ConstrainedWorkspace cws;
};

inline LineConstraint pen_line(double height = 0.5) {
  return {.frame = "gripper", .point = {0, height, 0}, .direction = {1, 0, 0}};
}

// Three rods whose tip is a joint of the ground: a four-bar linkage.
inline PointConstraint pin(double x = 1.2, double y = 0.3) {
  return {.frame = "gripper", .at = {x, y, 0}};
}

// Along x, up and down by `height` eleven times on two metres.
class Wave : public PlaneCurve {
 public:
  explicit Wave(double height) : height_(height) {}
  Place at(double s) const override {
    constexpr double w = 11 * 3.141592653589793;
    return {{s, height_ * std::sin(w * s)}, {1, height_ * w * std::cos(w * s)}, {0, -height_ * w * w * std::sin(w * s)}};
  }

 private:
  double height_;
};

// An ellipse about `centre`.
class Ellipse : public PlaneCurve {
 public:
  Ellipse(double a, double b, Eigen::Vector2d centre) : a_(a), b_(b), centre_(std::move(centre)) {}
  Place at(double s) const override {
    const double c = std::cos(s), n = std::sin(s);
    return {centre_ + Eigen::Vector2d(a_ * c, b_ * n), {-a_ * n, b_ * c}, {-a_ * c, -b_ * n}};
  }

 private:
  double a_, b_;
  Eigen::Vector2d centre_;
};

}  // namespace chainreel::test

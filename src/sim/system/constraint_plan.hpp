// What a run is told about constraints: the list, how drift is held off, and the forces to press with.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "expr/expression.hpp"
#include "model/chain.hpp"
#include "model/constraint.hpp"
#include "sim/drive/probe.hpp"

namespace chainreel {

// The equations of motion hold d^2 phi / dt^2 = 0 alone; errors of each step add up to phi ~ t^2 unless
// something holds them.
enum class Stabilization {
  project,    // after each step, positions and velocities back onto the constraints
  baumgarte,  // d^2 phi/dt^2 = -2 g dphi/dt - g^2 phi: J. Baumgarte, Comput. Meth. Appl. Mech. Eng. 1 (1972)
  none,
};
std::span<const Name> names_of(Stabilization);

// The robot is to press with `force` (N, W) on constraint `constraint` (from 0), whatever it does besides.
struct ContactForce {
  std::size_t constraint = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

struct ConstraintPlan {
  std::vector<Constraint> list;
  Stabilization stabilize = Stabilization::project;
  double gain = 10;  // 1/s, of Stabilization::baumgarte: errors die away in a few tenths of a second
  std::vector<ContactForce> contact_forces;

  bool empty() const { return list.empty(); }
};

// Of each row: a length that is held bears a force, a direction a torque; of coordinates what moves them decides, and both are ""
// where that is not the same for all.
struct RowUnits {
  std::string error;       // m, rad
  std::string multiplier;  // N, N m
};
std::vector<RowUnits> row_units(const Chain& chain, const std::vector<Constraint>& constraints);

// A curve in the plane of motion from two expressions in its parameter s.

class ExpressionCurve final : public PlaneCurve {
 public:
  // Expressions may read s, pi and the parameters. Throws Error (bad input) at `place` where they cannot be
  // read, or where the curve has no place, tangent or curvature at `s`.
  ExpressionCurve(const std::string& x, const std::string& y, const Parameters& parameters, double s,
                  const chainreel::Place& place);

  PlaneCurve::Place at(double s) const override;
  // Of the expressions, the first whose text jumps or bends somewhere, as abs(s) does; "": none.
  const std::string& cornered() const { return cornered_; }

 private:
  std::string cornered_;
  std::vector<Expression> entries_;  // x, y
  // s first. Twice derived: the outer dual number's part of the inner one's.
  mutable std::vector<Dual<Dual<double>>> values_;
};

}  // namespace chainreel

// A curve in the plane of motion from two expressions in its parameter s.
#pragma once

#include "expr/expression.hpp"
#include "model/constraint.hpp"
#include "sim/probe.hpp"

namespace chainreel {

class ExpressionCurve final : public PlaneCurve {
 public:
  // Expressions may read s, pi and the parameters. Throws Error (bad input) at `place` where they cannot be
  // read, or where the curve has no place, tangent or curvature at `s`.
  ExpressionCurve(const std::string& x, const std::string& y, const Parameters& parameters, double s,
                  const chainreel::Place& place);

  PlaneCurve::Place at(double s) const override;

 private:
  std::vector<Expression> entries_;  // x, y
  // s first. Twice derived: the outer dual number's part of the inner one's.
  mutable std::vector<Dual<Dual<double>>> values_;
};

}  // namespace chainreel

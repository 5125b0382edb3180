#include "sim/system/constraint_plan.hpp"

#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "dynamics/constraints/constraint_set.hpp"
#include "expr/corners.hpp"

namespace chainreel {

std::span<const Name> names_of(Stabilization) {
  static constexpr Name names[] = {{"project", "after each step, back onto the constraints"},
                                   {"baumgarte", "errors are driven to die away, with `baumgarte: {gain: ..}`"},
                                   {"none", "errors of the steps add up"}};
  return names;
}

ExpressionCurve::ExpressionCurve(const std::string& x, const std::string& y, const Parameters& parameters,
                                 double s, const chainreel::Place& place) {
  std::vector<std::string> names{"s"};
  values_.emplace_back();
  for (const auto& [name, value] : parameters) {
    if (name == "s")
      throw Error(ExitCode::bad_input, "a curve's own parameter is s: rename the other", place);
    names.push_back(name);
    values_.emplace_back(value);
  }
  std::vector<VariableUse> uses{{}};
  for (const auto& [name, value] : parameters) uses.push_back({VariableRole::constant, value});
  ProblemList problems;
  for (const auto& [axis, text] : {std::pair("x", x), std::pair("y", y)}) {
    try {
      entries_.push_back(Expression::parse(text, names, place));
      Corners corners(uses);
      corners.add(entries_.back());
      if (corners.count() > 0 && cornered_.empty()) cornered_ = text;
    } catch (const Error& error) {
      problems.add("curve, " + std::string(axis) + ": " + error.problems().front().message, place);
    }
  }
  problems.throw_if_any();
  const PlaneCurve::Place here = at(s);
  if (!here.c.allFinite() || !here.c1.allFinite() || !here.c2.allFinite() || !(here.c1.norm() > 0))
    throw Error(ExitCode::bad_input,
                "the curve has no place, tangent or curvature at s = " + std::to_string(s) +
                    ": it must be smooth, and move with s; `s:` says where to begin",
                place);
}

PlaneCurve::Place ExpressionCurve::at(double s) const {
  values_[0] = {Dual<double>(s, 1), Dual<double>(1, 0)};
  PlaneCurve::Place place;
  for (int k = 0; k < 2; ++k) {
    const auto c = entries_[std::size_t(k)].evaluate(std::span<const Dual<Dual<double>>>(values_));
    place.c[k] = c.re.re;
    place.c1[k] = c.re.du;
    place.c2[k] = c.du.du;
  }
  return place;
}

std::vector<RowUnits> row_units(const Chain& chain, const std::vector<Constraint>& constraints) {
  static const RowUnits kLength{"m", "N"}, kAngle{"rad", "N m"};
  const ConstraintSet set(chain, constraints);
  std::vector<JointKind> kinds(std::size_t(chain.nv), JointKind::floating);
  for (std::size_t b = 1; b < chain.bodies.size(); ++b)
    if (const Joint& joint = chain.bodies[b].joint; joint.kind != JointKind::floating) kinds[std::size_t(joint.v_index)] = joint.kind;
  std::vector<RowUnits> units;
  for (const ConstraintSet::Row& row : set.row_list()) {
    std::optional<JointKind> common;
    bool is_mixed = false;
    for (int k = row.first_term; k < row.first_term + row.terms; ++k) {
      const JointKind kind = kinds[std::size_t(set.terms()[std::size_t(k)].v)];
      is_mixed = is_mixed || (common && *common != kind);
      common = kind;
    }
    if (row.kind == ConstraintSet::Kind::parallel)
      units.push_back(kAngle);
    else if (row.kind != ConstraintSet::Kind::coordinates)
      units.push_back(kLength);
    else
      units.push_back(is_mixed || !common || *common == JointKind::floating ? RowUnits{} : *common == JointKind::prismatic ? kLength : kAngle);
  }
  return units;
}

}  // namespace chainreel

#include "model/constraint.hpp"

#include <algorithm>

namespace chainreel {

namespace {

struct NameOf {
  std::string operator()(const LineConstraint& c) const { return "line " + c.frame; }
  std::string operator()(const PlaneConstraint& c) const { return "plane " + c.frame; }
  std::string operator()(const PointConstraint& c) const { return c.word + (" " + c.frame); }
  std::string operator()(const DistanceConstraint& c) const { return "distance " + c.a + (c.at ? "" : " " + c.b); }
  std::string operator()(const CloseConstraint& c) const { return "close " + c.a + " " + c.b; }
  std::string operator()(const CurveConstraint& c) const { return "curve " + c.frame; }
  std::string operator()(const JointConstraint& c) const { return "joint " + c.coordinate; }
  std::string operator()(const LinearConstraint& c) const {
    std::string name = "linear";
    for (const LinearConstraint::Term& term : c.terms) name += " " + term.coordinate;
    return name;
  }
};

}  // namespace

const char* unit_of_misses(const std::vector<Constraint>& constraints) {
  const auto keeps_angles = [](const Constraint& one) {
    if (const auto* close = std::get_if<CloseConstraint>(&one)) return close->kind != Closure::point;
    return std::holds_alternative<JointConstraint>(one) || std::holds_alternative<LinearConstraint>(one);
  };
  return std::any_of(constraints.begin(), constraints.end(), keeps_angles) ? "m or rad" : "m";
}

std::string name_of(const Constraint& constraint) {
  return std::visit(NameOf{}, constraint);
}

}  // namespace chainreel

#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

namespace {

void read_coefficients(Fields& fields, const Place& place, LinearEntry& form) {
  const YAML::Node node = fields.find("coefficients");
  if (!node.IsDefined() || !node.IsMap() || node.size() == 0) {
    fields.problems().add(
        "'" + fields.path("coefficients") +
            "' must hold joints and numbers: {coefficients: {joint1: 1, joint2: -2}, value: 0}",
        place);
    return;
  }
  Fields inner(fields.document(), node, fields.path("coefficients"), fields.problems());
  for (const auto& pair : node) {
    double coefficient = 0;
    inner.read(pair.first.Scalar(), coefficient);
    form.coefficients.emplace_back(pair.first.Scalar(), coefficient);
  }
}

void write_coefficients(YAML::Emitter& out, const LinearEntry& form) {
  out << YAML::Key << "coefficients" << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [name, coefficient] : form.coefficients)
    out << YAML::Key << name << YAML::Value << format_shortest(coefficient);
  out << YAML::EndMap;
}

std::vector<KeyText> tell_coefficients() {
  return {told_mapping("coefficients", told("", KeyForm::number, ""), "joints and their factors").required()};
}

}  // namespace

const ConstraintKind& LinearEntry::kind() {
  static const ConstraintKindOf<LinearEntry> kind(
      {"linear", "a sum of coordinates keeps a value: gears, belts"},
      "{linear: {coefficients: {joint1: 1, joint2: -2}, value: 0}}",
      {{"", ConstraintKey<LinearEntry>::ByHand{read_coefficients, write_coefficients, tell_coefficients}},
       {"value", &LinearEntry::value, "of the sum; 0 where it is left out", "",
        ConstraintKey<LinearEntry>::Need::optional}},
      [](const LinearEntry& form, ConstraintResolver&) -> Constraint {
        LinearConstraint linear;
        for (const auto& [name, coefficient] : form.coefficients) linear.terms.push_back({name, coefficient});
        linear.value = form.value;
        return linear;
      });
  return kind;
}

}  // namespace chainreel

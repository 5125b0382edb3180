#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

namespace {

void read_closure(Fields& fields, const Place&, CloseEntry& form) {
  bool weld = false;
  fields.read("weld", weld);
  const YAML::Node axis = fields.find("axis");
  bool about_axis = false;
  if (axis.IsDefined() && axis.IsSequence()) {
    fields.read("axis", form.axis);
    about_axis = true;
  } else if (axis.IsDefined()) {
    fields.read("axis", about_axis);
  }
  if (weld && about_axis)
    fields.problem_at("weld", "'weld' leaves no axis to turn about: keep 'weld' or 'axis', not both");
  if ((weld || about_axis) && form.b.empty() && !form.at.empty())
    fields.problem_at(weld ? "weld" : "axis",
                      "a place of the world has no axes: close on a frame of the base, with 'b'");
  form.closure = weld ? Closure::weld : about_axis ? Closure::axis : Closure::point;
}

void write_closure(YAML::Emitter& out, const CloseEntry& form) {
  if (form.closure == Closure::weld) out << YAML::Key << "weld" << YAML::Value << true;
  if (form.closure != Closure::axis) return;
  out << YAML::Key << "axis" << YAML::Value;
  if (form.axis.empty())
    out << true;
  else
    emit_numbers(out, form.axis);
}

std::vector<KeyText> tell_closure() {
  return {
      told_either("axis", {told("", KeyForm::truth, ""), told_list("", told("", KeyForm::number, ""), "")},
                  "they turn against each other about one axis alone: true, the frames' z, or its direction"),
      told("weld", KeyForm::truth, "they do not turn against each other")};
}

}  // namespace

const ConstraintKind& CloseEntry::kind() {
  static const ConstraintKindOf<CloseEntry> kind(
      {"close", "two frames' origins coincide: a joint that closes a loop"},
      "{close: {a: rocker_end, b: ground_pin}}",
      {{"a", &CloseEntry::a, "a frame"},
       {"b", &CloseEntry::b, "the other frame", "", ConstraintKey<CloseEntry>::Need::either},
       {"at", &CloseEntry::at, "in its place: a place of the world", "m",
        ConstraintKey<CloseEntry>::Need::either},
       {"", ConstraintKey<CloseEntry>::ByHand{read_closure, write_closure, tell_closure}}},
      [](const CloseEntry& form, ConstraintResolver& resolver) -> Constraint {
        if (resolver.ends_at_place(form.b))
          return PointConstraint{form.a, resolver.place_of(form.b, form.at, "close: 'at'"), "close"};
        CloseConstraint close{form.a, form.b};
        close.kind = form.closure;
        if (form.closure == Closure::axis && !form.axis.empty())
          close.axis = resolver.world(form.axis, "close: 'axis'");
        return close;
      });
  return kind;
}

}  // namespace chainreel

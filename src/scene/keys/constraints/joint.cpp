#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

const ConstraintKind& JointEntry::kind() {
  static const ConstraintKindOf<JointEntry> kind(
      {"joint", "one coordinate keeps a value"}, "{joint: {name: joint2, value: 90deg}}",
      {{"name", &JointEntry::name, "of the joint"}, {"value", &JointEntry::value, "rad or m"}},
      [](const JointEntry& form, ConstraintResolver&) -> Constraint {
        return JointConstraint{form.name, form.value};
      });
  return kind;
}

}  // namespace chainreel

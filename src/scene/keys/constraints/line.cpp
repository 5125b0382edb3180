#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

const ConstraintKind& LineEntry::kind() {
  static const ConstraintKindOf<LineEntry> kind(
      {"line", "a frame's origin stays on a line"},
      "{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}",
      {{"frame", &LineEntry::frame, "whose origin it is"},
       {"point", &LineEntry::point, "somewhere on it", "m"},
       {"direction", &LineEntry::direction, "along the line, of any length"}},
      [](const LineEntry& form, ConstraintResolver& resolver) -> Constraint {
        return LineConstraint{form.frame, resolver.world(form.point, "line: 'point'"),
                              resolver.world(form.direction, "line: 'direction'")};
      });
  return kind;
}

}  // namespace chainreel

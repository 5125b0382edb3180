#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

const ConstraintKind& PlaneEntry::kind() {
  static const ConstraintKindOf<PlaneEntry> kind(
      {"plane", "a frame's origin stays on a plane"},
      "{plane: {frame: gripper, point: [0, 0.5], normal: [0, 1]}}",
      {{"frame", &PlaneEntry::frame, "whose origin it is"},
       {"point", &PlaneEntry::point, "somewhere on it", "m"},
       {"normal", &PlaneEntry::normal, "at right angles to the plane, of any length"}},
      [](const PlaneEntry& form, ConstraintResolver& resolver) -> Constraint {
        return PlaneConstraint{form.frame, resolver.world(form.point, "plane: 'point'"),
                               resolver.world(form.normal, "plane: 'normal'")};
      });
  return kind;
}

}  // namespace chainreel

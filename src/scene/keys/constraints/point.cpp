#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

const ConstraintKind& PointEntry::kind() {
  static const ConstraintKindOf<PointEntry> kind(
      {"point", "a frame's origin stays at a place"}, "{point: {frame: gripper, at: [1, 0.5]}}",
      {{"frame", &PointEntry::frame, "whose origin it is"}, {"at", &PointEntry::at, "the place", "m"}},
      [](const PointEntry& form, ConstraintResolver& resolver) -> Constraint {
        return PointConstraint{form.frame, resolver.world(form.at, "point: 'at'")};
      });
  return kind;
}

}  // namespace chainreel

#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

const ConstraintKind& DistanceEntry::kind() {
  static const ConstraintKindOf<DistanceEntry> kind(
      {"distance", "a rod without mass between two frames, or from a frame to a place of the world"},
      "{distance: {a: gripper, b: base, length: 1.2}}",
      {{"a", &DistanceEntry::a, "a frame"},
       {"b", &DistanceEntry::b, "the other frame", "", ConstraintKey<DistanceEntry>::Need::either},
       {"at", &DistanceEntry::at, "in its place: a place of the world", "m",
        ConstraintKey<DistanceEntry>::Need::either},
       {"length", &DistanceEntry::length, "of the rod", "m"}},
      [](const DistanceEntry& form, ConstraintResolver& resolver) -> Constraint {
        if (!resolver.ends_at_place(form.b)) return DistanceConstraint{form.a, form.b, form.length, {}};
        return DistanceConstraint{form.a, "", form.length,
                                  resolver.place_of(form.b, form.at, "distance: 'at'")};
      });
  return kind;
}

}  // namespace chainreel

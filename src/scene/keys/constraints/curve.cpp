#include <memory>

#include "scene/keys/constraints/kind.hpp"

namespace chainreel {

const ConstraintKind& CurveEntry::kind() {
  static const ConstraintKindOf<CurveEntry> kind(
      {"curve", "a frame's origin stays on a curve in the plane of motion"},
      "{curve: {frame: gripper, x: \"1 + 0.5 * cos(s)\", y: \"0.5 * sin(s)\"}}",
      {{"frame", &CurveEntry::frame, "whose origin it is"},
       {"x", &CurveEntry::x, "an expression in s", "m", ConstraintKey<CurveEntry>::Need::required, true},
       {"y", &CurveEntry::y, "an expression in s", "m", ConstraintKey<CurveEntry>::Need::required, true},
       {"s", &CurveEntry::s, "where along the curve the frame is sought first; 0 where it is left out", "",
        ConstraintKey<CurveEntry>::Need::optional}},
      [](const CurveEntry& form, ConstraintResolver& resolver) -> Constraint {
        return CurveConstraint{form.frame,
                               std::make_shared<ExpressionCurve>(form.x, form.y, resolver.scene().parameters,
                                                                 form.s, resolver.place()),
                               form.s};
      });
  return kind;
}

}  // namespace chainreel

// The numbers behind an ellipse figure.
#pragma once

#include <array>
#include <string>

#include "app/ellipse_poses.hpp"
#include "core/json.hpp"
#include "draw/ellipse.hpp"
#include "sim/tip_mass.hpp"

namespace chainreel {

// Which curve.
struct EllipseForm {
  EllipseReading reading = EllipseReading::mass;
  bool section = false;  // by the xy plane of the end effector, of arms in space
};

// A list, one entry a pose: t along a motion, q, point (m, in W), Lambda_inv, Lambda and what else add_effective_mass
// gives, eigenvalues of Lambda (kg, null where infinite) and semi_axes of the curve in its unit, in the same order,
// from the heaviest direction on.
Json ellipse_json(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form);
// The same as a table; infinite numbers are "inf".
std::string ellipse_csv(const TipMass& tip, const GatheredPoses& poses, const EllipseForm& form);

// M(q) of each pose, and the part of it that belongs to two joints (from 0).
Json joint_space_json(const Chain& chain, const GatheredPoses& poses, std::array<int, 2> joints);

}  // namespace chainreel

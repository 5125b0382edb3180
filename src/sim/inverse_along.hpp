// Inverse dynamics at the rows of a recorded motion, of mechanisms that press on their constraints:
//
//   tau = M qdd + nle + tau_f + Jc^T lambda,   lambda = (A^T)^+ f_d of each constraint that is to bear f_d
//
// (dynamics/constrained_inverse); constraints without a contact force bear nothing, so that the joints alone carry the
// motion.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "sim/drive/limits.hpp"
#include "sim/drive/recorded_motion.hpp"
#include "sim/system/constraint_plan.hpp"

namespace chainreel {

struct InverseAlong {
  std::size_t nv = 0;
  std::vector<double> t;          // s, the instants as the table has them
  std::vector<double> tau;        // nv numbers an instant, N m or N
  std::vector<std::string> rows;  // of the constraints
  std::vector<double> lambda;     // rows numbers an instant, N or N m
  // How far the motion is from keeping the constraints, at worst: |phi|, |Jc qd|, |Jc qdd + Jcd_qd|.
  double position_error = 0, velocity_error = 0, acceleration_error = 0;
  std::vector<LimitEvent> limits;  // of joints, that the motion or its torques are first beyond, at the instants
};

// Throws Error (bad input) where the motion leaves the constraints, (numerical) naming row and column where a number overflows.
InverseAlong inverse_along(const Chain& chain, const ConstraintPlan& constraints, const RecordedMotion& motion);

}  // namespace chainreel

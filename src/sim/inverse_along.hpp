// Inverse dynamics along a motion given by a table, of mechanisms that press on their constraints:
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
#include "sim/system/constraint_plan.hpp"

namespace chainreel {

struct InverseAlong {
  std::size_t nv = 0;
  std::vector<double> t;          // s, the instants of the table
  std::vector<double> tau;        // nv numbers an instant, N m or N
  std::vector<std::string> rows;  // of the constraints
  std::vector<double> lambda;     // rows numbers an instant, N or N m
  // How far the motion is from keeping the constraints, at worst: |phi|, |Jc qd|, |Jc qdd + Jcd_qd|.
  double position_error = 0, velocity_error = 0, acceleration_error = 0;
};

// `trajectory`: a CSV with t,q1.. and maybe qd1.., qdd1..; what is absent is the derivative of a spline. Throws Error
// (bad input) where the table does not fit the chain or leaves the constraints, (numerical) naming row and column where
// a number overflows.
InverseAlong inverse_along(const Chain& chain, const ConstraintPlan& constraints, const std::string& trajectory);

}  // namespace chainreel

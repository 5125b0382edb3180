#include "model/principal_moments.hpp"

#include <algorithm>

#include "core/dense.hpp"
#include "core/format.hpp"

namespace chainreel {

Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia) {
  return eigen_of_symmetric(inertia).values;
}

std::string moments_text(const Eigen::Vector3d& moments) {
  return format_significant(moments[0], 4) + ", " + format_significant(moments[1], 4) + ", " +
         format_significant(moments[2], 4) + " kg m^2";
}

bool is_positive(const Eigen::Vector3d& moments) {
  return moments[0] >= -std::max(kNoMoment, kMomentTolerance * moments.cwiseAbs().maxCoeff());
}

bool keeps_triangle_inequality(const Eigen::Vector3d& moments) {
  return moments[2] <= moments[0] + moments[1] + std::max(kNoMoment, kMomentTolerance * moments[2]);
}

}  // namespace chainreel

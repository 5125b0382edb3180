// What a rotational inertia must be like to belong to a body. Along principal axes the moments are
// I1 = integral of (y^2 + z^2) dm and so on, so none is negative and none is larger than the sum of the other
// two.
#pragma once

#include <Eigen/Core>
#include <string>

namespace chainreel {

// The eigenvalues, rising.
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia);

// Files carry five or six digits, which may leave the thin direction of a rod slightly negative and the
// moments of a plate slightly off their sum.
inline constexpr double kMomentTolerance = 1e-4;  // of the largest moment

// Below this a moment is what round-off left of a zero, kg m^2: a milligram within a picometre has more.
inline constexpr double kNoMoment = 1e-30;

std::string moments_text(const Eigen::Vector3d& moments);  // "0.1, 0.2, 0.3 kg m^2"

bool is_positive(const Eigen::Vector3d& moments);
bool keeps_triangle_inequality(const Eigen::Vector3d& moments);

}  // namespace chainreel

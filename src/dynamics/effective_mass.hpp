// The effective mass of a frame: Lambda_inv = J M^-1 J^T, finite at every pose, and Lambda = J^-T M J^-1
// where J is square and regular (else the inverse of Lambda_inv where that exists). Ellipse drawn: forces for
// unit accelerations, f = Lambda u, |u| = 1, semi-axes the eigenvalues of Lambda in kg (K. Lynch, F. Park,
// Modern Robotics, ch. 8.1.1).
#pragma once

#include <optional>

#include "dynamics/kinematics.hpp"
#include "dynamics/workspace.hpp"

namespace chainreel {

// A singular value of L^-1 J^T, M = L L^T, below this fraction of the largest, or in the rounding of long chains, is what is left of none: infinite mass in that direction. Its square
// is the eigenvalue of Lambda_inv, in which rounding leaves kSingularFraction: singular values tell a mass a millionth of a microradian beside a stretched arm.
inline constexpr double kSingularValue = 1e-13;
inline constexpr double kSingularFraction = 1e-13;
// The same of a mechanism whose constraints forbid motions, of what the chain could do without them: rounding of the rows is left there.
inline constexpr double kForbiddenFraction = 1e-6;

struct EffectiveMass {
  TaskBasis basis;
  Eigen::MatrixXd Lambda_inv;             // 1/kg, symmetric
  std::optional<Eigen::MatrixXd> Lambda;  // kg; absent at singular poses
  Eigen::VectorXd mobility;               // eigenvalues of Lambda_inv, rising: 1/kg; never negative
  Eigen::MatrixXd directions;             // their unit eigenvectors, columns, in the basis
  double least = 0;                       // 1/kg: mobilities below it count as none
  std::vector<bool> is_infinite;          // one a direction: its mass is
  std::vector<Eigen::VectorXd> singular_directions;  // unit vectors of infinite mass, in the basis
};

// Uses ws.J, ws.M, ws.tau and ws.qdd on the way.
EffectiveMass effective_mass_of(const Chain& chain, Workspace& ws, ConstVec q, int frame, Task task);

// Fills mobility, directions, least, is_infinite and singular_directions from Lambda_inv. What lies below kForbiddenFraction of `free`, 1/kg, counts as
// zero; where that is 0, below kSingularFraction of the largest mobility.
void find_directions(EffectiveMass& effective, double free = 0);
// Lambda from mobility and directions, none of them singular.
Eigen::MatrixXd inverse_by_directions(const EffectiveMass& effective);

// The quadratic form sum_i values_i d_i d_i^T, d_i the directions of Lambda_inv, on the plane of two perpendicular unit
// vectors (columns, in W): its eigenvalues, rising, and their unit eigenvectors in W.
struct PlaneForm {
  Eigen::Vector2d values;
  Eigen::Matrix<double, 3, 2> directions;
};
PlaneForm form_on_plane(const EffectiveMass& effective, const Eigen::VectorXd& values,
                        const Eigen::Matrix<double, 3, 2>& plane);

}  // namespace chainreel

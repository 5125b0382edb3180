// Energies and momenta. The potential is zero where every body's centre of mass lies at the world's origin:
// -sum m g . p.
#pragma once

#include <vector>

#include "dynamics/workspace.hpp"

namespace chainreel {

struct Energy {
  double kinetic = 0;    // J
  double potential = 0;  // J
  double total() const { return kinetic + potential; }
};

struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // kg m/s
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // kg m^2/s, about the world's origin
};

struct BodyEnergy {
  Energy energy;
  Momentum momentum;
};

struct MassCenter {
  double mass = 0;                                     // kg, all moving bodies
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m; zero where there is no mass
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
};

// All of these call compute_kinematics.
Energy energy_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);
Momentum momentum_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);
MassCenter mass_center_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);
// One entry a body, the world's (zeros) first.
std::vector<BodyEnergy> body_energies_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);

}  // namespace chainreel

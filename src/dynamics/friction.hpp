// Joint friction, apart from nle: tau_f = damping qd + friction tanh(qd / v0), a smooth form of Coulomb's
// law.
#pragma once

#include <vector>

#include "dynamics/workspace.hpp"

namespace chainreel {

inline constexpr double kFrictionSmoothing =
    0.01;  // v0, rad/s or m/s: 76 % of the friction acts at this speed

// ws.tau_f, nv numbers; zero where the chain has no dissipation.
void compute_friction(const Chain& chain, Workspace& ws, ConstVec qd);

// The same, as a value.
std::vector<double> friction_of(const Chain& chain, ConstVec qd);

}  // namespace chainreel

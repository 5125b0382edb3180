// What a picture of one instant shows, in numbers.
#pragma once

#include "core/json.hpp"
#include "model/chain.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Of sample k of a run: t [s], q [rad, m], qd, tau [N m, N], lambda of the constraints' rows, energies [J], and of the end effector, where the chain has one,
// its place x [m] and velocity xd [m/s] along W.
Json sample_report(const Simulation& simulation, const Trajectory& trajectory, int k);

// Of a chain that stands still at q: q, and x of the end effector.
Json pose_report(const Chain& chain, ConstVec q);

}  // namespace chainreel

// A planar chain of point masses and rods as points linked to a chain, in Cartesian coordinates.
//
// A link of mass m, length L, centre of mass at distance d from its joint along its line, and moment of
// inertia I about that centre has, with velocities x' of its two ends, the kinetic energy
// 1/2 (a |x_{i-1}'|^2 + 2 b x_{i-1}' . x_i' + c |x_i'|^2) exactly where
//
//   a + 2 b + c = m,   b + c = m d / L,   c = (I + m d^2) / L^2.
//
// The last link may end anywhere: it ends at its centre of oscillation, L = (I + m d^2) / (m d), where b = 0.
// Weights act at the ends as they share the mass; torques as couples, across the links.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrate/system.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

// Throws Error (bad input) saying why where the chain is another one. `system` must outlive the result.
std::unique_ptr<LinkedPoints> make_chain_points(ChainSystem& system, const std::string& method);

}  // namespace chainreel

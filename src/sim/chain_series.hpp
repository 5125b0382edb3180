// A chain under a torque law as a Taylor series, for planar chains of revolute joints under torques that are
// constant, polynomial in t or affine in the state.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dynamics/kernels/taylor_planar.hpp"
#include "sim/chain_system.hpp"

namespace chainreel {

// Whether the policy may cut torques.
bool cuts_torques(const Chain& chain, LimitPolicy limit);

// Why this chain under this law has no series, a clause that follows "because"; nothing where it has one.
std::optional<std::string> why_no_series(const Chain& chain, const TorqueLaw& law, LimitPolicy limit);

// Terms up to `highest_order`. Throws Error (bad input) that says why there is none and names dop853.
std::unique_ptr<Series> make_chain_series(ChainSystem& system, int highest_order);

}  // namespace chainreel

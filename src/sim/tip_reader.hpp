// Expressions that read the end effector. Internal.
#pragma once

#include "core/error.hpp"
#include "sim/probe.hpp"

namespace chainreel {

// Throws Error (bad input) where the slot of the probe is x_G or another of the end effector and the chain has none.
void require_frame_of(const Chain& chain, const Probe& probe, int slot, const Place& place);

}  // namespace chainreel

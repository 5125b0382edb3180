// When in a step a joint passed a limit.
#pragma once

#include <optional>

#include "integrate/integrator.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

// By how much a state is beyond the limit that `seen` names; negative within it. An effort is that which the
// law asks for, before it is cut.
double excess_of(const LimitEvent& seen, ChainSystem& system, double t, ConstVec q, ConstVec qd);

// `seen` with the first instant of the last step at which it was beyond, and the value there; by dense
// output, looked at like events. Empty where it never was, as where an attempt that was rejected saw it.
std::optional<LimitEvent> first_passing(const LimitEvent& seen, ChainSystem& system, Integrator& integrator);

}  // namespace chainreel

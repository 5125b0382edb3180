// A start at rest on which nothing acts, and from which the least deviation grows: a pendulum on its head. What moves it is rounding.
#pragma once

#include <optional>

#include "sim/doubts.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Of a run that left such a start all the same; nothing of one that stands still, or that a torque or push moves later.
std::optional<Doubt> doubt_of_rest(const Simulation& simulation, const Trajectory& trajectory);

}  // namespace chainreel

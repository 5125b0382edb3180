// A run seen ever closer, where what is looked for lies between its samples: peaks of torques, rates and multipliers.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sim/simulate.hpp"

namespace chainreel {

// The same run at more instants: at all of its steps and within them, `looks` together where steps are fewer (of more than 200'000
// steps between its samples alone), then twice about those instants that `look` returned of what it saw last. Its own steps
// stay where they are.
void look_closer(const Simulation& simulation, const Trajectory& run, std::size_t looks,
                 const std::function<std::vector<double>(const Trajectory& seen)>& look, const StopRequest& stop = {});

}  // namespace chainreel

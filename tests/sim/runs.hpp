// Small runs of the lecture's chains, ready to be simulated.
#pragma once

#include <string>
#include <vector>

#include "sim/simulate.hpp"

namespace chainreel {

// A chain of models/ at rest at its zero configuration, rk4 at 1 ms.
Simulation run_of(const std::string& model, const std::vector<std::string>& torque, double duration,
                  const std::string& method = "rk4", double step = 0.001);

// 0, dt, 2 dt, .. up to `end`.
std::vector<double> instants(double end, double dt);

}  // namespace chainreel

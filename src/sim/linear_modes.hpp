// The motion of a chain linearised about a state: what decides whether a step is stable there.
#pragma once

#include <optional>
#include <vector>

#include "sim/simulate.hpp"

namespace chainreel {

// exp(lambda t), lambda = omega (-z +- i sqrt(1 - z^2)).
struct Mode {
  double omega = 0;          // rad/s
  double damping_ratio = 0;  // z
};

// The modes that oscillate, of the motion linearised about the start state; the slowest first. Empty for
// floating bases and where nothing swings.
std::vector<Mode> oscillating_modes(const Simulation& simulation);

// The longest step at which the simulation's method is stable in all these modes; none where there is no mode
// or the method's limit is not known. Infinite for methods that are stable at every step.
std::optional<double> longest_stable_step(const Method& method, const std::vector<Mode>& modes);

}  // namespace chainreel

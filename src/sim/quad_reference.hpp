// Where a run really goes: its states in quadruple precision, by two methods that share no text, and what no
// method in double precision can know of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/simulate.hpp"

namespace chainreel {

struct QuadReference {
  std::vector<double> t, q, qd;  // n numbers a time
  // At each time, of the coordinates: by how much the two methods differ. The doubles themselves are rounded.
  std::vector<double> uncertainty;
  std::string how;
};

// The states at `times` (rising, not negative) of the simulation's chain and torques, whatever its method.
// Nothing where they cannot be had in quadruple precision (see make_quad_system), or where the motion ends
// before the last of the times.
std::optional<QuadReference> quad_reference(const Simulation& simulation, std::span<const double> times);

// How much an error of the start has grown at `end`: the largest over small errors of single coordinates and
// rates, of the coordinates; at least 1. Times 2^-53 it is what no run in double precision gets below.
// Nothing where there is no reference.
std::optional<double> quad_amplification(const Simulation& simulation, double end);

}  // namespace chainreel

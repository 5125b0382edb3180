// Where a run ends, as exactly as it can be had, and how exactly that is.
#pragma once

#include <string>

#include "sim/simulate.hpp"
#include "sim/work_precision.hpp"

namespace chainreel {

struct EndReference {
  EndState state;
  double uncertainty = 0;    // of the coordinates: by how much two ways to the reference differ
  double amplification = 1;  // growth of small errors of the start until the end
  std::string how;           // in a few words
};

// The simulation's own method is left out of it and unchanged. Throws Error (numerical) where the motion has
// no end to compare with.
EndReference end_reference(Simulation& simulation);

}  // namespace chainreel

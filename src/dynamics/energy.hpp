// Energies. The potential is zero where every body's centre of mass lies at the world's origin: -sum m g . p.
#pragma once

#include "dynamics/workspace.hpp"

namespace chainreel {

struct Energy {
  double kinetic = 0;    // J
  double potential = 0;  // J
  double total() const { return kinetic + potential; }
};

Energy energy_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd);

}  // namespace chainreel

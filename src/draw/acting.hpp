// What acts on a chain and moves it along a run, as the layers `torque`, `velocity`, `gravity` and
// `constraint_force` show it.
#pragma once

#include <vector>

#include "draw/vectors.hpp"
#include "dynamics/workspace.hpp"
#include "sim/drive/torques_along.hpp"

namespace chainreel {

// Which of them are shown.
struct ActingLayers {
  bool torque = false, velocity = false, gravity = false, constraint_force = false;
  bool any() const { return torque || velocity || gravity || constraint_force; }
};

class Acting {
 public:
  // Torques and reactions are computed here, once for the whole run. `simulation` may be null where neither
  // is shown; it is not kept.
  Acting(const Chain& chain, const Simulation* simulation, const Trajectory& trajectory,
         const ActingLayers& layers);

  // Vectors at sample k, after compute_kinematics there.
  std::vector<WorldVector> at(const Workspace& ws, int k) const;

 private:
  void add_torques(std::vector<WorldVector>& vectors, const Workspace& ws, int k) const;
  void add_weights(std::vector<WorldVector>& vectors, const Workspace& ws) const;

  const Chain* chain_;
  ActingLayers layers_;
  std::vector<double> tau_;  // nv numbers a sample
  std::vector<std::vector<Reaction>> reactions_;
};

}  // namespace chainreel

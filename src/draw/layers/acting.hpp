// What acts on a chain and moves it along a run, as the layers `torque`, `velocity`, `gravity` and
// `constraint_force` show it.
#pragma once

#include <string>
#include <vector>

#include "draw/layers/vectors.hpp"
#include "draw/page/scales.hpp"
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

// What the page says of the layers that a scene names: scales of vectors, and the equation of motion.

// One entry a kind of vector that is shown, each with a mark of 1, 2 or 5 x 10^n: the scale is printed
// whenever the layer is on. `named`: the legend is on, and says what each one is.
std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme);

// The kinds that these layers show of this chain.
std::vector<VectorKind> kinds_shown(const Chain& chain, const ActingLayers& layers);

// "M(q) qdd + h(q, qd) = tau", with the multipliers' term where there are constraints.
std::string equation_of_motion(bool constrained);
// tau and lambda take the colours of their vectors where those are shown.
std::vector<SymbolColor> equation_colors(const ActingLayers& layers, const Theme& theme);

}  // namespace chainreel

// What acts and presses along a run: the trajectory holds the motion alone, so that runs cost no more than
// they must; outputs that show forces take them from here, at the instants that they show.
#pragma once

#include <optional>
#include <vector>

#include "sim/simulate.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

// Corners of the torques that the run held at zero at that instant are held in `system`, too; no others are.
void hold_as_then(ChainSystem& system, const Simulation& simulation, const Trajectory& trajectory, double t);

// The joint torques at each sample, nv numbers each (N m or N), as the run felt them: with those that press on
// constraints, cut where the limit policy says so, friction left out.
std::vector<double> torques_along(const Simulation& simulation, const Trajectory& trajectory);

// The multipliers of the constraints at each sample, as many as the run has rows (N or N m); no numbers where none answer.
std::vector<double> multipliers_along(const Simulation& simulation, const Trajectory& trajectory);

// The largest multiplier of a row over a run: with its sign, and the first instant at which it is as large but for rounding.
struct LargestMultiplier {
  double value = 0, t = 0;
};
// Looked for at the samples and between them, then at all steps of the run and within them (of more than 200'000 steps between the
// samples alone), and closer about what is found.
std::vector<LargestMultiplier> largest_multipliers(const Simulation& simulation, const Trajectory& trajectory);

// How far each row of the constraints is missed at each sample: phi, signed, as many as the run has rows (m or rad).
std::vector<double> constraint_errors_along(const Simulation& simulation, const Trajectory& trajectory);

// The springs and dampers that drive the run's joints, as `LinearDrive` tells them: none whose torque the limit policy may
// cut; those are no `whole` beside a force that presses on a constraint.
std::vector<LinearDrive> linear_drives(const Simulation& simulation);

// The coordinates that feedback follows at each sample, nv numbers each, and those of the run itself where a joint follows
// none; empty where no joint does, and with floating joints.
std::vector<double> references_along(const Simulation& simulation, const Trajectory& trajectory);

// The places that feedback in the space of the task pulls to at each sample; empty where there is none.
std::vector<TaskTarget> task_targets_along(const Simulation& simulation, const Trajectory& trajectory);

// The force on the robot (N, W) at the place where a constraint holds it.
struct Reaction {
  int frame = 0;  // index into chain.frames: its origin is the place
  Eigen::Vector3d force;
  std::vector<int> rows;  // whose multipliers, turned round, are its parts
};

// The reactions at each sample: of every constraint that holds a frame, in the order of the scene; of those
// that tie two frames, at the first one. Empty where nothing is constrained.
std::vector<std::vector<Reaction>> reactions_along(const Simulation& simulation,
                                                   const Trajectory& trajectory);

// The largest of them, N, where all are so small beside the robot's weight that they are what cancelling leaves: less than a
// millionth of it (of its mass at 1 m/s^2 where gravity is less). Else nothing.
std::optional<double> rounding_of(const Chain& chain, const std::vector<std::vector<Reaction>>& reactions);

}  // namespace chainreel

// A scene together with its model: everything that a run needs, checked.
#pragma once

#include "model/read_chain.hpp"
#include "scene/scene.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// How the scene wants its model read.
ModelOptions model_options_of(const Scene& scene);

// Reads the model and resolves torques, start state and method. What the scene left to defaults (gravity,
// start, torque, end effector) is written back into `scene`, which then is the effective one. Throws Error
// with every problem.
Simulation prepare(Scene& scene, bool meshes = true);

}  // namespace chainreel

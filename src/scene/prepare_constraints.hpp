// A scene's constraints made ready for a run. Internal.
#pragma once

#include "scene/scene.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Fills simulation.constraints and brings its start state onto them: a start that lies a little beside is
// moved, and scene.notices says so; the scene's start is then that one. Throws Error where constraints do not
// fit the chain, contradict each other or cannot be reached, with the distance.
void prepare_constraints(Scene& scene, Simulation& simulation);

}  // namespace chainreel

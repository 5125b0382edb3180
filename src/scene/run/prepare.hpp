// A scene together with its model: everything that a run needs, checked.
#pragma once

#include <optional>
#include <string>

#include "model/chain.hpp"
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

// The last model that was read, for scenes that differ in other things: it is read once. For one thread at a time.
class LastChain {
 public:
  const Chain& read(const ModelSource& source, const ModelOptions& options);

 private:
  ModelSource source_;
  ModelOptions options_;
  std::optional<Chain> chain_;
};
Simulation prepare(Scene& scene, bool meshes, LastChain& last);

// What the tables that drive a scene say of its start and of its duration.

// Where torques are those of a motion, that motion's own start is the scene's, unless `start:` names another one. Where
// a table begins later than the run or ends before it, what it is taken for there is refused, or said in scene.notices
// unless `outside:` has said it. Throws Error.
void prepare_tables(Scene& scene, const Chain& chain);

// The scene's recorded motion becomes the run, its first row the start; what one should know of it is said in scene.notices.
// Throws Error where the table is no motion of the chain, or ends before the scene does.
void prepare_motion(Scene& scene, Simulation& simulation);

// A scene's constraints made ready for a run. Internal.

// Fills simulation.constraints and brings its start state onto them: a start that lies a little beside is
// moved, and scene.notices says so; the scene's start is then that one. Throws Error where constraints do not
// fit the chain, contradict each other or cannot be reached, with the distance.
void prepare_constraints(Scene& scene, Simulation& simulation);

}  // namespace chainreel

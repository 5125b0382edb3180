// A scene together with its model: everything that a run needs, checked.
#pragma once

#include <optional>
#include <string>

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

// The last model that was read, for scenes that differ in other things: its file is read once. For one thread at a time.
class LastChain {
 public:
  const Chain& read(const std::string& path, const ModelOptions& options);

 private:
  std::string path_;
  ModelOptions options_;
  std::optional<Chain> chain_;
};
Simulation prepare(Scene& scene, bool meshes, LastChain& last);

}  // namespace chainreel

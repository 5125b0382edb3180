// A model (.urdf) where a command could have taken a scene: it is read as a scene that names the model and nothing else,
// so that keys given on the command line are checked where all keys are. A key that the command makes no use of is
// refused, never passed over.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "draw/figures/poses.hpp"
#include "model/read_chain.hpp"
#include "scene/scene.hpp"

namespace chainreel {

struct ModelScene {
  Scene scene;
  ModelOptions options;  // as the scene wants its model read
};

// `overrides` as of overrides_of; those below `honoured` keys are good, see keys_of_models. Throws Error of what is wrong with a key or its
// value, and (usage) naming what `command` of a model takes where it is another.
ModelScene model_scene_of(const std::string& model, const std::vector<std::string>& overrides,
                          const std::string& command, const std::vector<std::string>& honoured);

// The same of a scene that has been read.
ModelScene model_scene_of(Scene scene);
// Throws Error (usage) of overrides that mean nothing to `command` of a model.
void require_honoured(const std::vector<std::string>& overrides, const std::string& model, const std::string& command,
                      const std::vector<std::string>& honoured);

// What the picture keys say of a figure of `chain`, which was read from the model. Throws Error of a mesh that cannot
// be read.
void set_look(PoseFigureOptions& figure, const ModelScene& model, const Chain& chain);

}  // namespace chainreel

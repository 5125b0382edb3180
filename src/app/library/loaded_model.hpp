// What other programs call: a model read as the commands read it, and the figure of its effective mass.
#pragma once

#include <string>
#include <vector>

#include "app/film/model_scene.hpp"
#include "app/library/scene_run.hpp"
#include "model/chain.hpp"

namespace chainreel {

struct LoadedModel {
  ModelScene asked;  // with what a scene says of models: gravity, base, end_effector ..
  Chain chain;
};

// `request.path` is a .urdf, or of a model that comes with the program; a text holds the key `model` with numbers in the place
// of a file. Overrides are the keys that `dynamics` of a model takes, and `end_effector`. Throws Error.
LoadedModel load_model(const SceneRequest& request);

// The figure that `ellipse` draws of the poses, as the text of an SVG. Throws Error where there is no end effector.
std::string ellipse_svg(const LoadedModel& model, const std::vector<std::vector<double>>& poses,
                        const std::string& reading, int width, int height);

}  // namespace chainreel

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

// The figure that `ellipse` draws of the poses, px.
struct AskedEllipse {
  std::vector<std::vector<double>> poses;
  std::string reading;  // a word of EllipseReading
  int width = 640, height = 480;
};
// As the text of an SVG. Throws Error where there is no end effector.
std::string ellipse_svg(const LoadedModel& model, const AskedEllipse& asked);
// As a .png, .svg or .pdf. Throws Error, too, where the file cannot be written.
void write_ellipse(const LoadedModel& model, const AskedEllipse& asked, const std::string& path, bool overwrite);

}  // namespace chainreel

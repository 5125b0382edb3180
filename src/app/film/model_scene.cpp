#include "app/film/model_scene.hpp"

#include <algorithm>

#include "app/film/house_logo.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/page/house_style.hpp"
#include "draw/robot/view.hpp"
#include "scene/keys/keys.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

// Itself, or above it a key that is; or a section, all of whose keys are.
bool is_honoured(const std::string& key, const std::vector<std::string>& honoured) {
  const auto is_known = [&](const std::string& name) {
    return std::any_of(honoured.begin(), honoured.end(), [&](const std::string& known) { return name == known || name.starts_with(known + "."); });
  };
  bool has_keys = false, all_known = true;
  for (const SceneKey& one : scene_keys())
    if (!one.is_section && one.section() == key) has_keys = true, all_known = all_known && is_known(one.name);
  return is_known(key) || (has_keys && all_known);
}

}  // namespace

void require_honoured(const std::vector<std::string>& overrides, const std::string& model, const std::string& command,
                      const std::vector<std::string>& honoured) {
  std::vector<Problem> problems;
  for (const std::string& text : overrides) {
    if (is_honoured(text.substr(0, text.find('=')), honoured)) continue;
    problems.push_back({"--set " + text + ": means nothing to `" + command + "` of the model " + model +
                            "; of a scene's keys it takes " + joined(honoured) +
                            ": write a scene with `model: ...` for the others" +
                            (text.find("ellipse") != std::string::npos ? "; `chainreel ellipse " + model + " --pose ..` draws ellipses at poses" : ""),
                        {}});
  }
  if (!problems.empty()) throw Error(ExitCode::usage, std::move(problems));
}

ModelScene model_scene_of(Scene scene) {
  ModelScene read{std::move(scene), {}};
  read.options = model_options_of(read.scene);
  read.options.end_effector = read.scene.end_effector;
  return read;
}

ModelScene model_scene_of(const std::string& model, const std::vector<std::string>& overrides,
                          const std::string& command, const std::vector<std::string>& honoured) {
  Scene scene = read_model_scene(model, overrides);
  require_honoured(overrides, model, command, honoured);
  return model_scene_of(std::move(scene));
}

void set_look(PoseFigureOptions& figure, const ModelScene& model, const Chain& chain) {
  const Scene& scene = model.scene;
  figure.width = scene.video.width;
  figure.height = scene.video.height;
  figure.text_scale = scene.text_scale;
  figure.theme = &page_theme(scene);
  figure.camera = scene.camera;
  figure.logo = page_logo(scene, figure.height);
  MeshShelf shelf;
  const BodyLook look{scene.links, scene.mesh_up, is_oblique(chain, scene.camera), scene.place_of("links")};
  figure.shapes = shapes_for(look, scene.model, chain, model.options, shelf);
}

}  // namespace chainreel

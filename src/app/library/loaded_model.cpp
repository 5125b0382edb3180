#include "app/library/loaded_model.hpp"

#include "core/data_folder.hpp"
#include "app/film/prepared.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/names.hpp"
#include "core/plain_numbers.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/house_style.hpp"
#include "model/read_chain.hpp"
#include "render/vector_shapes.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/instant.hpp"

namespace chainreel {

LoadedModel load_model(const SceneRequest& request) {
  const PlainNumbers plain;
  std::vector<std::string> honoured = keys_of_models(OfModel::mechanism);
  honoured.push_back("end_effector");
  LoadedModel model;
  if (request.text) {
    require_honoured(request.overrides, request.path, "load", honoured);
    model.asked = model_scene_of(read_scene_text(*request.text, request.path, request.overrides));
  } else {
    model.asked = model_scene_of(found_file(request.path), request.overrides, "load", honoured);
  }
  model.asked.options.meshes = false;
  model.chain = read_chain(model.asked.scene.model, model.asked.options);
  return model;
}

std::string ellipse_svg(const LoadedModel& model, const std::vector<std::vector<double>>& poses,
                        const std::string& reading, int width, int height) {
  const PlainNumbers plain;
  require_end_effector(model.chain);
  const std::optional<EllipseReading> read_as = value_named<EllipseReading>(reading);
  if (!read_as)
    throw Error(ExitCode::usage, "reading '" + reading + "' is none of " + joined(words_of(names_of(EllipseReading{}))));
  PoseFigureOptions figure;
  figure.width = width;
  figure.height = height;
  figure.theme = &page_theme(model.asked.scene);
  figure.reading = *read_as;
  const Fonts fonts(families_of(model.asked.scene));
  VectorPage page;
  page.height = height;
  page.title = "effective mass of " + model.chain.name;
  return svg_text(draw_ellipse_figure(TipMass(model.chain), poses, figure, fonts), fonts, page);
}

}  // namespace chainreel

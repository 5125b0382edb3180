#include "app/library/loaded_model.hpp"

#include "app/film/prepared.hpp"
#include "app/film/target.hpp"
#include "core/data_folder.hpp"
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

namespace {

Picture picture_of(const LoadedModel& model, const AskedEllipse& asked, const Fonts& fonts) {
  require_end_effector(model.chain);
  const std::optional<EllipseReading> reading = value_named<EllipseReading>(asked.reading);
  if (!reading)
    throw Error(ExitCode::usage, "reading '" + asked.reading + "' is none of " + joined(words_of(names_of(EllipseReading{}))));
  PoseFigureOptions figure;
  figure.width = asked.width;
  figure.height = asked.height;
  figure.theme = &page_theme(model.asked.scene);
  figure.reading = *reading;
  return draw_ellipse_figure(TipMass(model.chain), asked.poses, figure, fonts);
}

std::string title_of(const LoadedModel& model) {
  return "effective mass of " + model.chain.name;
}

}  // namespace

std::string ellipse_svg(const LoadedModel& model, const AskedEllipse& asked) {
  const PlainNumbers plain;
  const Fonts fonts(families_of(model.asked.scene));
  VectorPage page;
  page.height = asked.height;
  page.title = title_of(model);
  return svg_text(picture_of(model, asked, fonts), fonts, page);
}

void write_ellipse(const LoadedModel& model, const AskedEllipse& asked, const std::string& path, bool overwrite) {
  const PlainNumbers plain;
  picture_format_of(path);
  const Fonts fonts(families_of(model.asked.scene));
  ClipMemory memory;
  memory.title = title_of(model);
  write_picture(picture_of(model, asked, fonts), asked.width, asked.height, fonts, path, overwrite, memory);
}

}  // namespace chainreel

#include "app/film/prepared.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "app/film/automatic.hpp"
#include "app/film/house_logo.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/page/house_style.hpp"
#include "draw/robot/view.hpp"
#include "picture/formula_words.hpp"
#include "scene/annotation.hpp"
#include "scene/run/prepare.hpp"
#include "scene/run/title.hpp"
#include "scene/text/panels.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {

namespace {

// Default layers of the end effector where the model has none. `said`: by other panels.
void say_what_is_left_out(const std::vector<std::string>& wanted, const PreparedScene& prepared, std::set<std::string>& said) {
  std::vector<std::string> missing;
  for (const std::string& layer : wanted)
    if (std::find(prepared.scene.draw.begin(), prepared.scene.draw.end(), layer) == prepared.scene.draw.end())
      missing.push_back(layer);
  const std::string note = joined(missing) + ": not drawn, as " + prepared.scene.model.words() +
                           " has several ends: choose one with `--set end_effector=NAME`";
  if (!missing.empty() && said.insert(note).second) std::fprintf(stderr, "note: %s\n", note.c_str());
}

// Layers that the scene names and its pictures have not.
void say_what_is_asked_in_vain(const PreparedScene& prepared, std::set<std::string>& said) {
  const Scene& scene = prepared.scene;
  const bool is_flat = !is_oblique(prepared.simulation.chain, scene.camera);
  const auto say = [&](const auto& is_in_vain, const char* why) {
    std::vector<std::string> missing;
    for (const std::string& layer : scene.named_layers)
      if (is_in_vain(layer)) missing.push_back(layer);
    const std::string note = scene.name + ": " + joined(missing) + ": not drawn, " + why;
    if (!missing.empty() && said.insert(note).second) std::fprintf(stderr, "note: %s\n", note.c_str());
  };
  say([&](const std::string& layer) { return is_transparent(scene) && layer_needs(layer, LayerNeeds::words); }, "as transparent pictures have no words around their scene");
  const bool has_ellipse = std::ranges::count(scene.draw, "ellipse") > 0;
  for (const auto& [key, place] : scene.places)
    if (!has_ellipse && key.starts_with("ellipse.")) {
      const std::string note = to_string(Problem{"'" + key + "' is of the layer `ellipse`, which is not drawn: add draw: [+ellipse]", place});
      if (said.insert(note).second) std::fprintf(stderr, "note: %s\n", note.c_str());
    }
  say([&](const std::string& layer) { return is_flat && (layer == "ground" || layer == "shadow"); }, "as both are seen obliquely alone: give camera.azimuth or camera.elevation");
}

PreparedScene prepare_panel(Scene scene, bool meshes, bool quiet, double between, std::set<std::string>& said) {
  PreparedScene prepared{std::move(scene), {}, {}, nullptr};
  const std::vector<std::string> wanted = prepared.scene.draw;
  prepared.simulation = prepare(prepared.scene, meshes);
  if (!quiet) {
    say_what_is_left_out(wanted, prepared, said);
    if (meshes) say_what_is_asked_in_vain(prepared, said);
  }
  choose_automatically(prepared, quiet, between);
  return prepared;
}

// Every panel is prepared, so that all problems are told at once; what several panels share is told once.
std::vector<PreparedScene> prepare_panels(const std::vector<Scene>& scenes, bool meshes, bool quiet, double between) {
  std::vector<PreparedScene> panels;
  std::set<std::string> seen, said;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const Scene& scene : scenes) {
    try {
      panels.push_back(prepare_panel(scene, meshes, quiet, between, said));
    } catch (const Error& error) {
      code = error.code();
      for (const Problem& problem : error.problems())
        if (seen.insert(to_string(problem)).second) problems.push_back(problem);
    }
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
  return panels;
}

// How a motion is found that stands for the exact one. Where it is so hard that it takes more than these evaluations its beginning is.
struct Reference {
  const char* method;
  double tolerance;
};
constexpr Reference kReferences[] = {{"dop853", 1e-12}, {"radau5", 1e-10}};
constexpr long kMostEvaluations = 1000000;

std::vector<Simulation> references_of(const Scene& page) {
  const auto is_plotted = [](const PlotEntry& plot) { return plot.value != to_string(PlotQuantity::energy_error); };
  if (std::ranges::none_of(page.plot, is_plotted) || page.compare.front().motion || !differ_by_method_alone(page.compare)) return {};
  std::vector<Simulation> references;
  for (const Reference& reference : kReferences) {
    Scene scene = page.compare.front();
    scene.method = reference.method;
    scene.tolerance = reference.tolerance;
    scene.step.reset();
    scene.order.reset();
    references.push_back(prepare(scene, false));
    references.back().most_evaluations = kMostEvaluations;
  }
  return references;
}

void drive(Scene& scene, const OwnTorque& torque) {
  if (scene.motion)
    throw Error(ExitCode::usage, "the scene shows a recorded motion, whose torques follow from it, and is given " + torque.words +
                                     ": leave one of them out",
                scene.place_of("motion"));
  if (!scene.torque.empty() || scene.control)
    throw Error(ExitCode::usage, "the scene has a torque of its own, and is given " + torque.words + ": leave one of them out",
                scene.place_of("torque"));
  Control control;
  control.function = torque;
  scene.control = control;
  for (Scene& panel : scene.compare) drive(panel, torque);
}

void load_shapes(PreparedFilm& film) {
  MeshShelf shelf;
  for (PreparedScene& panel : film.panels) {
    const Scene& scene = panel.scene;
    const Chain& chain = panel.simulation.chain;
    const BodyLook look{scene.links, scene.mesh_up, is_oblique(chain, film.scene.camera), scene.place_of("links")};
    panel.shapes = shapes_for(look, scene.model, chain, model_options_of(scene), shelf);
  }
}

// Formulas of titles, plots and annotations are notation; elsewhere in a page's words none is asked for.
void check_formulas(const PreparedFilm& film) {
  ProblemList problems;
  const auto check = [&](const std::string& key, const std::string& text, const Place& place) {
    try {
      require_formulas(text, key != "annotate");
    } catch (const Error& error) {
      problems.add("'" + key + "': " + error.problems().front().message, place);
    }
  };
  check("title", film.scene.title, film.scene.place_of("title"));
  if (film.panels.size() > 1)
    for (const PreparedScene& panel : film.panels) check("title", panel.scene.title, panel.scene.place_of("title"));
  for (const AnnotationEntry& entry : film.scene.annotate) check("annotate", entry.text, entry.place);
  for (const PlotEntry& plot : film.scene.plot) check("plot", plot.title, plot.place);
  problems.throw_if_any();
}

void check_words(const PreparedFilm& film) {
  check_formulas(film);
  std::vector<const Scene*> scenes;
  std::vector<const Chain*> chains;
  for (const PreparedScene& panel : film.panels) {
    scenes.push_back(&panel.scene);
    chains.push_back(&panel.simulation.chain);
  }
  check_annotations(film.scene, scenes, chains);
}

// What tells this run from others of the same scene; a title that was given with it says itself what it is to say.
Parameters set_parameters(const Scene& scene) {
  Parameters set;
  const auto is_set = [&](const std::string& key) { return scene.place_of(key).file.starts_with("--set"); };
  if (is_set("title")) return set;
  for (const auto& one : scene.parameters)
    if (is_set("parameters." + one.first) || is_set("parameters")) set.push_back(one);
  return set;
}

// What the coordinates of all panels are measured in; of models that differ in that nothing.
CoordinateUnits shared_units(const std::vector<PreparedScene>& panels) {
  const CoordinateUnits units = units_of(panels.front().simulation.chain);
  const auto has_these = [&](const PreparedScene& panel) { return units_of(panel.simulation.chain) == units; };
  return std::ranges::all_of(panels, has_these) ? units : CoordinateUnits{};
}

void notice_the_page(PreparedFilm& film) {
  std::vector<std::string>& notices = film.panels.front().scene.notices;
  for (PreparedScene& panel : film.panels)
    for (std::string& line : title_notices(panel.scene)) panel.scene.notices.push_back(std::move(line));
  if (film.panels.size() > 1)
    for (std::string& line : title_notices(film.scene)) notices.push_back(std::move(line));
  for (std::string& line : low_contrasts(film.scene, bars_of(film))) notices.push_back(std::move(line));
}

}  // namespace

std::size_t bars_of(const PreparedFilm& film) {
  std::size_t bars = 0;
  for (const PreparedScene& panel : film.panels)
    if (!panel.shapes) bars = std::max(bars, panel.simulation.chain.bodies.size() - 1);
  return bars;
}

PreparedFilm load_film(const std::string& path, const std::vector<std::string>& overrides, bool meshes, bool quiet) {
  return film_of(read_scene(path, overrides), meshes, quiet);
}

PreparedFilm film_of(Scene scene, bool meshes, bool quiet, const std::optional<OwnTorque>& torque, double between) {
  PreparedFilm film{std::move(scene), {}, quiet};
  if (torque) drive(film.scene, *torque);
  if (meshes) load_logo(film.scene);
  if (film.scene.compare.empty()) {
    std::set<std::string> said;
    film.scene.set_parameters = set_parameters(film.scene);
    film.panels.push_back(prepare_panel(std::move(film.scene), meshes, quiet, between, said));
    film.scene = film.panels.front().scene;
    check_words(film);
    if (meshes) load_shapes(film);
    notice_the_page(film);
    return film;
  }
  if (meshes) film.references = references_of(film.scene);
  film.panels = prepare_panels(film.scene.compare, meshes, quiet, between);
  for (std::size_t i = 0; i < film.panels.size(); ++i) film.scene.compare[i] = film.panels[i].scene;
  name_panels(film.scene.compare, shared_units(film.panels));
  for (std::size_t i = 0; i < film.panels.size(); ++i)
    film.panels[i].scene.title = film.scene.compare[i].title;
  check_words(film);
  if (meshes) load_shapes(film);
  notice_the_page(film);
  return film;
}

void leave_events_out(PreparedScene& prepared) {
  if (prepared.simulation.events && !prepared.simulation.events->list.empty())
    prepared.scene.notices.push_back("events are not looked for here, also those that would end the run: it goes on to t = " +
                                     format_shortest(prepared.scene.duration) + " s, by the steps that it takes without them");
  prepared.simulation.events = nullptr;
}

PreparedScene load_motion(const std::string& path, const std::vector<std::string>& overrides, int panel, bool quiet) {
  Scene scene = read_scene(path, overrides, MethodsOf::command);
  std::vector<Scene> panels;
  std::size_t chosen = 0;
  if (panel == 0 && !scene.compare.empty() && differ_by_method_alone(scene.compare)) {
    const std::string title = scene.title;
    scene = Scene(scene.compare.front());
    scene.title = title;
  } else if (chosen = chosen_panel(scene, panel); !scene.compare.empty()) {
    panels = scene.compare;
    scene = panels[chosen];
  }
  PreparedScene prepared{std::move(scene), {}, {}, nullptr};
  prepared.simulation = prepare(prepared.scene, false);
  if (!panels.empty()) {
    name_panels(panels, units_of(prepared.simulation.chain));
    prepared.scene.title = panels[chosen].title;
  }
  leave_events_out(prepared);
  say_notices(prepared, quiet);
  return prepared;
}

std::vector<double> frame_times(const Scene& scene) {
  std::vector<double> times(std::size_t(frame_count(scene.duration, scene.video.fps)));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = frame_time(int(k), scene.video.fps);
  return times;
}

std::vector<double> instants_every(double between, double duration, double most) {
  const double rate = std::round(1 / between), rows = duration / between;
  const bool is_part = std::abs(rate * between - 1) < 1e-12;
  const int apart = std::max(1, int(std::ceil(rows / most)));
  std::vector<double> times;
  for (int k = 0; k <= int(rows); k += apart) times.push_back(is_part ? k / rate : k * between);
  return times;
}

}  // namespace chainreel

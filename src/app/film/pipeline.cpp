#include "app/film/pipeline.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "app/film/automatic.hpp"
#include "app/signals.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "draw/view.hpp"
#include "render/canvas.hpp"
#include "scene/panels.hpp"
#include "scene/prepare.hpp"
#include "scene/read_scene.hpp"
#include "sim/audit.hpp"

namespace chainreel {

namespace {

// Default layers of the end effector where the model has none.
void say_what_is_left_out(const std::vector<std::string>& wanted, const PreparedScene& prepared) {
  std::string missing;
  for (const std::string& layer : wanted)
    if (std::find(prepared.scene.draw.begin(), prepared.scene.draw.end(), layer) == prepared.scene.draw.end())
      missing += (missing.empty() ? "" : ", ") + layer;
  if (!missing.empty())
    std::fprintf(stderr, "note: %s: not drawn, as %s has several ends: choose one with `--set end_effector=NAME`\n",
                 missing.c_str(), prepared.scene.model.c_str());
}

PreparedScene prepare_panel(Scene scene, bool meshes, bool quiet) {
  PreparedScene prepared{std::move(scene), {}, {}, nullptr};
  const std::vector<std::string> wanted = prepared.scene.draw;
  prepared.simulation = prepare(prepared.scene, meshes);
  if (!quiet) say_what_is_left_out(wanted, prepared);
  choose_automatically(prepared, quiet);
  return prepared;
}

// Every panel is prepared, so that all problems are told at once; what several panels share is told once.
std::vector<PreparedScene> prepare_panels(const std::vector<Scene>& scenes, bool meshes, bool quiet) {
  std::vector<PreparedScene> panels;
  std::set<std::string> seen;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const Scene& scene : scenes) {
    try {
      panels.push_back(prepare_panel(scene, meshes, quiet));
    } catch (const Error& error) {
      code = error.code();
      for (const Problem& problem : error.problems())
        if (seen.insert(to_string(problem)).second) problems.push_back(problem);
    }
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
  return panels;
}

}  // namespace

namespace {

void load_shapes(PreparedFilm& film) {
  MeshShelf shelf;
  for (PreparedScene& panel : film.panels) {
    const Scene& scene = panel.scene;
    const Chain& chain = panel.simulation.chain;
    const BodyLook look{scene.links, scene.mesh_up, is_oblique(chain, film.scene.camera), scene.place_of("links")};
    panel.shapes = shapes_for(look, scene.model, chain, model_options_of(scene), shelf);
    if (panel.shapes) fill_by_several_threads();
  }
}

}  // namespace

PreparedFilm load_film(const std::string& path, const std::vector<std::string>& overrides, bool meshes, bool quiet) {
  PreparedFilm film{read_scene(path, overrides), {}};
  if (film.scene.compare.empty()) {
    film.panels.push_back(prepare_panel(std::move(film.scene), meshes, quiet));
    film.scene = film.panels.front().scene;
    if (meshes) load_shapes(film);
    return film;
  }
  film.panels = prepare_panels(film.scene.compare, meshes, quiet);
  for (std::size_t i = 0; i < film.panels.size(); ++i) film.scene.compare[i] = film.panels[i].scene;
  name_panels(film.scene.compare);
  for (std::size_t i = 0; i < film.panels.size(); ++i)
    film.panels[i].scene.title = film.scene.compare[i].title;
  if (meshes) load_shapes(film);
  return film;
}

PreparedScene load_scene(const std::string& path, const std::vector<std::string>& overrides, bool meshes,
                         bool quiet) {
  Scene scene = read_scene(path, overrides);
  require_single_run(scene);
  PreparedScene prepared = prepare_panel(std::move(scene), meshes, quiet);
  prepared.simulation.events = nullptr;
  return prepared;
}

std::vector<double> frame_times(const Scene& scene) {
  std::vector<double> times(std::size_t(frame_count(scene.duration, scene.video.fps)));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = frame_time(int(k), scene.video.fps);
  return times;
}

FilmClock clock_of(const PreparedFilm& film) {
  const Scene& scene = film.scene;
  const PreparedScene& first = film.panels.front();
  EventHits hits;
  if (std::any_of(scene.slow_motion.begin(), scene.slow_motion.end(),
                  [](const SlowMotionEntry& entry) { return !entry.event.empty(); })) {
    hits = simulate(first.simulation, {}, [](double) { return interrupted(); }).events;
    throw_if_interrupted();
  }
  const FilmClock clock(scene.duration, scene.video.fps,
                        stretches_of(scene.slow_motion, first.scene.events, hits));
  if (clock.is_plain()) return clock;
  const double frames = clock.film_seconds() * scene.video.fps.value();
  if (frames > kMostFrames)
    throw Error(ExitCode::limit, "slow motion makes a film of more than ten million frames",
                scene.place_of("slow_motion"));
  if (frames < 0.5)
    throw Error(ExitCode::bad_input, "slow motion leaves less than half a frame: the film would be empty",
                scene.place_of("slow_motion"));
  return clock;
}

std::string in_panel(const Scene& scene, std::size_t i, const std::string& message) {
  return "panel " + std::to_string(i + 1) + " (" + scene.title + "): " + message;
}

void require_expected_end(const Trajectory& trajectory, const Scene& scene) {
  throw_if_interrupted();
  if (scene.expect == "diverge") {
    if (trajectory.status == RunStatus::diverged) return;
    if (is_complete(trajectory.status))
      throw Error(ExitCode::numerical,
                  "the run was expected to diverge, but " + to_string(trajectory.status) +
                      " at t = " + format_shortest(trajectory.end_time) + " s with " + method_text(scene),
                  scene.place_of("expect"));
  }
  if (is_complete(trajectory.status)) return;
  throw Error(ExitCode::numerical,
              trajectory.trouble + " with " + method_text(scene) + ": try a smaller step or another method",
              {scene.file});
}

void require_expected_ends(const PreparedFilm& film, const std::vector<Trajectory>& runs,
                           std::optional<int> frame) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Scene& scene = film.panels[i].scene;
    if (frame && *frame < runs[i].size() && scene.expect == "finish") continue;
    try {
      require_expected_end(runs[i], scene);
    } catch (const Error& error) {
      if (error.code() != ExitCode::numerical) throw;  // a signal
      const Problem& problem = error.problems().front();
      problems.push_back(
          {runs.size() == 1 ? problem.message : in_panel(scene, i, problem.message), problem.place});
    }
  }
  if (!problems.empty()) throw Error(ExitCode::numerical, std::move(problems));
}

std::vector<Trajectory> simulate_film(const PreparedFilm& film, const std::vector<double>& times) {
  std::vector<Trajectory> runs;
  for (const PreparedScene& panel : film.panels) {
    runs.push_back(simulate_audited(panel.simulation, times, [](double) { return interrupted(); }));
    throw_if_interrupted();
  }
  return runs;
}

namespace {

// Of the frames; where events ended all runs, the last frame stands at the last of them.
std::vector<double> shown_times(const std::vector<Trajectory>& runs, const std::vector<double>& times,
                                int frames) {
  std::vector<double> shown(times.begin(), times.begin() + frames);
  double end = 0;
  for (const Trajectory& run : runs) {
    if (run.ending_event < 0) return shown;
    end = std::max(end, run.end_time);
  }
  for (double& time : shown) time = std::min(time, end);
  return shown;
}

}  // namespace

Film film_of(const PreparedFilm& film, const std::vector<Trajectory>& runs, const std::vector<double>& times,
             int frames, const Fonts& fonts, const FilmClock& clock) {
  std::vector<PanelRun> panels;
  for (std::size_t i = 0; i < runs.size(); ++i)
    panels.push_back(
        {film.panels[i].scene, film.panels[i].simulation.chain, runs[i], &film.panels[i].simulation,
         film.panels[i].shapes.get()});
  return Film(film.scene, panels, shown_times(runs, times, frames), fonts, clock);
}

Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts) {
  Canvas canvas(width, height, fonts);
  Image image;
  canvas.draw(picture, image);
  return image;
}

const OutputFormat& picture_format_of(const std::string& path) {
  if (const OutputFormat* format = find_output_format(path, Shows::still)) return *format;
  const auto is_picture = [](const OutputFormat& row) { return row.shows == Shows::still; };
  throw Error(ExitCode::usage, "-o " + path + ": pictures are written as " + endings_of(is_picture, "or"));
}

void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite, const ClipMemory& memory) {
  OutputFile output(path, overwrite);
  picture_format_of(path).write_still(
      output, {[&] { return picture; }, [&] { return rasterise(picture, width, height, fonts); }, fonts}, memory);
  throw_if_interrupted();
  output.commit();
}

}  // namespace chainreel

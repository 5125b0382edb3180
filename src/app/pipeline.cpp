#include "app/pipeline.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "app/automatic.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/signals.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "encode/png.hpp"
#include "encode/video_writer.hpp"
#include "render/canvas.hpp"
#include "scene/panels.hpp"
#include "scene/prepare.hpp"
#include "scene/read_scene.hpp"

namespace chainreel {

namespace {

PreparedScene prepare_panel(Scene scene, bool meshes) {
  PreparedScene prepared{std::move(scene), {}, {}};
  prepared.simulation = prepare(prepared.scene, meshes);
  choose_automatically(prepared);
  return prepared;
}

// Every panel is prepared, so that all problems are told at once; what several panels share is told once.
std::vector<PreparedScene> prepare_panels(const std::vector<Scene>& scenes, bool meshes) {
  std::vector<PreparedScene> panels;
  std::set<std::string> seen;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const Scene& scene : scenes) {
    try {
      panels.push_back(prepare_panel(scene, meshes));
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

PreparedFilm load_film(const std::string& path, const std::vector<std::string>& overrides, bool meshes) {
  PreparedFilm film{read_scene(path, overrides), {}};
  if (film.scene.compare.empty()) {
    film.panels.push_back(prepare_panel(std::move(film.scene), meshes));
    film.scene = film.panels.front().scene;
    return film;
  }
  film.panels = prepare_panels(film.scene.compare, meshes);
  for (std::size_t i = 0; i < film.panels.size(); ++i) film.scene.compare[i] = film.panels[i].scene;
  name_panels(film.scene.compare);
  for (std::size_t i = 0; i < film.panels.size(); ++i)
    film.panels[i].scene.title = film.scene.compare[i].title;
  return film;
}

PreparedScene load_scene(const std::string& path, const std::vector<std::string>& overrides, bool meshes) {
  Scene scene = read_scene(path, overrides);
  require_single_run(scene);
  PreparedScene prepared = prepare_panel(std::move(scene), meshes);
  prepared.simulation.events = nullptr;
  return prepared;
}

std::vector<double> frame_times(const Scene& scene) {
  std::vector<double> times(std::size_t(frame_count(scene.duration, scene.video.fps)));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = frame_time(int(k), scene.video.fps);
  return times;
}

namespace {

std::string in_panel(const Scene& scene, std::size_t i, const std::string& message) {
  return "panel " + std::to_string(i + 1) + " (" + scene.title + "): " + message;
}

}  // namespace

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
    runs.push_back(simulate(panel.simulation, times, [](double) { return interrupted(); }));
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
             int frames, const Fonts& fonts) {
  std::vector<PanelRun> panels;
  for (std::size_t i = 0; i < runs.size(); ++i)
    panels.push_back(
        {film.panels[i].scene, film.panels[i].simulation.chain, runs[i], &film.panels[i].simulation});
  return Film(film.scene, panels, shown_times(runs, times, frames), fonts);
}

namespace {

// A film ends with the last of its runs; one that is to diverge is shown to stand still behind that.
int frames_shown(const PreparedFilm& film, const std::vector<Trajectory>& runs, int frames) {
  int shown = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool stands = runs[i].status == RunStatus::diverged && film.panels[i].scene.expect == "diverge";
    shown = std::max(shown, stands ? frames : runs[i].size());
  }
  return shown;
}

void film_to_video(const Film& film, const Scene& scene, const Fonts& fonts, VideoWriter& writer, bool quiet,
                   StageSeconds& seconds) {
  Stopwatch watch;
  Canvas canvas(scene.video.width, scene.video.height, fonts);
  canvas.set_static_layer(film.static_layer());
  seconds.render += watch.lap();

  Progress progress(scene.name, film.frame_count(), quiet);
  Image image;
  for (int k = 0; k < film.frame_count(); ++k) {
    throw_if_interrupted();
    watch.lap();
    const Picture picture = film.frame(k);
    seconds.draw += watch.lap();
    canvas.draw(picture, image);
    seconds.render += watch.lap();
    writer.write(image);
    seconds.encode += watch.lap();
    progress.update(k + 1);
  }
  watch.lap();
  writer.finish();
  seconds.encode += watch.lap();
}

// Runs that a limit stopped: no failure, but not what one may think either.
void tell_of_stops(const PreparedFilm& film, const std::vector<Trajectory>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].trouble.empty() || !is_complete(runs[i].status)) continue;
    const std::string text = "stopped: " + runs[i].trouble;
    std::fprintf(stderr, "%s: %s\n", film.scene.name.c_str(),
                 runs.size() == 1 ? text.c_str() : in_panel(film.panels[i].scene, i, text).c_str());
  }
}

}  // namespace

RenderResult render_film(const PreparedFilm& film, const std::string& video_path, bool overwrite,
                         bool quiet) {
  const Scene& scene = film.scene;
  RenderResult result;
  result.video = video_path;
  result.sidecar = std::filesystem::path(video_path).replace_extension(".json").string();
  OutputFile video(result.video, overwrite);
  OutputFile sidecar(result.sidecar, overwrite);

  Stopwatch total, watch;
  const std::vector<double> times = frame_times(scene);
  const std::vector<Trajectory> runs = simulate_film(film, times);
  result.seconds.simulate = watch.lap();
  if (std::any_of(runs.begin(), runs.end(), [](const Trajectory& run) { return run.size() == 0; }))
    require_expected_ends(film, runs);

  const Fonts fonts;
  result.frames = frames_shown(film, runs, int(times.size()));
  const Film pictures = film_of(film, runs, times, result.frames, fonts);
  result.seconds.draw += watch.lap();
  {
    VideoWriter writer(video.temporary_path(), {scene.video.width, scene.video.height, scene.video.fps});
    film_to_video(pictures, scene, fonts, writer, quiet, result.seconds);
  }
  result.film_seconds = frame_time(result.frames, scene.video.fps);
  result.seconds.total = total.lap();
  result.audit = film_report(film, runs, pictures, result.seconds);

  const std::string text = result.audit.dump(2) + "\n";
  try {
    require_expected_ends(film, runs);
  } catch (const Error&) {
    video.keep_as_partial();
    throw;
  }
  if (!quiet) tell_of_stops(film, runs);
  video.commit();
  write_whole(sidecar, text);
  return result;
}

Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts) {
  Canvas canvas(width, height, fonts);
  Image image;
  canvas.draw(picture, image);
  return image;
}

void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite) {
  OutputFile output(path, overwrite);
  write_png(output.temporary_path(), rasterise(picture, width, height, fonts));
  output.commit();
}

}  // namespace chainreel

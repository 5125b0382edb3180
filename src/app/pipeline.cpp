#include "app/pipeline.hpp"

#include <cstdio>
#include <filesystem>

#include "app/automatic.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/signals.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"
#include "draw/film.hpp"
#include "encode/png.hpp"
#include "encode/video_writer.hpp"
#include "render/canvas.hpp"
#include "scene/prepare.hpp"
#include "scene/read_scene.hpp"

namespace chainreel {

PreparedScene load_scene(const std::string& path, const std::vector<std::string>& overrides, bool meshes) {
  PreparedScene prepared{read_scene(path, overrides), {}, {}};
  prepared.simulation = prepare(prepared.scene, meshes);
  choose_automatically(prepared);
  return prepared;
}

std::vector<double> frame_times(const Scene& scene) {
  std::vector<double> times(std::size_t(frame_count(scene.duration, scene.video.fps)));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = frame_time(int(k), scene.video.fps);
  return times;
}

void require_finished(const Trajectory& trajectory, const Scene& scene) {
  throw_if_interrupted();
  if (is_complete(trajectory.status)) return;
  throw Error(ExitCode::numerical,
              trajectory.trouble + " with " + method_text(scene) + ": try a smaller step or another method",
              {scene.file});
}

namespace {

// Draws, renders and encodes the frames that the trajectory holds.
void film_to_video(const PreparedScene& prepared, const Trajectory& trajectory, VideoWriter& writer,
                   bool quiet, StageSeconds& seconds) {
  const Scene& scene = prepared.scene;
  const int frames = trajectory.size();
  Stopwatch watch;
  const Fonts fonts;
  const Film film(scene, prepared.simulation.chain, trajectory, frames, fonts);
  seconds.draw += watch.lap();
  Canvas canvas(scene.video.width, scene.video.height, fonts);
  canvas.set_static_layer(film.static_layer());
  seconds.render += watch.lap();

  Progress progress(scene.name, frames, quiet);
  Image image;
  for (int k = 0; k < frames; ++k) {
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

}  // namespace

RenderResult render_film(const PreparedScene& prepared, const std::string& video_path, bool overwrite,
                         bool quiet) {
  const Scene& scene = prepared.scene;
  RenderResult result;
  result.video = video_path;
  result.sidecar = std::filesystem::path(video_path).replace_extension(".json").string();
  OutputFile video(result.video, overwrite);
  OutputFile sidecar(result.sidecar, overwrite);

  Stopwatch total, watch;
  const Trajectory trajectory =
      simulate(prepared.simulation, frame_times(scene), [](double) { return interrupted(); });
  throw_if_interrupted();
  result.seconds.simulate = watch.lap();
  if (trajectory.size() == 0) require_finished(trajectory, scene);

  {
    VideoWriter writer(video.temporary_path(), {scene.video.width, scene.video.height, scene.video.fps});
    film_to_video(prepared, trajectory, writer, quiet, result.seconds);
  }
  result.frames = trajectory.size();
  result.film_seconds = frame_time(result.frames, scene.video.fps);
  result.seconds.total = total.lap();
  result.audit =
      audit_report(prepared, trajectory, audit_of(prepared.simulation, trajectory), result.seconds);

  const std::string text = result.audit.dump(2) + "\n";
  if (!is_complete(trajectory.status)) {
    video.keep_as_partial();
    require_finished(trajectory, scene);
  }
  if (!trajectory.trouble.empty() && !quiet)
    std::fprintf(stderr, "%s: stopped: %s\n", scene.name.c_str(), trajectory.trouble.c_str());
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

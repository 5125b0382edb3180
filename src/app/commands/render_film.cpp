#include "app/commands/render_film.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "app/cli/streams.hpp"
#include "app/film/progress.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/report.hpp"
#include "app/report/sidecar.hpp"
#include "app/report/trajectory_csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/output_file.hpp"
#include "encode/png.hpp"
#include "render/canvas.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// One target on its way: where it is written, and for clips what takes its frames.
struct Output {
  Target target;
  std::vector<std::unique_ptr<OutputFile>> files;  // one, or a table a panel, or none of a sequence
  std::unique_ptr<OutputFolder> folder;
  std::unique_ptr<FrameSink> sink;
};

struct SequencePlace {
  std::string folder, stem;  // stem: all before the six digits
};

SequencePlace place_of_sequence(const std::string& path) {
  const fs::path file(path);
  const std::string name = file.stem().string();
  return {file.parent_path().string(), name.substr(0, name.size() - 6)};
}

// What sidecars of a target are named after.
std::string base_of(const Target& target) {
  if (!target.format->is_sequence) return fs::path(target.path).replace_extension().string();
  SequencePlace place = place_of_sequence(target.path);
  while (place.stem.ends_with('_')) place.stem.pop_back();
  return (fs::path(place.folder) / (place.stem.empty() ? "frames" : place.stem)).string();
}

std::vector<Output> open_outputs(const RenderJob& job, std::size_t panels) {
  std::vector<Output> outputs;
  for (const Target& target : job.targets) {
    Output output{target, {}, {}, {}};
    if (target.is_implied) require_own_sidecar(target.path, job.overwrite);
    if (target.format->is_sequence) {
      const SequencePlace place = place_of_sequence(target.path);
      output.folder = std::make_unique<OutputFolder>(place.folder, place.stem, ".png", job.overwrite);
    } else if (target.format->shows == Shows::table) {
      for (std::size_t i = 0; i < panels; ++i)
        output.files.push_back(
            std::make_unique<OutputFile>(panel_csv_path(target.path, i, panels == 1), job.overwrite));
    } else {
      output.files.push_back(std::make_unique<OutputFile>(target.path, job.overwrite));
    }
    outputs.push_back(std::move(output));
  }
  return outputs;
}

std::unique_ptr<FrameSink> sink_of(const Output& output, const Scene& scene, const Tags& tags) {
  const OutputFormat& format = *output.target.format;
  if (format.make_sink == nullptr) return nullptr;
  const VideoSettings settings{.width = scene.video.width,
                               .height = scene.video.height,
                               .fps = scene.video.fps,
                               .crf = scene.video.crf,
                               .alpha = is_transparent(scene),
                               .tags = tags};
  return format.is_sequence ? format.make_sink(format, output.folder->temporary_folder(),
                                               place_of_sequence(output.target.path).stem, settings)
                            : format.make_sink(format, output.files.front()->temporary_path(), {}, settings);
}

// How often each frame is shown.
struct Schedule {
  int frames = 0, first = 0, last = 0;  // drawn, held

  int total() const { return frames + first + last; }
  int shown(int k) const { return 1 + (k == 0 ? first : 0) + (k == frames - 1 ? last : 0); }
};

// The whole picture of a frame, for pages of shapes.
Picture picture_of(const Film& film, int frame) {
  Picture picture = film.static_layer();
  picture.append(film.frame(frame));
  return picture;
}

bool shows(const Output& output, Shows what) {
  return output.target.format->shows == what;
}

// All frames that some output needs, each drawn and rasterised once.
void draw_film(const Film& film, const Scene& scene, const Fonts& fonts, std::vector<Output>& outputs,
               const Schedule& schedule, int still, const ClipMemory& memory, bool quiet,
               StageSeconds& seconds) {
  Stopwatch watch;
  const auto any = [&](Shows what) {
    return std::any_of(outputs.begin(), outputs.end(), [&](const Output& output) { return shows(output, what); });
  };
  const bool has_clips = any(Shows::motion);
  if (!has_clips && !any(Shows::still)) return;
  Canvas canvas(scene.video.width, scene.video.height, fonts);
  canvas.set_static_layer(film.static_layer());
  for (Output& output : outputs) output.sink = sink_of(output, scene, memory.tags());
  seconds.render += watch.lap();

  Progress progress(scene.name, film.frame_count(), quiet);
  Image image;
  for (int k = has_clips ? 0 : still; k < (has_clips ? schedule.frames : still + 1); ++k) {
    throw_if_interrupted();
    watch.lap();
    const Picture picture = film.frame(k);
    seconds.draw += watch.lap();
    canvas.draw(picture, image);
    seconds.render += watch.lap();
    for (Output& output : outputs) {
      if (output.sink)
        for (int i = 0; i < schedule.shown(k); ++i) output.sink->write(image);
      if (k == still && shows(output, Shows::still))
        output.target.format->write_still(
            *output.files.front(), {[&] { return picture_of(film, k); }, [&] { return image; }, fonts}, memory);
    }
    seconds.encode += watch.lap();
    progress.update(k + 1);
  }
  watch.lap();
  for (Output& output : outputs)
    if (output.sink) output.sink->finish();
  for (Output& output : outputs) output.sink.reset();
  seconds.encode += watch.lap();
}

void write_tables(const Runs& runs, std::vector<Output>& outputs) {
  for (Output& output : outputs)
    if (shows(output, Shows::table))
      for (std::size_t i = 0; i < runs.size(); ++i)
        write_temporary(*output.files[i], trajectory_csv(runs.film().panels[i].simulation.chain, runs[i]));
}

void keep_partial(std::vector<Output>& outputs) {
  for (Output& output : outputs)
    if (!shows(output, Shows::still))
      for (auto& file : output.files) file->keep_as_partial();
}

// Runs that a limit stopped: no failure, but not what one may think either.
void tell_of_stops(const Runs& runs) {
  const PreparedFilm& film = runs.film();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].trouble.empty() || !is_complete(runs[i].status)) continue;
    const std::string text = "stopped: " + runs[i].trouble;
    std::fprintf(stderr, "%s: %s\n", film.scene.name.c_str(),
                 runs.size() == 1 ? text.c_str() : in_panel(film.panels[i].scene, i, text).c_str());
  }
}

// Slow motion about an event that never comes is none, which its author may want to know.
void tell_of_missing_events(const Runs& runs) {
  const PreparedFilm& film = runs.film();
  const std::vector<EventEntry>& events = film.panels.front().scene.events;
  for (const SlowMotionEntry& entry : film.scene.slow_motion) {
    const auto is_its = [&](int event) { return events[std::size_t(event)].title() == entry.event; };
    const std::vector<int>& hits = runs[0].events.event;
    if (!entry.event.empty() && std::none_of(hits.begin(), hits.end(), is_its))
      std::fprintf(stderr, "%s: no slow motion about '%s', which does not happen\n", film.scene.name.c_str(),
                   entry.event.c_str());
  }
}

// For LaTeX's package animate, which takes a frame rate as a number and frames by their first and last.
std::string animate_snippet(const Target& target, int frames, FrameRate fps) {
  const SequencePlace place = place_of_sequence(target.path);
  const std::string folder = fs::path(place.folder).filename().string();
  const auto digits = [](int frame) { return PngSequence::file_name("", frame).substr(0, 6); };
  return "% \\usepackage{animate} in the preamble; paths as found from the folder that holds " + folder +
         "/\n\\animategraphics[autoplay,loop,width=\\linewidth]{" + format_shortest(fps.value()) + "}{" +
         folder + "/" + place.stem + "}{" + digits(0) + "}{" + digits(frames - 1) + "}\n";
}

struct Sidecar {
  std::unique_ptr<OutputFile> file;
  enum { audit, words, captions, animate } what;
  Target target;
};

// Beside each clip, or beside the first file where there is none; clips of one name share theirs.
std::vector<Sidecar> open_sidecars(const RenderJob& job, const PreparedFilm& film) {
  std::vector<Sidecar> sidecars;
  const bool has_clips = std::any_of(job.targets.begin(), job.targets.end(),
                                     [](const Target& target) { return target.format->shows == Shows::motion; });
  const bool has_events = std::any_of(film.panels.begin(), film.panels.end(),
                                      [](const PreparedScene& panel) { return !panel.scene.events.empty(); });
  std::set<std::string> seen;
  for (const Target& target : job.targets) {
    if (has_clips && target.format->shows != Shows::motion) continue;
    const std::string base = base_of(target);
    const auto open = [&](const char* ending, auto what) {
      require_own_sidecar(base + ending, job.overwrite);
      sidecars.push_back({std::make_unique<OutputFile>(base + ending, job.overwrite), what, target});
    };
    if (target.format->is_sequence) open(".tex", Sidecar::animate);
    if (!seen.insert(base).second || (!has_clips && seen.size() > 1)) continue;
    open(".json", Sidecar::audit);
    open(".txt", Sidecar::words);
    if (has_events) open(".srt", Sidecar::captions);
  }
  return sidecars;
}

std::string sidecar_text(const Sidecar& sidecar, const FilmReport& report) {
  switch (sidecar.what) {
    case Sidecar::words:
      return alt_text(report);
    case Sidecar::captions:
      return captions(report);
    case Sidecar::audit:
    case Sidecar::animate:
      break;
  }
  return animate_snippet(sidecar.target, report.frames, report.film().scene.video.fps);
}

// Texts first: each audit tells of those beside it.
void write_sidecars(std::vector<Sidecar>& sidecars, const FilmReport& report, RenderResult& result) {
  std::map<fs::path, Json> hashes;  // by NAME.json
  for (Sidecar& sidecar : sidecars) {
    if (sidecar.what == Sidecar::audit) continue;
    const std::string text = sidecar_text(sidecar, report);
    if (text.empty()) continue;  // no event came
    write_whole(*sidecar.file, text);
    const fs::path path(sidecar.file->path());
    hashes[fs::path(path).replace_extension(".json")][path.extension().string()] = sha256_of(text);
  }
  for (Sidecar& sidecar : sidecars) {
    if (sidecar.what != Sidecar::audit) continue;
    Json audit = result.audit;
    audit[kSidecarHashes] = hashes[sidecar.file->path()];
    write_whole(*sidecar.file, audit.dump(2) + "\n");
  }
  for (const Sidecar& sidecar : sidecars)
    if (sidecar.file->is_done()) result.sidecars.push_back(sidecar.file->path());
}

void commit(std::vector<Output>& outputs, RenderResult& result) {
  for (Output& output : outputs) {
    for (auto& file : output.files) {
      file->commit();
      result.files.push_back(file->path());
    }
    if (!output.folder) continue;
    output.folder->commit();
    result.files.push_back(output.target.path);
  }
}

Json to_json(const StageSeconds& seconds) {
  return {{"simulate", seconds.simulate},
          {"draw", seconds.draw},
          {"render", seconds.render},
          {"encode", seconds.encode},
          {"total", seconds.total}};
}

}  // namespace

RenderResult render_film(const PreparedFilm& film, const RenderJob& job) {
  const Scene& scene = film.scene;
  std::vector<Output> outputs = open_outputs(job, film.panels.size());
  std::vector<Sidecar> sidecars = open_sidecars(job, film);

  RenderResult result;
  Stopwatch total, watch;
  const Runs runs(film);
  result.seconds.simulate = watch.lap();
  if (std::any_of(runs.list().begin(), runs.list().end(), [](const Trajectory& run) { return run.size() == 0; }))
    runs.require_expected_ends();

  const Fonts fonts;
  const FrameRate fps = scene.video.fps;
  const Schedule schedule{runs.frames_shown(runs.clock().frame_count()), frame_count(scene.hold.first, fps),
                          frame_count(scene.hold.last, fps)};
  const Film pictures = runs.pictures(schedule.frames, fonts);
  result.frames = schedule.total();
  result.film_seconds = frame_time(result.frames, fps);
  const FilmReport report = film_report(runs, pictures, result.frames);
  ClipMemory memory = memory_of(report);
  if (schedule.first > 0 || schedule.last > 0)
    memory.audit["held_frames"] = {{"first", schedule.first}, {"last", schedule.last}};
  result.seconds.draw += watch.lap();

  const int still = std::clamp(runs.clock().frame_at(job.at), 0, schedule.frames - 1);
  draw_film(pictures, scene, fonts, outputs, schedule, still, memory, job.quiet,
            result.seconds);
  write_tables(runs, outputs);
  result.seconds.total = total.lap();
  result.audit = to_json(report);
  if (memory.audit.contains("held_frames")) result.audit["held_frames"] = memory.audit["held_frames"];
  result.audit["seconds"] = to_json(result.seconds);

  try {
    runs.require_expected_ends();
  } catch (const Error& error) {
    if (error.code() == ExitCode::numerical) keep_partial(outputs);  // a signal leaves nothing
    throw;
  }
  tell_warnings(warning_lines(report));
  if (!job.quiet) {
    tell_of_stops(runs);
    tell_of_missing_events(runs);
  }
  commit(outputs, result);
  write_sidecars(sidecars, report, result);
  return result;
}

}  // namespace chainreel

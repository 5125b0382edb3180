// chainreel bench SCENE...: what each stage of a film takes, beside its encoder alone

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/works/render_film.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/machine.hpp"
#include "core/parallel.hpp"
#include "core/stage_clock.hpp"
#include "core/temporary_file.hpp"
#include "draw/page/house_style.hpp"
#include "encode/film_chunk.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct BenchOptions {
  std::vector<std::string> scenes;
  int jobs = 0, rounds = 1;
  int memory = 3000;  // MB
  CommonOptions common;
};

// What was measured of one film. The floor: the same encoders on the same frames from memory, in the same chunks, by as many
// threads. One encoder: what other recorders take for these frames at least.
struct MeasuredFilm {
  int frames = 0, film_frames = 0, jobs = 0, chunks = 0;
  StageTime prepare;  // scene and model read, method chosen
  StageTimes stages;
  StageTime whole, floor, one_encoder;  // cpu: of the whole process

  StageTime rest() const {
    StageTime rest = whole;
    for (const StageTime& stage :
         {prepare, stages.simulate, stages.draw, stages.render, stages.convert, stages.encode, stages.mux})
      rest -= stage;
    return rest;
  }
};

// Frames up to the last bound at which they fit; at least one chunk.
int frames_that_fit(const std::vector<int>& bounds, double bytes_of_frame, double bytes) {
  int frames = bounds[std::min<std::size_t>(1, bounds.size() - 1)];
  for (const int bound : bounds)
    if (bound * bytes_of_frame <= bytes) frames = std::max(frames, bound);
  return frames;
}

// The frames as encoders take them, a tape a chunk.
std::vector<ChunkTape> tapes_of(const PreparedFilm& film, const Runs& runs, const Target& target, FrameRange range, int jobs) {
  const Fonts fonts(families_of(film.scene));
  const Schedule schedule = schedule_of(runs);
  const Film pictures = runs.pictures(schedule.frames, fonts);
  const ClipMemory memory;
  std::vector<Output> outputs = open_outputs({target}, film.panels.size(), true, false);
  std::vector<ChunkTape> tapes;
  FilmWork work{pictures, film.scene, fonts, schedule, 0, 0, memory, range, "", "", jobs, true};
  work.tapes = &tapes;
  StageTimes unused;
  draw_film(work, outputs, unused);
  return tapes;
}

void encode(const std::vector<ChunkTape>& tapes, const VideoSettings& settings, int jobs) {
  for_each_index(tapes.size(), std::min(jobs, int(tapes.size())), [&](std::size_t index) {
    throw_if_interrupted();
    ChunkEncoder encoder(settings);
    encoder.play(tapes[index]);
    encoder.finish();
  });
}

StageTime ratio(const StageTime& time, const StageTime& to) {
  return {time.cpu / to.cpu, time.wall / to.wall};
}

void keep_least(StageTime& least, const StageTime& now, bool is_first) {
  least = is_first ? now : StageTime{std::min(least.cpu, now.cpu), std::min(least.wall, now.wall)};
}

MeasuredFilm measure(const std::string& path, const BenchOptions& options, Scene& scene) {
  MeasuredFilm measured;
  ProcessClock clock;
  StageClock own;
  const PreparedFilm film = load_film(path, overrides_of(options.common), true, true);
  if (is_transparent(film.scene)) {
    const bool is_overlay = film.scene.video.preset == Preset::overlay;
    throw Error(ExitCode::usage, path + ": is measured as .mp4, which has no opacity: take" +
                                     (is_overlay ? " --set video.preset=slides" : "") +
                                     (film.scene.layout == PageLayout::transparent ? " --set layout=auto" : ""));
  }
  measured.prepare = own.lap();
  const StageTime prepared = clock.lap();
  scene = film.scene;

  // What it writes is not wanted: it lies in a hidden folder for as long.
  const TemporaryFile folder(TemporaryFile::Kind::coming_folder, fs::temp_directory_path().string(), "", "the film to be measured",
                             "set TMPDIR to a folder that can be written");
  RenderJob job;
  job.targets = {target_of(folder.path() + "/film.mp4")};
  job.jobs = options.jobs;
  job.overwrite = true;
  job.quiet = options.common.quiet;

  const Runs runs(film);
  const VideoSettings settings = settings_of(*job.targets.front().format, film.scene, {});
  measured.film_frames = schedule_of(runs).total();
  const std::vector<int> bounds = chunk_bounds(measured.film_frames, film.scene.video.fps, settings.codec);
  const double room = std::min(1e6 * options.memory, memory_limit() / 2);
  measured.frames = frames_that_fit(bounds, ChunkTape::bytes_of_frame(settings), room);
  if (measured.frames < measured.film_frames) job.part = PartRequest::of_frames("0:" + std::to_string(measured.frames));

  std::vector<ChunkTape> tapes;
  StageTime whole;
  for (int round = 0; round < options.rounds; ++round) {
    clock.lap();
    const RenderResult result = render_film(film, job);
    const StageTime now = clock.lap();
    if (round == 0 || now.wall < whole.wall) measured.stages = result.times;
    keep_least(whole, now, round == 0);
    measured.jobs = result.jobs;
    if (tapes.empty())
      tapes = tapes_of(film, runs, target_of(folder.path() + "/tape.mp4"), {0, measured.frames}, result.jobs);
    clock.lap();
    encode(tapes, settings, result.jobs);
    keep_least(measured.floor, clock.lap(), round == 0);
    throw_if_interrupted();
    encode_by_preset(tapes, settings, result.jobs);
    keep_least(measured.one_encoder, clock.lap(), round == 0);
  }
  measured.chunks = int(tapes.size());
  measured.jobs = std::min(measured.jobs, measured.chunks);
  measured.whole = whole;
  measured.whole += prepared;
  return measured;
}

struct StageRow {
  const char* name;
  const char* told;
  StageTime time;
};

std::vector<StageRow> rows_of(const MeasuredFilm& measured) {
  const StageTimes& s = measured.stages;
  return {{"prepare", "prepare (scene, model, method)", measured.prepare},
          {"simulate", "simulate", s.simulate},
          {"shapes", "draw: shapes", s.draw},
          {"pixels", "draw: pixels", s.render},
          {"convert", "convert", s.convert},
          {"encode", "encode", s.encode},
          {"mux", "mux", s.mux},
          {"rest", "all else", measured.rest()}};
}

Json time_json(const StageTime& time) {
  return {{"cpu", time.cpu}, {"wall", time.wall}};
}

Json stages_json(const MeasuredFilm& measured, const Scene& scene) {
  Json stages;
  for (const StageRow& row : rows_of(measured)) {
    stages[row.name] = {{"cpu_ms", 1e3 * row.time.cpu / measured.frames}};
    if (std::string(row.name) != "rest") stages[row.name]["wall_ms"] = 1e3 * row.time.wall / measured.frames;
  }
  return {{"scene", scene.name},
          {"width", scene.video.width},
          {"height", scene.video.height},
          {"fps", scene.video.fps.value()},
          {"frames", measured.frames},
          {"film_frames", measured.film_frames},
          {"chunks", measured.chunks},
          {"jobs", measured.jobs},
          {"stages", stages},
          {"whole", time_json(measured.whole)},
          {"encoder_alone", time_json(measured.floor)},
          {"one_encoder", time_json(measured.one_encoder)},
          {"ratio", time_json(ratio(measured.whole, measured.floor))},
          {"ratio_to_one_encoder", time_json(ratio(measured.whole, measured.one_encoder))}};
}

void print_stages(const MeasuredFilm& measured, const Scene& scene) {
  const auto counted = [](int count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  std::printf("%s: %s of %dx%d at %s fps, %s, %s\n", scene.name.c_str(), counted(measured.frames, "frame").c_str(),
              scene.video.width, scene.video.height, format_significant(scene.video.fps.value(), 4).c_str(),
              counted(measured.chunks, "chunk").c_str(), counted(measured.jobs, "thread").c_str());
  if (measured.frames < measured.film_frames)
    std::printf("of its %d: so many fit into memory for the encoder alone (--memory)\n", measured.film_frames);
  const auto milliseconds = [&](double seconds) { return format_fixed(1e3 * seconds / measured.frames, 3); };
  std::vector<std::vector<std::string>> table{{"stage", "CPU ms a frame", "wall ms a frame"}};
  for (const StageRow& row : rows_of(measured))
    table.push_back({row.told, milliseconds(row.time.cpu), std::string(row.name) == "rest" ? "" : milliseconds(row.time.wall)});
  table.push_back({"whole film", milliseconds(measured.whole.cpu), milliseconds(measured.whole.wall)});
  table.push_back({"encoder alone", milliseconds(measured.floor.cpu), milliseconds(measured.floor.wall)});
  table.push_back({"one encoder, x264 veryfast", milliseconds(measured.one_encoder.cpu), milliseconds(measured.one_encoder.wall)});
  std::fputs(table_text(table).c_str(), stdout);
  const auto print_ratio = [&](const char* what, const StageTime& floor) {
    const StageTime times = ratio(measured.whole, floor);
    std::printf("%.2f s, %s %.2f s: %.2f times as long, %.2f times its CPU time\n", measured.whole.wall, what, floor.wall, times.wall,
                times.cpu);
  };
  print_ratio("the encoder alone", measured.floor);
  print_ratio("x264 as its preset has it", measured.one_encoder);
  std::printf("\n");
  std::fflush(stdout);
}

void run_bench(const BenchOptions& options) {
  Json all = Json::array();
  std::vector<std::vector<std::string>> table{{"film", "frames", "ours s", "encoder s", "ratio", "ratio of CPU", "one encoder s", "ratio to it"}};
  for (const std::string& path : options.scenes) {
    Scene scene;
    const MeasuredFilm m = measure(path, options, scene);
    all.push_back(stages_json(m, scene));
    if (options.common.json) continue;
    print_stages(m, scene);
    table.push_back({scene.name, std::to_string(m.frames), format_fixed(m.whole.wall, 2), format_fixed(m.floor.wall, 2),
                     format_fixed(m.whole.wall / m.floor.wall, 2), format_fixed(m.whole.cpu / m.floor.cpu, 2), format_fixed(m.one_encoder.wall, 2),
                     format_fixed(m.whole.wall / m.one_encoder.wall, 2)});
  }
  tell_result(options.common, [&] { return Json{{"films", all}}; }, [&] {
    if (options.scenes.size() > 1) std::fputs(table_text(table).c_str(), stdout);
  });
}

}  // namespace

void add_bench_command(CommandLine& app) {
  auto options = std::make_shared<BenchOptions>();
  Command* command = app.add_subcommand(
      "bench", "what each stage of rendering a scene to .mp4 takes, beside its encoder alone on the same frames");
  command->add_option("scenes", options->scenes, "scene files").required().names_input();
  command->add_option("--jobs", options->jobs, "threads, of the film and of the encoder alone (default: all cores)").range(1, 256);
  command->add_option("--rounds", options->rounds, "how often both are measured by turns; the least counts (default 1)")
      .range(1, 1000);
  command->add_option("--memory", options->memory,
                      "MB that the frames may take which the encoder alone gets, at most half of what there is: of longer "
                      "films the first chunks are measured (default 3000)")
      .range(1, 1000000);
  add_scene_options(*command, options->common);
  add_json_option(*command, options->common);
  add_quiet_option(*command, options->common);
  command->footer(
      "Times of stages are of all threads together; the processor's (CPU) are those of the threads themselves, all else holds what\n"
      "the renderer's own threads took. The encoder alone: as films are made, in chunks by an encoder each; one encoder: x264's preset\n"
      "veryfast at the film's quality with as many threads of its own, as other recorders have it. Files are written to a folder that goes, in TMPDIR.\n"
      "Example: chainreel bench rr_torque --set video.width=1920 --set video.height=1080");
  command->callback([options] { run_bench(*options); });
}

}  // namespace chainreel

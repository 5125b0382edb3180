// chainreel render SCENE... [-o FILE]... | [-o DIR]

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/film/automatic.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/report.hpp"
#include "app/works/render_film.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "encode/small_frames.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> outputs;
  std::string at = "0";
  std::vector<std::string> vary;
  int jobs = 0;
  std::string frames, shard;
  bool resume = false;
  CommonOptions common;
};

std::vector<std::string> overrides_of(const RenderOptions& options, const std::string& scene) {
  std::vector<std::string> overrides = overrides_of(options.common);
  add_comparison(options.vary, scene, options.common.quiet, overrides);
  return overrides;
}

// Every scene is read before the first is rendered, so that bad input costs no time and loses nothing.
std::vector<PreparedFilm> load_all(const RenderOptions& options) {
  std::vector<PreparedFilm> films;
  std::vector<Problem> problems;
  ExitCode code = ExitCode::bad_input;
  for (const std::string& scene : options.scenes) {
    try {
      films.push_back(load_film(scene, overrides_of(options, scene), true, options.common.quiet));
      require_varied_read(options.vary, films.back().scene);
    } catch (const Error& error) {
      code = error.code();
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw Error(code, std::move(problems));
  return films;
}

std::optional<PartRequest> part_of(const RenderOptions& options) {
  if (!options.frames.empty() && !options.shard.empty())
    throw Error(ExitCode::usage, "--frames and --shard both say which part of the film: leave one out");
  if (!options.frames.empty()) return PartRequest::of_frames(options.frames);
  if (!options.shard.empty()) return PartRequest::of_shard(options.shard);
  return std::nullopt;
}

// Files that are made of parts: films, and frames one by one.
void make_parts(std::vector<Target>& targets, const PartRequest& part) {
  for (Target& target : targets) {
    if (!target.format->codec && !target.format->is_sequence)
      throw Error(ExitCode::usage, target.path + " cannot be made in parts: take .mp4, .webm, .mov or NAME_000000.png with -o");
    if (!target.format->codec) continue;
    const fs::path path(target.path);
    target.path = (path.parent_path() / (path.stem().string() + part.suffix() + path.extension().string())).string();
  }
}

void require_resumable(const std::vector<Target>& targets) {
  for (const Target& target : targets)
    if (target.format->make_clip != nullptr)
      throw Error(ExitCode::usage, target.path + ": --resume keeps finished chunks, which such a clip has none of: each of its frames "
                                                 "builds on all before it; render it without --resume, or render the film " +
                                       "as .mp4, .webm, .mov or NAME_000000.png");
}

std::vector<RenderJob> jobs_of(const RenderOptions& options, const std::vector<PreparedFilm>& films) {
  std::vector<RenderJob> jobs;
  std::map<std::string, std::string> taken;
  for (std::size_t i = 0; i < films.size(); ++i) {
    RenderJob job;
    job.targets = targets_of(options.outputs, films.size(), films[i].scene);
    job.at = parse_seconds(options.at, "--at");
    job.jobs = options.jobs;
    job.part = part_of(options);
    if (job.part) make_parts(job.targets, *job.part);
    job.resume = options.resume;
    if (job.resume) require_resumable(job.targets);
    job.overwrite = options.common.force;
    job.quiet = options.common.quiet;
    if (!(job.at >= 0 && job.at <= films[i].scene.duration))
      throw Error(ExitCode::usage, "--at " + options.at + " lies outside the duration of " +
                                       format_quantity(films[i].scene.duration, "s"));
    for (const Target& target : job.targets) {
      const auto [other, is_new] =
          taken.emplace(fs::path(target.path).lexically_normal().string(), options.scenes[i]);
      if (!is_new)
        throw Error(ExitCode::usage, options.scenes[i] + " and " + other->second +
                                         " would both be written to " + target.path +
                                         ": render them one by one with -o");
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

// A quality that none of the files has is not what its author thinks.
void tell_of_unused_quality(const RenderJob& job, const Scene& scene) {
  const auto has_quality = [](const Target& target) { return target.format->codec && has_crf(*target.format->codec); };
  if (scene.video.crf && std::none_of(job.targets.begin(), job.targets.end(), has_quality))
    std::fprintf(stderr, "note: %s: video.crf does nothing: none of the files has a quality to choose; .mp4 and .webm do\n",
                 scene.name.c_str());
}

// GIF and APNG are not of the size and rate that the scene asks for: said, and told with the files.
Json small_clips(const RenderJob& job, const PreparedFilm& film, int frames) {
  Json clips = Json::array();
  const Video& video = film.scene.video;
  for (const Target& target : job.targets) {
    if (target.format->make_clip == nullptr) continue;
    const SmallSize size = small_size_of(video.width, video.height, video.fps);
    clips.push_back({{"file", target.path},
                     {"width", size.width},
                     {"height", size.height},
                     {"fps", size.fps.value()},
                     {"frames", size.frames(frames)}});
    const std::string is_width = size.width == video.width ? "" : std::to_string(size.width) + "x" + std::to_string(size.height) + " pixels";
    const std::string is_rate = size.every == 1 ? "" : format_significant(size.fps.value(), 4) + " frames/s";
    if (job.quiet || (is_width.empty() && is_rate.empty())) continue;
    std::fprintf(stderr, "note: %s: %s has %s%s%s, as %s files are %s\n", film.scene.name.c_str(), target.path.c_str(), is_width.c_str(),
                 is_width.empty() || is_rate.empty() ? "" : " and ", is_rate.c_str(), target.format->ending, target.format->told);
  }
  return clips;
}

void run_render(const RenderOptions& options) {
  check_outputs(options.outputs, options.scenes.size());
  const std::vector<PreparedFilm> films = load_all(options);
  std::vector<RenderJob> jobs = jobs_of(options, films);
  if (options.resume) keeps_what_is_finished();

  Json reports = Json::array();
  std::vector<std::vector<std::string>> table{{"scene", "frames", "film s", "taken s", "file"}};
  for (std::size_t i = 0; i < films.size(); ++i) {
    say_choice(films[i].panels, options.common.quiet);
    if (!options.common.quiet) tell_of_unused_quality(jobs[i], films[i].scene);
    RenderResult unfinished;
    jobs[i].unfinished = &unfinished;
    RenderResult result;
    try {
      result = render_film(films[i], jobs[i]);
    } catch (const Error&) {
      if (options.common.json && !unfinished.audit.is_null()) {
        reports.push_back(unfinished.audit);
        reports.back().update(files_json({}));
        print_json({{"films", reports}});
      }
      if (i + 1 < films.size()) std::fprintf(stderr, "note: %s fails, and the %zu behind it are not rendered\n", films[i].scene.name.c_str(), films.size() - i - 1);
      throw;
    }
    reports.push_back(result.audit);
    reports.back().update(files_json(result.files));
    reports.back()["part"] = nullptr;
    if (result.part) reports.back()["part"] = {{"first", result.part->first}, {"behind", result.part->behind}};
    reports.back()["sidecars"] = result.sidecars;
    reports.back()["small_clips"] = small_clips(jobs[i], films[i], result.frames);
    const double film_seconds = result.part ? frame_time(result.frames, films[i].scene.video.fps) : result.film_seconds;
    // Where all files are smaller clips, their own.
    const Json& small = reports.back()["small_clips"];
    const Json frames = small.size() == jobs[i].targets.size() && !small.empty() ? small[0]["frames"] : Json(result.frames);
    const bool is_still = std::ranges::all_of(jobs[i].targets, [](const Target& target) { return target.format->shows == Shows::still; });
    table.push_back({films[i].scene.name, is_still ? "1" : frames.dump(), is_still ? "-" : format_fixed(film_seconds, 2),
                     format_fixed(result.times.total, 2), joined(result.files, " ")});
  }
  tell_result(options.common, [&] { return Json{{"films", reports}}; }, [&] { std::fputs(table_text(table).c_str(), stdout); });
}

}  // namespace

void add_render_command(CommandLine& app) {
  auto options = std::make_shared<RenderOptions>();
  Command* command = app.add_subcommand("render",
                                         "render scenes to films, clips and pictures, each with its audit as "
                                         "NAME.json and in words as NAME.txt");
  command->add_option("scenes", options->scenes, "scene files").required().names_input();
  command->add_repeatable("-o,--output", options->outputs,
      "a .mp4, .webm, .mov, .gif, .apng, .png, .svg, .pdf, .csv or .npz file, or NAME_000000.png for a sequence "
      "(repeatable: each frame is drawn once for all), or a folder (default out/NAME.mp4)");
  for (const FlagGroup flags : {FlagGroup::output, FlagGroup::size, FlagGroup::look, FlagGroup::page, FlagGroup::view})
    add_scene_flags(*command, options->common.flags, flags);
  command->add_option("--at", options->at, "instant that .png, .svg and .pdf show, in seconds (default 0)");
  command->add_option("--jobs", options->jobs, "threads that draw and encode (default: all cores); the bytes are the same")
      .range(1, 256);
  command->add_option("--frames", options->frames,
                      "a part of the film, from frame A to the one before B, like 0:150: NAME.part-000000-000150.mp4, for join");
  command->add_option("--shard", options->shard,
                      "a share of the film, like 3/8, of whole chunks of two seconds at most: NAME.part-3-of-8.mp4; slurm: that of the array job's task");
  command->add_flag("--resume", options->resume,
                    "keep finished chunks of films and sequences in a hidden folder beside them until they are whole, and go on "
                    "from those of a run that was killed");
  add_vary_option(*command, options->vary);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer(
      "Example: chainreel render rr_free -o out/rr.mp4 -o out/rr.gif --set duration=2");
  command->callback([options] { run_render(*options); });
}

}  // namespace chainreel

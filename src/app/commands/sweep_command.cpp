// chainreel sweep SCENE --over KEY=.. [--over ..] -o FOLDER|TABLE.csv: a scene at every point of a grid of its keys.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>

#include "app/cli/command.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/render_film.hpp"
#include "app/commands/sweep_table.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/machine.hpp"
#include "core/parallel.hpp"
#include "render/canvas.hpp"
#include "scene/quantity.hpp"
#include "scene/text/picture_names.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1'000'000;
constexpr std::size_t kMostTold = 5;  // runs that failed

struct SweepOptions {
  std::string scene;
  std::vector<std::string> over, outputs, each;
  std::string at = "0", shard;
  int jobs = 0;
  CommonOptions common;
};

// What each run becomes in the folder.
std::vector<const OutputFormat*> formats_of(const SweepOptions& options) {
  std::vector<const OutputFormat*> formats;
  const auto is_one_file = [](const OutputFormat& row) { return !row.is_sequence; };
  for (const std::string& name : options.each.empty() ? std::vector<std::string>{"mp4"} : options.each) {
    const OutputFormat* format = find_output_format("x." + name);
    if (format == nullptr)
      throw Error(ExitCode::usage, "--each " + name + ": runs become " + endings_of(is_one_file, "or") + ", without the dot");
    formats.push_back(format);
  }
  return formats;
}

// As few digits as tell the axis' values apart, six at least.
std::string value_text(const Sweep& axis, std::size_t k) {
  if (axis.numbers.empty()) return axis.values[k];
  std::set<std::string> seen;
  for (const double number : axis.numbers) seen.insert(format_significant(number, 6));
  return seen.size() == axis.numbers.size() ? format_significant(axis.numbers[k], 6) : format_shortest(axis.numbers[k]);
}

// NAME_KEY_VALUE_KEY_VALUE without an ending.
std::string name_of(const std::string& scene, const Grid& grid, std::size_t run) {
  std::string name = scene;
  const std::vector<std::size_t> at = grid.places(run);
  for (std::size_t i = 0; i < at.size(); ++i) name += "_" + grid.axes()[i].key + "_" + value_text(grid.axes()[i], at[i]);
  return file_name_of(name);
}

// A file that shows this very scene and model already.
bool is_done(const Target& target, const PreparedFilm& film) {
  std::error_code code;
  if (!fs::is_regular_file(target.path, code) || target.format->read_tags == nullptr) return false;
  try {
    const ClipMemory memory = recall(target.path);
    const auto model_hash = [](const Json& json) { return json.value("model_sha256", ""); };
    std::string there = model_hash(memory.audit);
    if (there.empty() && memory.audit.contains("panels")) there = model_hash(memory.audit["panels"].front());
    return memory.scene == placeless_scene_text(film.scene) && there == sha256_of_file(film.panels.front().scene.model);
  } catch (const Error&) {
    return false;
  } catch (const Json::exception&) {
    return false;  // what it says was not written by this program
  }
}

class FilmsOfGrid {
 public:
  FilmsOfGrid(const SweepOptions& options, const Grid& grid, FrameRange runs, std::string folder, int threads)
      : options_(options), grid_(grid), runs_(runs), folder_(std::move(folder)), threads_(threads),
        formats_(formats_of(options)), at_(parse_quantity(options.at, {})) {
    require_names();
  }

  SweepOutcome run() {
    const std::size_t count = std::size_t(runs_.behind - runs_.first);
    fill_by_several_threads(false);  // runs are drawn beside one another
    const int beside = std::max(1, std::min(threads_, int(count)));
    Ticker ticker(options_.common.quiet);
    for_each_index(count, beside, [&](std::size_t k) {
      throw_if_interrupted();
      const std::size_t run = std::size_t(runs_.first) + k;
      try {
        const bool was_done = make(run, std::max(1, threads_ / beside));
        const std::lock_guard guard(lock_);
        ++(was_done ? outcome_.skipped : outcome_.done);
      } catch (const Error& error) {
        throw_if_interrupted();
        // Neither disk nor renderer will be better for the next one.
        if (error.code() == ExitCode::file || error.code() == ExitCode::no_renderer) throw;
        has_failed(run, error.problems().front().message);
      }
      const std::lock_guard guard(lock_);
      if (ticker.is_due())
        ticker.say(std::to_string(outcome_.done + outcome_.skipped + outcome_.failed) + " of " + std::to_string(count) + " runs");
    });
    return outcome_;
  }

 private:
  // Two runs of one name would write one file.
  void require_names() const {
    const std::size_t count = std::size_t(runs_.behind - runs_.first);
    if (count > kMostFiles) throw Error(ExitCode::limit, "a sweep makes no more than a million files: take -o TABLE.csv");
    std::set<std::string> names;
    for (std::size_t k = 0; k < count; ++k)
      if (const std::string name = name_of("", grid_, std::size_t(runs_.first) + k); !names.insert(name).second)
        throw Error(ExitCode::usage, "two runs would both be written to " + name + ": values of --over are too much alike");
  }

  // Whether all its files were there.
  bool make(std::size_t run, int jobs) {
    std::vector<std::string> overrides = overrides_of(options_.common);
    for (const std::string& setting : grid_.settings(run)) overrides.push_back(setting);
    const PreparedFilm film = load_film(options_.scene, overrides, true, true);
    const std::string base = (fs::path(folder_) / name_of(film.scene.name, grid_, run)).string();
    RenderJob job;
    for (const OutputFormat* format : formats_) {
      Target target{format, base + format->ending, false};
      if (!is_done(target, film)) job.targets.push_back(std::move(target));
    }
    if (job.targets.empty()) return true;
    job.at = at_;
    job.jobs = jobs;
    job.overwrite = options_.common.force;
    job.quiet = true;
    render_film(film, job);
    return false;
  }

  void has_failed(std::size_t run, const std::string& why) {
    const std::lock_guard guard(lock_);
    const std::string line = joined(grid_.settings(run), " ") + ": " + why;
    if (outcome_.failed++ < kMostTold) std::fprintf(stderr, "%s\n", line.c_str());
    if (outcome_.failed == 1) outcome_.first_failure = line;
  }

  const SweepOptions& options_;
  const Grid& grid_;
  FrameRange runs_;
  std::string folder_;
  int threads_;
  std::vector<const OutputFormat*> formats_;
  double at_;
  std::mutex lock_;
  SweepOutcome outcome_;
};

std::string with_suffix(const std::string& path, const std::string& suffix) {
  const fs::path file(path);
  return (file.parent_path() / (file.stem().string() + suffix + file.extension().string())).string();
}

void check_outputs(const SweepOptions& options) {
  int tables = 0, folders = 0;
  for (const std::string& output : options.outputs) {
    const std::string ending = fs::path(output).extension().string();
    if (ending == ".csv")
      ++tables;
    else if (ending.empty() || output.ends_with('/'))
      ++folders;
    else
      throw Error(ExitCode::usage, "-o " + output + ": a sweep writes a .csv table, or files into a FOLDER/, as --each says");
  }
  if (tables > 1 || folders > 1) throw Error(ExitCode::usage, "-o takes one table and one folder");
  if (folders == 0 && !options.each.empty())
    throw Error(ExitCode::usage, "--each says what runs become in a folder: name it with -o FOLDER/");
}

void run_sweep(SweepOptions options) {
  if (options.outputs.empty()) options.outputs.push_back("out/" + fs::path(options.scene).stem().string() + "_sweep.csv");
  check_outputs(options);
  const Grid grid(options.over, "--over");
  FrameRange runs{0, int(grid.size())};
  std::string suffix;
  if (!options.shard.empty()) {
    const PartRequest part = PartRequest::of_shard(options.shard);
    runs = part.of_things(runs.behind);
    suffix = part.suffix();
    if (runs.empty()) {
      std::fprintf(stderr, "note: %s has no runs: there are %zu\n", part.text().c_str(), grid.size());
      return;
    }
  }
  const int threads = options.jobs > 0 ? options.jobs : usable_cores();
  Json report = Json::array();
  SweepOutcome worst;
  for (const std::string& output : options.outputs) {
    const bool is_table = fs::path(output).extension() == ".csv";
    const std::string path = is_table ? with_suffix(output, suffix) : output;
    const SweepOutcome outcome =
        is_table ? write_sweep_table({options.scene, overrides_of(options.common), grid, runs, threads, path,
                                      options.common.force, options.common.quiet})
                 : FilmsOfGrid(options, grid, runs, output, threads).run();
    throw_if_interrupted();
    report.push_back({{"file", path},
                      {"runs", runs.behind - runs.first},
                      {"done_before", outcome.skipped},
                      {"failed", outcome.failed}});
    if (!options.common.json && !options.common.quiet)
      std::printf("%s: %d runs, %zu of them done before, %zu failed\n", path.c_str(), runs.behind - runs.first, outcome.skipped,
                  outcome.failed);
    if (outcome.failed > worst.failed) worst = outcome;
  }
  if (options.common.json) std::puts(report.dump(2).c_str());
  if (worst.failed > 0)
    throw Error(ExitCode::numerical, std::to_string(worst.failed) + " of the runs failed, first at " + worst.first_failure,
                {options.scene});
}

}  // namespace

void add_sweep_command(CommandLine& app) {
  auto options = std::make_shared<SweepOptions>();
  Command* command = app.add_subcommand("sweep", "a scene at every point of a grid of its keys: a table, films or pictures");
  command->add_option("scene", options->scene, "a scene file").required();
  command->add_repeatable("--over", options->over,
                          "KEY=a,b,c or KEY=from:to:count, maybe with :log behind it (repeatable: all combinations)")
      .required();
  command->add_repeatable("-o,--output", options->outputs,
                          "a .csv table with a row a run, or a FOLDER/ with files a run, or both (default out/NAME_sweep.csv)");
  command->add_repeatable("--each", options->each, "what a run becomes in the folder: mp4 (default), png, svg, gif, csv, ..; repeatable");
  command->add_option("--at", options->at, "instant that pictures show, in seconds (default 0)");
  command->add_option("--shard", options->shard, "an equal share of the runs, like 3/8; slurm: that of the array job's task");
  command->add_option("--jobs", options->jobs, "runs beside one another (default: all cores)").range(1, 256);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel sweep assets/scenes/rr_free.yaml --over start.q.1=0:90deg:4 --over gravity.2=-9.81,-1.62 -o out/grid.csv");
  command->callback([options] { run_sweep(*options); });
}

}  // namespace chainreel

// chainreel sweep SCENE --over KEY=.. [--over ..] -o FOLDER|TABLE.csv: a scene at every point of a grid of its keys.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/commands/files_of_run.hpp"
#include "app/film/runs.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/peaks.hpp"
#include "app/report/report.hpp"
#include "app/report/sidecar.hpp"
#include "app/sweep/map_axes.hpp"
#include "app/sweep/sweep_map.hpp"
#include "app/sweep/sweep_table.hpp"
#include "app/today/table_record.hpp"
#include "app/works/draw_film.hpp"
#include "app/works/render_film.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "core/machine.hpp"
#include "core/parallel.hpp"
#include "draw/page/house_style.hpp"
#include "encode/cut_off.hpp"
#include "scene/quantity.hpp"
#include "scene/text/picture_names.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1'000'000;
constexpr int kLooks = 20;
constexpr std::chrono::milliseconds kBetweenLooks(50);
constexpr std::size_t kMostTold = 5;  // runs that failed, and runs that are doubtful
constexpr std::size_t kLongestName = 255 - 16;  // bytes of a file's name, with room for its ending and .partial

struct SweepOptions {
  std::string scene;
  std::vector<std::string> over, outputs, each;
  std::string at = "0", shard, peaks, map;
  std::vector<std::string> last;
  FigureOptions figure;  // of maps
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
    if (std::find(formats.begin(), formats.end(), format) != formats.end())
      throw Error(ExitCode::usage, "--each " + name + " is given twice");
    formats.push_back(format);
  }
  return formats;
}

// The axis' values by as few digits as tell them apart, six at least.
std::vector<std::string> value_texts(const Sweep& axis) {
  if (axis.numbers.empty()) return axis.values;
  std::vector<std::string> texts;
  for (const double number : axis.numbers) texts.push_back(format_significant(number, 6));
  if (std::set<std::string>(texts.begin(), texts.end()).size() < texts.size())
    std::transform(axis.numbers.begin(), axis.numbers.end(), texts.begin(), format_shortest);
  return texts;
}

// What a run's files are called: NAME_KEY_VALUE_KEY_VALUE without an ending.
class NamesOfRuns {
 public:
  explicit NamesOfRuns(const Grid& grid) : grid_(grid) {
    for (const Sweep& axis : grid.axes()) values_.push_back(value_texts(axis));
  }
  std::string name(const std::string& scene, std::size_t run) const {
    std::string name = scene;
    const std::vector<std::size_t> at = grid_.places(run);
    for (std::size_t i = 0; i < at.size(); ++i) name += "_" + grid_.axes()[i].key + "_" + values_[i][at[i]];
    return file_name_of(name);
  }
  // "payload = 2 kg, $q1(0)$ = 0.5": what tells a run from the others; parameters stand in titles anyway.
  std::string words(std::size_t run) const {
    std::vector<std::string> words;
    const std::vector<std::size_t> at = grid_.places(run);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::string& key = grid_.axes()[i].key;
      if (key.starts_with("parameters.") || key == "title") continue;
      const ColumnName title(title_of_axis(grid_.axes()[i]));
      words.push_back(title.name + " = " + values_[i][at[i]] + (title.unit.empty() ? "" : " " + title.unit));
    }
    return joined(words);
  }

 private:
  const Grid& grid_;
  std::vector<std::vector<std::string>> values_;  // of each axis
};

class FilmsOfGrid {
 public:
  FilmsOfGrid(const SweepOptions& options, const Grid& grid, FrameRange runs, std::string folder)
      : options_(options), grid_(grid), names_(grid), runs_(runs), folder_(std::move(folder)),
        formats_(formats_of(options)), at_(parse_seconds(options.at, "--at")) {
    require_names();
    threads_ = affordable_threads();
  }

  SweepOutcome run() {
    refuse_unknown_keys(options_.scene, overrides_of(options_.common), grid_);
    const std::size_t count = std::size_t(runs_.behind - runs_.first);
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
        has_failed(run, error);
      }
      const std::lock_guard guard(lock_);
      if (ticker.is_due())
        ticker.say(std::to_string(outcome_.done + outcome_.skipped + outcome_.failed) + " of " + std::to_string(count) + " runs",
                   double(outcome_.done + outcome_.skipped + outcome_.failed) / double(count));
    });
    if (doubtful_ > kMostTold)
      tell_warnings({std::to_string(doubtful_ - kMostTold) + " more runs are as doubtful: `warnings` in their .json says why"});
    return outcome_;
  }

 private:
  // Two runs of one name would write one file, also where others have their shares.
  void require_names() const {
    const std::size_t count = grid_.size();
    if (count > kMostFiles) throw Error(ExitCode::limit, "a sweep makes no more than a million files: take -o TABLE.csv");
    std::set<std::string> names;
    for (std::size_t k = 0; k < count; ++k)
      if (const std::string name = names_.name("", k); !names.insert(name).second)
        throw Error(ExitCode::usage, "two runs would both be written to " + name + ": values of --over are too much alike");
    const auto longest = std::max_element(names.begin(), names.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const std::string scene = fs::path(options_.scene).stem().string();
    if (scene.size() + longest->size() > kLongestName)
      throw Error(ExitCode::usage, "a run's files would have names of more than " + std::to_string(kLongestName) +
                                       " bytes, like " + scene + longest->substr(0, 60) + "..: give shorter values to --over, or take -o TABLE.csv");
  }

  // Whether all its files were there.
  bool make(std::size_t run, int jobs) {
    const PreparedFilm film = load(run);
    if (!(at_ >= 0 && at_ <= film.scene.duration))
      throw Error(ExitCode::usage, "--at " + options_.at + " lies outside the duration of " + format_quantity(film.scene.duration, "s"));
    const std::string base = (fs::path(folder_) / names_.name(film.scene.name, run)).string();
    RenderJob job;
    std::optional<FilesOfRun> expected;  // computed where something is there
    bool are_ours = true;
    for (const OutputFormat* format : formats_) {
      Target target{format, base + format->ending, false};
      const bool is_table = format->shows == Shows::table;
      if (is_there(is_table ? panel_table_path(target.path, 0, film.panels.size() == 1) : target.path)) {
        if (!expected) expected.emplace(film, at_);
        const bool is_ours = expected->is(target);
        // What was cut off or changed since, or has lost its words, is made again.
        if (is_ours && has_sidecars(target) && !is_cut_off(target.path) && !is_changed_since(target.path)) continue;
        are_ours = are_ours && is_ours;
      }
      job.targets.push_back(std::move(target));
    }
    if (job.targets.empty()) return true;
    job.at = at_;
    job.jobs = jobs;
    // Of a run that was killed between its files the first ones are made again.
    job.overwrite = options_.common.force || (expected && are_ours);
    job.quiet = true;
    job.tells = false;
    try {
      tell_doubts(run, render_film(film, job).warnings);
    } catch (const Error& error) {
      // Another sweep over the same folder may have been quicker; its audit comes last.
      if (error.code() != ExitCode::file) throw;
      const FilesOfRun made(film, at_);
      if (!std::all_of(job.targets.begin(), job.targets.end(), [&](const Target& target) { return made.is(target); })) throw;
      const std::string audit = FilesOfRun::audit_beside(job.targets.front());
      for (int k = 0; k < kLooks && !is_there(audit); ++k) std::this_thread::sleep_for(kBetweenLooks);
      if (!is_there(audit)) throw;
      return true;
    }
    return false;
  }

  PreparedFilm load(std::size_t run) const {
    std::vector<std::string> overrides = overrides_of(options_.common);
    for (const std::string& setting : grid_.settings(run)) overrides.push_back(setting);
    PreparedFilm film = load_film(options_.scene, overrides, true, true);
    // Pages say which run they are of, as if the title had been set; comparisons have panels that would have to.
    const std::string words = names_.words(run);
    if (film.panels.size() == 1 && is_title_set(overrides)) tell_parameters(film);
    if (film.panels.size() > 1 || words.empty() || is_title_set(overrides)) return film;
    const std::string title = film.scene.title.empty() ? words : film.scene.title + ": " + words;
    film.scene.set.push_back("title=" + Json(title).dump());
    film.scene.title = film.panels.front().scene.title = title;
    return film;
  }

  // Those of the grid, behind a title that all its films have.
  void tell_parameters(PreparedFilm& film) const {
    Parameters told;
    for (const auto& one : film.scene.parameters)
      if (std::ranges::any_of(grid_.axes(), [&](const Sweep& axis) { return axis.key == "parameters." + one.first; })) told.push_back(one);
    film.scene.set_parameters = film.panels.front().scene.set_parameters = told;
  }

  static bool is_title_set(const std::vector<std::string>& overrides) {
    return std::ranges::any_of(overrides, [](const std::string& one) { return one.starts_with("title="); });
  }

  // As many as there is memory for, by the first run's pictures.
  int affordable_threads() const {
    try {
      const PreparedFilm film = load(std::size_t(runs_.first));
      std::vector<Output> outputs;
      for (const OutputFormat* format : formats_) outputs.push_back({Target{format, format->ending, false}, {}, {}});
      return affordable_jobs(options_.jobs, film.scene, outputs);
    } catch (const Error&) {
      return options_.jobs > 0 ? options_.jobs : usable_cores();  // what that run is refused for is told in its turn
    }
  }

  // Which of the runs it is; the audits beside the files tell of all.
  void tell_doubts(std::size_t run, const std::vector<std::string>& warnings) {
    if (warnings.empty()) return;
    const std::lock_guard guard(lock_);
    if (doubtful_++ >= kMostTold) return;
    for (const std::string& warning : warnings) tell_warnings({joined(grid_.settings(run), " ") + ": " + warning});
  }

  void has_failed(std::size_t run, const Error& error) {
    const std::lock_guard guard(lock_);
    const std::string line = joined(grid_.settings(run), " ") + ": " + error.problems().front().message;
    if (error.code() == ExitCode::limit) ++outcome_.failed_by_limits;
    if (outcome_.failed++ < kMostTold) std::fprintf(stderr, "%s\n", line.c_str());
    if (outcome_.failed == 1) outcome_.first_failure = line;
  }

  const SweepOptions& options_;
  const Grid& grid_;
  NamesOfRuns names_;
  FrameRange runs_;
  std::string folder_;
  int threads_ = 1;
  std::vector<const OutputFormat*> formats_;
  double at_;
  std::mutex lock_;
  SweepOutcome outcome_;
  std::size_t doubtful_ = 0;
};

std::string with_suffix(const std::string& path, const std::string& suffix) {
  const fs::path file(path);
  return (file.parent_path() / (file.stem().string() + suffix + file.extension().string())).string();
}

void check_outputs(const SweepOptions& options) {
  int tables = 0, folders = 0, maps = 0;
  for (const std::string& output : options.outputs) {
    refuse_dash(output);
    if (is_table_path(output)) {
      ++tables;
      if (!options.shard.empty() && lower_case_ending(output) != ".csv")
        throw Error(ExitCode::usage, "-o " + output + ": shares of a table are joined as .csv, so that --shard writes them so");
    } else if (fs::path(output).extension().empty() || output.ends_with('/')) {
      ++folders;
    } else if (is_map_path(output)) {
      ++maps;
      if (!options.shard.empty()) throw Error(ExitCode::usage, "-o " + output + ": a share of the runs makes no map: --shard goes with tables and folders");
    } else {
      throw Error(ExitCode::usage, "-o " + output + ": a sweep writes a table (.csv, .json, .npz), a picture of it (.png, .svg, .pdf), or files into a FOLDER/, as --each says");
    }
  }
  if (folders > 1) throw Error(ExitCode::usage, "-o takes one folder: --each png --each csv writes several files a run into it");
  if (tables > 1 && !options.shard.empty()) throw Error(ExitCode::usage, "-o: a share of a table is one .csv, and is joined before it becomes others");
  refuse_twice(options.outputs);
  if (maps == 0 && !options.map.empty()) throw Error(ExitCode::usage, "--map says what a picture shows: name one with -o MAP.png");
  if (tables + maps == 0 && (!options.peaks.empty() || !options.last.empty()))
    throw Error(ExitCode::usage, std::string(options.peaks.empty() ? "--last" : "--peaks") + " says what a table holds: name one with -o TABLE.csv");
  for (std::size_t i = 0; i < options.last.size(); ++i)
    if (std::ranges::count(options.last, options.last[i]) > 1) throw Error(ExitCode::usage, "--last " + options.last[i] + " is given twice");
  if (folders == 0 && !options.each.empty())
    throw Error(ExitCode::usage, "--each says what runs become in a folder: name it with -o FOLDER/");
}

// Of the tables the one that grows, which a run that was ended goes on with: a .csv where there is one.
std::vector<std::string> tables_of(const std::vector<std::string>& outputs) {
  std::vector<std::string> tables;
  std::copy_if(outputs.begin(), outputs.end(), std::back_inserter(tables), [](const std::string& path) { return is_table_path(path); });
  std::stable_partition(tables.begin(), tables.end(), [](const std::string& path) { return table_format_of(path) == TableFormat::csv; });
  return tables;
}

// The pictures, checked before anything is computed; their table stands beside the first where none is named.
std::vector<std::string> maps_of(SweepOptions& options) {
  std::vector<std::string> maps;
  std::copy_if(options.outputs.begin(), options.outputs.end(), std::back_inserter(maps), is_map_path);
  for (const std::string& path : maps) const OutputFile allowed(path, options.common.force);
  const std::vector<std::string> tables = tables_of(options.outputs);
  const bool has_csv = !tables.empty() && table_format_of(tables.front()) == TableFormat::csv;  // of which maps are drawn
  if (!maps.empty() && !has_csv) options.outputs.push_back(fs::path(maps.front()).replace_extension(".csv").string());
  return maps;
}

void draw_maps(const SweepOptions& options, const Grid& grid, const std::vector<std::string>& maps, const std::string& table) {
  const Scene scene = read_scene(options.scene, overrides_of(options.common));
  const Fonts fonts(families_of(scene));
  const ChartLook look = chart_look(options.figure, scene, fonts);
  const Picture picture = grid.axes().size() == 1 ? response_chart(sweep_curves(grid, scene, table, options.last, options.map), look)
                                                  : stability_map(sweep_map(grid, scene, table, options.last, options.map), look);
  const ClipMemory memory = memory_of_chart(options.figure);
  for (const std::string& path : maps) write_figure(options.figure, picture, fonts, memory, path, options.common.force);
}

void run_sweep(SweepOptions options) {
  if (options.outputs.empty()) options.outputs.push_back("out/" + fs::path(options.scene).stem().string() + "_sweep.csv");
  check_outputs(options);
  keeps_what_is_finished();
  const Grid grid(options.over, "--over");
  const std::vector<std::string> maps = maps_of(options);
  if (!maps.empty()) require_map_grid(grid);
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
  const PeaksAsked peaks = options.peaks.empty() ? PeaksAsked{} : parse_peaks(options.peaks, "--peaks");
  Json report{{"runs", runs.behind - runs.first}, {"outputs", Json::array()}};
  std::vector<std::string> written;
  SweepOutcome worst;
  const auto tell = [&](const std::string& path, const SweepOutcome& outcome) {
    throw_if_interrupted();
    report["outputs"].push_back({{"file", path}, {"done_before", outcome.skipped}, {"failed", outcome.failed}, {"largest", Json::array()}});
    for (const SweepPeak& one : outcome.largest)
      report["outputs"].back()["largest"].push_back({{"column", one.column}, {"value", one.value}, {"run", one.run}, {"set", grid.settings(one.run)}, {"same_in_all", one.is_of_all()}});
    written.push_back(path);
    if (!options.common.json && !options.common.quiet)
      std::printf("%s: %d runs, %zu of them done before, %zu failed\n", path.c_str(), runs.behind - runs.first, outcome.skipped,
                  outcome.failed);
    if (!options.common.json && !options.common.quiet && written.size() == 1)
      for (const SweepPeak& one : outcome.largest)
        std::printf("largest %s: %s, %s\n", one.column.c_str(), format_significant(one.value, 6).c_str(),
                    one.is_of_all() ? "the same in all runs" : ("in run " + std::to_string(one.run) + ": " + joined(grid.settings(one.run), " ")).c_str());
    if (outcome.failed > worst.failed) worst = outcome;
    if (outcome.with_repeats > 0 && written.size() == 1 && !options.common.quiet)
      std::fprintf(stderr, "note: %s: in %zu of %zu rows an event happens more than once: its column has the first instant, last_.. the last, times_.. how often and holds_.. whether it holds at the end\n",
                   path.c_str(), outcome.with_repeats, std::size_t(runs.behind - runs.first));
    if (outcome.beyond_limits > 0 && written.size() == 1 && !options.common.quiet)
      std::fprintf(stderr, "note: %s: %zu of %zu rows pass limits of joints: their column `trouble` names them\n", path.c_str(), outcome.beyond_limits,
                   std::size_t(runs.behind - runs.first));
    if (outcome.doubtful > 0 && written.size() == 1)
      tell_warnings({path + ": " + std::to_string(outcome.doubtful) + (outcome.doubtful == 1 ? " row is" : " rows are") +
                     " doubtful: its column `trouble` says why"});
  };
  // Tables first: they depend on the files that were read up to there, which must be the same for all shares.
  if (std::vector<std::string> tables = tables_of(options.outputs); !tables.empty()) {
    tables.front() = with_suffix(tables.front(), suffix);
    SweepTableJob job{options.scene, overrides_of(options.common), grid, runs, threads, tables, options.common.force, options.common.quiet, peaks, options.last};
    if (!maps.empty()) job.looks_at_names = [&](const std::vector<std::string>& names) { require_map_column(names, grid, options.last, options.map); };
    TableRecords records(*options.figure.command, options.common.force);
    if (options.shard.empty()) records.open(tables, tables);  // a share is no table yet
    const SweepOutcome outcome = write_sweep_table(job);
    for (const std::string& path : tables) tell(path, outcome);
    records.write();
    if (!maps.empty()) {
      draw_maps(options, grid, maps, tables.front());
      for (const std::string& path : maps) tell(path, outcome);
    }
  }
  for (const std::string& output : options.outputs)
    if (!is_table_path(output) && !is_map_path(output)) tell(output, FilmsOfGrid(options, grid, runs, output).run());
  report["failed"] = worst.failed;
  report.update(files_json(written));
  if (options.common.json) print_json(report);
  require_none_failed(worst, options.scene);
}

}  // namespace

void add_sweep_command(CommandLine& app) {
  auto options = std::make_shared<SweepOptions>();
  Command* command = app.add_subcommand("sweep", "a scene at every point of a grid of its keys: a table, films or pictures");
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  command->add_repeatable("--over", options->over,
                          "KEY=a,b,c or KEY=from:to:count, maybe with :log behind it (repeatable: all combinations)")
      .required();
  command->add_repeatable("-o,--output", options->outputs,
                          "a .csv, .json or .npz table with a row a run, a .png, .svg or .pdf picture of it, curves over one key or a map over two, or a FOLDER/ with files a run "
                          "(repeatable; default out/NAME_sweep.csv)");
  command->add_repeatable("--each", options->each, "what a run becomes in the folder: mp4 (default), png, svg, gif, csv, ..; repeatable");
  command->add_option("--peaks", options->peaks,
                      "qd,tau,energy_error,..: of these the largest of each run, with its sign, as columns of the "
                      "table; names as of `simulate --columns`");
  command->add_repeatable("--last", options->last,
                          "an expression whose value at the end of each run is a column of the table, like 'x_G' or 'sqrt((x_G - 0.9)^2 + (y_G - 0.3)^2)'; repeatable");
  command->add_option("--map", options->map, "the column that a picture shows, of curves those of all joints, like tau (default the first of --peaks, else of --last; of curves all of them, a panel each)");
  options->figure.command = command;
  command->add_option("--at", options->at, "instant that pictures show, in seconds (default 0)");
  command->add_option("--shard", options->shard, "an equal share of the runs, like 3/8; slurm: that of the array job's task");
  command->add_option("--jobs", options->jobs, "runs beside one another (default: all cores)").range(1, 256);
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("A table has a row a run: its last state and the energy there, what --peaks and --last ask for, and of each event its first instant, its last one\n"
                  "(last_NAME), how often it happens (times_NAME) and whether it holds at the end (holds_NAME): where that is 1, last_settled is a settling time; `trouble` says\n"
                  "why it failed, or that its energy is off by more than 1 % of what it moved. Tables are computed by\n"
                  "dop853 with tolerance 1e-10 where a scene leaves its method to auto, which asks what a page shows; films and pictures\n"
                  "by what auto takes.\n"
                  "A .csv table begins with three lines of facts, `# ..`: pandas.read_csv(file, comment='#'), or numpy.genfromtxt(file,\n"
                  "delimiter=',', names=True, skip_header=3); .npz and .json have none.\n"
                  "Example: chainreel sweep rr_free --over start.q.1=0:90deg:4 --over gravity.2=-9.81,-1.62 --peaks qd,energy_error -o out/grid.csv\n"
                  "         chainreel sweep rr_free --over start.q.1=0:90deg:10 --over payload.mass=0:5:6 --peaks qd --map qd2 -o out/map.png\n"
                  "         chainreel sweep rr_torque --over payload.mass=0:3:7 --peaks tau,qd -o out/payload.png\n"
                  "         chainreel sweep pp_spring --over start.q.2=0.2:1:5 --over duration=1s:3s:5 --last 'y_G - 0.3' -o out/last.png");
  command->callback([options] { run_sweep(*options); });
}

}  // namespace chainreel

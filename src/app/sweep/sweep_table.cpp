#include "app/sweep/sweep_table.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>

#include "app/cli/streams.hpp"
#include "app/film/progress.hpp"
#include "app/report/peaks.hpp"
#include "app/report/run_report.hpp"
#include "app/report/version.hpp"
#include "app/works/growing_table.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "core/parallel.hpp"
#include "dynamics/energy.hpp"
#include "scene/keys/keys.hpp"
#include "scene/quantity.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/unread.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/audit.hpp"
#include "sim/doubts.hpp"
#include "sim/plots.hpp"
#include "sim/rank_loss.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/unstable_rest.hpp"
#include "sim/watch/events.hpp"
#include "sim/workload.hpp"
#include "table/data_table.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

constexpr int kRunsOfPiece = 16;  // that a thread takes at a time

std::vector<std::string> settings_of(const std::vector<std::string>& overrides, const Grid& grid, std::size_t run) {
  std::vector<std::string> all = overrides;
  for (const std::string& setting : grid.settings(run)) all.push_back(setting);
  return all;
}

std::vector<std::string> settings_of(const SweepTableJob& job, std::size_t run) {
  return settings_of(job.overrides, job.grid, run);
}

bool is_about_keys(const Error& error) {
  return std::any_of(error.problems().begin(), error.problems().end(), [](const Problem& problem) { return problem.is_of_key; });
}

std::string first_words(const Error& error) {
  return error.problems().front().message;
}

// With `auto` all runs take the same method, as those of `fall` do.
Scene scene_of(SceneFile& file, const std::vector<std::string>& overrides, const std::vector<std::string>& last) {
  Scene scene = file.read(overrides);
  // Behind the plots of its own.
  for (const std::string& expression : last) scene.plot.push_back({expression, "", {"--last '" + expression + "'"}});
  require_single_run(scene);
  if (scene.chooses_method()) {
    scene.method = "dop853";
    scene.tolerance = 1e-10;
  }
  return scene;
}

// The first of the plots that --last asked for, which stand behind the scene's own.
std::size_t first_of_last(const SweepTableJob& job, const Simulation& simulation) {
  return job.last.empty() ? 0 : simulation.plots->list.size() - job.last.size();
}

// The first run of the grid that can be made ready, from which the table has its columns: the same for all shares of it.
struct FirstRun {
  Scene scene;
  Simulation simulation;
};
FirstRun first_good_run(const SweepTableJob& job) {
  constexpr std::size_t kMostTried = 10000;  // a second or so
  SceneFile file(job.scene);
  std::optional<Error> first;
  const std::size_t count = std::min(job.grid.size(), kMostTried);
  for (std::size_t run = 0; run < count; ++run) {
    throw_if_interrupted();
    try {
      Scene scene = scene_of(file, settings_of(job, run), job.last);
      Simulation simulation = prepare(scene, false);
      return {std::move(scene), std::move(simulation)};
    } catch (const Error& error) {
      if (is_about_keys(error) || error.code() == ExitCode::limit) throw;
      if (!first) first = error;
    }
    // What the scene is refused for without any of the values, too, none of them brings about.
    if (run == 0) {
      try {
        Scene scene = scene_of(file, job.overrides, job.last);
        prepare(scene, false);
      } catch (const Error& error) {
        if (first_words(error) == first_words(*first)) throw Error(*first);
      }
    }
  }
  throw Error(*first);
}

// The values of a key of numbers, in SI units and radians whatever they were written in; nothing where one is none.
std::optional<std::vector<double>> numbers_of(const Sweep& axis) {
  const SceneKey* key = find_key(axis.key);
  if (key != nullptr && (key->form == KeyForm::text || key->form == KeyForm::path || key->form == KeyForm::word || key->form == KeyForm::accuracy)) return std::nullopt;
  std::vector<double> numbers;
  for (const std::string& value : axis.values) {
    try {
      numbers.push_back(parse_quantity(value, {}));
    } catch (const Error&) {
      return std::nullopt;
    }
  }
  return numbers;
}

// Each value as a cell; what is no number may hold anything.
std::vector<std::string> cells_of(const Sweep& axis) {
  std::vector<std::string> cells = axis.values;
  if (const auto numbers = numbers_of(axis))
    std::ranges::transform(*numbers, cells.begin(), format_shortest);
  else
    for (std::string& cell : cells)
      if (cell.find_first_of(",\"\n\r") != std::string::npos) cell = csv_words(cell);
  return cells;
}

// What a thread computes rows with.
class RowMaker {
 public:
  // `known`: what speaks against the scene of the first run, which is told for all.
  RowMaker(const SweepTableJob& job, std::string states, std::size_t peaks, std::size_t events, std::vector<std::string> known)
      : job_(job), file_(job.scene), states_(std::move(states)), peaks_(peaks), events_(events), known_(std::move(known)) {
    for (const Sweep& axis : job.grid.axes()) cells_.push_back(cells_of(axis));
  }

  // Without the end of its line.
  std::string row(std::size_t run) {
    std::string row = std::to_string(run);
    const std::vector<std::size_t> at = job_.grid.places(run);
    for (std::size_t i = 0; i < at.size(); ++i) row += "," + cells_[i][at[i]];
    try {
      Scene scene = scene_of(file_, settings_of(job_, run), job_.last);
      const Simulation simulation = prepare(scene, false, last_);
      if (state_names(simulation.chain) != states_ || scene.events.size() != events_)
        return row + failed_row("its states or events are other ones than the first run's");
      require_possible(simulation);
      const auto stop = [](double) { return interrupted(); };
      if (job_.peaks.empty()) return row + row_of(scene, simulation, simulate(simulation, looks_at(scene.duration), stop), {});
      PeaksOfRun found = simulate_for_peaks(simulation, job_.peaks, stop);
      for (LimitEvent& one : limits_of_peaks(simulation, names_of_peaks(simulation, job_.peaks), found.peaks, found.run.limits)) found.run.limits.push_back(std::move(one));
      return row + row_of(scene, simulation, found.run, found.peaks);
    } catch (const Error& error) {
      throw_if_interrupted();
      return row + failed_row(error.problems().front().message);
    }
  }

 private:
  // The end, and instants before by which the energy at the end is judged.
  static std::vector<double> looks_at(double duration) {
    constexpr int kInstants = 8;
    std::vector<double> times;
    for (int k = 1; k <= kInstants; ++k) times.push_back(duration * k / kInstants);
    return times;
  }

  // Of each event whether it holds at the run's end, 1 or 0; nothing of one that is an instant.
  std::vector<std::string> holding_at_end(const Simulation& simulation, const Trajectory& run) const {
    std::vector<std::string> holding(events_);
    if (!simulation.events || run.size() == 0 || !is_complete(run.status)) return holding;
    ChainSystem system(simulation);
    EventWatch watch(*simulation.events, system, simulation.duration);
    EventHits hits;
    if (!watch.start(run.t.back(), run.q_at(run.size() - 1), run.qd_at(run.size() - 1), hits)) return holding;
    for (std::size_t k = 0; k < events_; ++k)
      if (simulation.events->list[k].test != Event::Test::changes_side) holding[k] = std::ranges::count(hits.from_start, int(k)) > 0 ? "1" : "0";
    return holding;
  }

  // What speaks against a run that came to its end.
  static std::string doubt_of(const Simulation& simulation, const Trajectory& run) {
    if (!is_complete(run.status)) return "";
    if (simulation.motion) return "";
    std::string words;
    for (const std::optional<Doubt>& doubt : {doubt_of_energy(simulation, run, audit_of(simulation, run), {}), doubt_of_rest(simulation), doubt_of_rank(simulation, run),
                                              doubt_of_events(simulation, run, {})})
      if (doubt) words += (words.empty() ? kDoubtful : "; ") + doubt->words;
    return words;
  }

  // Which limits of joints it passes, the first ones.
  static std::string limits_of(const Scene& scene, const Trajectory& run) {
    constexpr std::size_t kMostNamed = 3;
    std::string words;
    for (std::size_t i = 0; i < std::min(run.limits.size(), kMostNamed); ++i)
      words += (words.empty() ? kLimits : "; ") + limit_note(run.limits[i], scene.limit);
    if (run.limits.size() > kMostNamed) words += "; and " + std::to_string(run.limits.size() - kMostNamed) + " more";
    return words;
  }

  std::string row_of(const Scene& scene, const Simulation& simulation, const Trajectory& run, const std::vector<Peak>& peaks) const {
    const bool as_expected =
        scene.expect == Outcome::diverge ? run.status == RunStatus::diverged : is_complete(run.status) && unexpected_limits(run, scene).empty();
    std::string trouble = run.trouble.empty() ? doubt_of(simulation, run) : run.trouble;
    for (const std::string& doubt : scene.doubts)
      if (std::ranges::find(known_, doubt) == known_.end()) trouble += (trouble.empty() ? kDoubtful : "; ") + doubt;
    if (const std::string limits = limits_of(scene, run); !limits.empty() && is_complete(run.status)) trouble += (trouble.empty() ? "" : "; ") + limits;
    if (!as_expected && scene.expect == Outcome::diverge && is_complete(run.status)) trouble = kCalm + to_string(run.status) + (trouble.empty() ? "" : "; " + trouble);
    std::string row = as_expected ? ",1," : ",0,";
    row += to_string(run.status) + "," + format_shortest(run.end_time) + "," +
           (run.ending_event < 0 ? "" : csv_words(scene.events[std::size_t(run.ending_event)].title()));
    row += "," + (run.size() > 0 ? state_text(run, run.size() - 1) + "," + energy_at_end(simulation, run) : no_state() + ",");
    for (const Peak& peak : peaks) row += "," + format_shortest(peak.value);
    for (std::size_t i = 0; i < job_.last.size(); ++i)
      row += "," + (run.size() > 0 ? format_shortest(plot_value(simulation, first_of_last(job_, simulation) + i, run, run.size() - 1)) : "");
    struct Times {
      std::optional<double> first{}, last{};
      int count = 0;
    };
    std::vector<Times> events(events_);
    for (int k = 0; k < run.events.size(); ++k) {
      Times& times = events[std::size_t(run.events.event[std::size_t(k)])];
      times.last = run.events.t[std::size_t(k)];
      if (times.count++ == 0) times.first = times.last;
    }
    const std::vector<std::string> holding = holding_at_end(simulation, run);
    for (std::size_t k = 0; k < events.size(); ++k) {
      const Times& times = events[k];
      row += "," + (times.first ? format_shortest(*times.first) : "") + "," + (times.last ? format_shortest(*times.last) : "") + "," + std::to_string(times.count) + "," + holding[k];
    }
    return row + "," + (trouble.empty() ? "" : csv_words(trouble));
  }
  std::string failed_row(const std::string& why) const {
    return ",0,refused,,," + no_state() + "," + std::string(peaks_ + job_.last.size() + kCellsOfEvent * events_, ',') + "," + csv_words(why);
  }
  static std::string energy_at_end(const Simulation& simulation, const Trajectory& run) {
    Workspace ws(simulation.chain);
    const ConstVec q = run.q_at(run.size() - 1);
    return format_shortest(energy_of(simulation.chain, ws, q, run.qd_at(run.size() - 1)).total() + SpringEnergy(simulation).at(q));
  }
  std::string no_state() const { return std::string(std::size_t(std::count(states_.begin(), states_.end(), ',')), ','); }

  const SweepTableJob& job_;
  std::vector<std::vector<std::string>> cells_;  // by axis and value
  SceneFile file_;
  LastChain last_;
  std::string states_;
  std::size_t peaks_, events_;  // how many there are
  std::vector<std::string> known_;
};

// Where values are or hold names of files, as in {csv: tau.csv}, these, as the scene finds them: here, else beside it.
std::vector<std::string> files_named(const SweepTableJob& job) {
  std::vector<std::string> files;
  const auto look = [&](const std::string& name) {
    std::error_code code;
    for (const fs::path& file : {fs::path(name), fs::path(job.scene).parent_path() / name})
      if (!name.empty() && fs::is_regular_file(file, code)) return files.push_back(file.string());
  };
  for (const Sweep& axis : job.grid.axes())
    for (const std::string& value : axis.numbers.empty() ? axis.values : std::vector<std::string>{}) {
      look(value);
      constexpr const char* kAround = " \t{}[],:\"'";
      for (std::size_t begin = 0; (begin = value.find_first_not_of(kAround, begin)) != std::string::npos;) {
        const std::size_t end = std::min(value.find_first_of(kAround, begin), value.size());
        if (end - begin < value.size()) look(value.substr(begin, end - begin));
        begin = end;
      }
    }
  return files;
}

// All that rows depend on: the program, the files that were read for the first run or that values name, and what was asked.
std::string key_of(const SweepTableJob& job) {
  Json json{{"program", {program_version(), program_revision()}}, {"overrides", job.overrides}};
  for (const Sweep& axis : job.grid.axes()) json["over"].push_back({axis.key, axis.values});
  std::vector<std::string> hashes;  // files have other names in other places
  for (const std::vector<std::string>& files : {noted_inputs(), files_named(job)})
    for (const std::string& file : files) hashes.push_back(sha256_of_file(file));
  if (const std::string* text = standard_input_at(job.scene)) hashes.push_back(sha256_of(*text));
  std::sort(hashes.begin(), hashes.end());
  json["files"] = hashes;
  for (const MotionColumn column : job.peaks.columns) json["peaks"].push_back(to_string(column));
  for (const std::string& single : job.peaks.single) json["peaks"].push_back(single);
  for (const std::string& expression : job.last) json["last"].push_back(expression);
  return sha256_of(json.dump());
}

std::string head_of(const SweepTableJob& job, const Scene& first, const Chain& chain, std::vector<std::string> peaks) {
  std::string head = "# sweep: " + first.name + (varies_method(job.grid) ? "" : ", " + method_text(first)) + "\n# key: " + key_of(job) + "\n" +
                     runs_line(job.runs, job.grid.size()) + "run";
  for (const Sweep& axis : job.grid.axes()) head += "," + axis.key;
  // Of other models the same numbers may have other units.
  const auto is_of_model = [](const Sweep& axis) { return axis.key == "model" || axis.key.starts_with("model."); };
  const bool one_model = std::none_of(job.grid.axes().begin(), job.grid.axes().end(), is_of_model);
  head += ",good,status,end_time [s],ended_by," + state_names(chain, one_model ? NamesOfState::with_units : NamesOfState::plain) +
          ",energy [J]";
  for (const std::string& peak : peaks) head += ",peak_" + (one_model ? peak : ColumnName(peak).name);
  for (const std::string& expression : job.last) head += "," + (expression.find(',') == std::string::npos ? expression : csv_words(expression));
  for (const EventEntry& event : first.events) {
    const std::string title = event.title();
    head += "," + csv_words(title + " [s]") + "," + csv_words("last_" + title + " [s]") + "," + csv_words("times_" + title) + "," + csv_words("holds_" + title);
  }
  return head + ",trouble\n";
}

}  // namespace

std::string runs_line(const FrameRange& runs, std::size_t all) {
  return "# runs: " + std::to_string(runs.first) + " to " + std::to_string(runs.behind - 1) + " of " + std::to_string(all) + "\n";
}

bool varies_method(const Grid& grid) {
  return std::ranges::any_of(grid.axes(), [](const Sweep& axis) {
    return axis.key == "method" || axis.key == "step" || axis.key == "tolerance" || axis.key == "order";
  });
}

void refuse_unknown_keys(const std::string& scene, const std::vector<std::string>& overrides, const Grid& grid) {
  try {
    const Scene first = SceneFile(scene).read(settings_of(overrides, grid, 0));
    for (const Sweep& axis : grid.axes()) require_read(axis.key, first, "--over");
  } catch (const Error& error) {
    if (is_about_keys(error) || error.code() == ExitCode::usage) throw;
  }
}

namespace {

std::string last_line_of(std::string text) {
  text.pop_back();  // its end
  return text.substr(text.rfind('\n') + 1);
}

// The same table as other kinds of files.
class Copies {
 public:
  explicit Copies(const SweepTableJob& job) {
    for (std::size_t i = 1; i < job.paths.size(); ++i) files_.push_back(std::make_unique<OutputFile>(job.paths[i], job.overwrite));
  }
  bool any() const { return !files_.empty(); }
  void write(const std::string& csv) {
    if (!any()) return;
    const DataTable table = table_of_csv(csv);
    for (const auto& file : files_) write_whole(*file, table_bytes(table, table_format_of(file->path())));
  }

 private:
  std::vector<std::unique_ptr<OutputFile>> files_;
};

}  // namespace

SweepOutcome write_sweep_table(const SweepTableJob& job) {
  const auto [first, simulation] = first_good_run(job);
  require_possible(simulation, double(job.runs.behind - job.runs.first));
  for (const Sweep& axis : job.grid.axes()) require_read(axis.key, first, "--over");
  const std::string states = state_names(simulation.chain);
  require_peaks(simulation, job.peaks, "--peaks");
  for (std::size_t i = 0; i < job.last.size(); ++i)
    if (!simulation.plots->list[first_of_last(job, simulation) + i].value) throw Error(ExitCode::usage, "--last " + job.last[i] + ": a plot of that name has several curves: write an expression, like x_G or q1");
  const std::vector<std::string> peaks = names_of_peaks(simulation, job.peaks);
  for (const std::string& doubt : first.doubts) tell_warnings({first.name + ": " + doubt});

  const std::string& path = job.paths.front();
  const std::string head = head_of(job, first, simulation.chain, peaks);
  const std::vector<std::string> names = csv_fields(last_line_of(head), {path});
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw Error(ExitCode::bad_input, "two columns of the table would be called " + *name + ": give the events other names", first.place_of("events"));
  if (job.looks_at_names) job.looks_at_names(names);
  Copies copies(job);
  GrowingTable table(path, head, std::size_t(job.runs.first),
                     std::size_t(job.runs.behind - job.runs.first), job.overwrite);
  SeenRows seen(job.grid, peaks, std::size_t(std::count(states.begin(), states.end(), ',')) + 2, job.last.size(), first.events.size());
  table.for_each_before([&](const std::string& row) { seen.look(row); });
  SweepOutcome outcome;
  outcome.skipped = table.rows_before();
  const std::size_t begin = std::size_t(job.runs.first) + outcome.skipped, behind = std::size_t(job.runs.behind);
  if (!table.is_finished()) {
    Ticker ticker(job.quiet);
    std::mutex lock;
    const std::size_t pieces = (behind - std::min(begin, behind) + kRunsOfPiece - 1) / kRunsOfPiece;
    for_each_index_with_tools(pieces, job.threads, [&]() -> RunIndex {
      const auto maker = std::make_shared<RowMaker>(job, states, peaks.size(), first.events.size(), first.doubts);
      return [&, maker](std::size_t piece) {
        std::string rows;
        const std::size_t from = begin + piece * kRunsOfPiece, until = std::min(behind, from + kRunsOfPiece);
        for (std::size_t run = from; run < until; ++run) {
          throw_if_interrupted();
          const std::string row = maker->row(run);
          seen.look(row);
          rows += row + "\n";
        }
        table.take(piece, rows);
        const std::lock_guard guard(lock);
        outcome.done += until - from;
        if (ticker.is_due())
          ticker.say(first.name + ": " + std::to_string(outcome.skipped + outcome.done) + " of " +
                         std::to_string(job.runs.behind - job.runs.first) + " runs",
                     double(outcome.done) / double(behind - begin));
      };
    });
    const TableFormat format = table_format_of(path);
    if (format == TableFormat::csv)
      table.commit();
    else
      table.commit([&](const std::string& csv) {
        copies.write(csv);
        return table_bytes(table_of_csv(csv), format);
      });
  }
  // Read only if need be: rows are written as they come, and a large table is nowhere whole in memory.
  if (copies.any() && table_format_of(path) == TableFormat::csv) copies.write(read_plain_file(path, kLargestGrown));
  SweepOutcome all = seen.outcome();
  all.done = outcome.done;
  all.skipped = outcome.skipped;
  return all;
}

}  // namespace chainreel

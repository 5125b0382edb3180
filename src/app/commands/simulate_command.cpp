// chainreel simulate SCENE -o FILE.csv

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/cli/table_files.hpp"
#include "app/film/automatic.hpp"
#include "app/film/prepared.hpp"
#include "app/film/progress.hpp"
#include "app/film/runs.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/peaks.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "app/today/table_record.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "picture/formula_words.hpp"
#include "scene/film_clock.hpp"
#include "scene/quantity.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/audit.hpp"

namespace chainreel {
namespace {

constexpr const char* kUsualColumns = "usual";

struct SimulateOptions {
  std::string scene;
  std::vector<std::string> outputs;
  std::string columns = kUsualColumns;
  std::string peaks;  // columns of which they are asked for
  bool every_step = false;
  std::string every;  // time between rows; that of frames where it is empty
  int panel = 0;  // from 1; 0: all
  const Command* command = nullptr;
  CommonOptions common;
};

// s, between two rows; 0: as between frames.
double between_rows(const Scene& scene, const std::string& every) {
  if (every.empty()) return 0;
  const double between = parse_quantity(every, {"--every"}, "s");
  if (!(between > 0) || !(scene.duration / between <= kMostFrames))
    throw Error(ExitCode::usage, "--every " + every + " must be a time above 0, like 1ms, and give no more than ten million rows");
  return between;
}

Trajectory run_scene(const PreparedFilm& film, const PreparedScene& prepared, const SimulateOptions& options) {
  Ticker ticker(film.quiet);
  const auto stop = [&](double t) {
    if (ticker.is_due()) ticker.say(simulating_text(film, prepared), part_done(prepared.simulation, t));
    return interrupted();
  };
  if (options.every_step) return simulate_every_step(prepared.simulation, stop);
  const double between = between_rows(prepared.scene, options.every);
  std::vector<double> times = between > 0 ? instants_every(between, prepared.scene.duration, kMostFrames) : frame_times(prepared.scene);
  const double duration = prepared.scene.duration;
  // One row at the end exactly, and no frame within round-off before it.
  while (!times.empty() && times.back() > duration - same_instant(prepared.simulation)) times.pop_back();
  times.push_back(duration);
  return simulate_audited(prepared.simulation, times, stop);
}

// Columns of the table, none for the usual ones, and what peaks are asked of.
struct Wanted {
  std::vector<MotionColumn> columns;
  PeaksAsked peaks;
};

// What the run did not see itself is added to the limits that it passes.
std::vector<NamedPeak> peaks_of_run(const Simulation& simulation, const PeaksAsked& peaks, Trajectory& trajectory) {
  if (peaks.empty() || !is_complete(trajectory.status)) return {};  // what a run grows to that is lost is no peak
  const PeaksOfRun found = simulate_for_peaks(simulation, peaks, [](double) { return interrupted(); });
  throw_if_interrupted();
  const std::vector<std::string> names = names_of_peaks(simulation, peaks);
  for (LimitEvent& one : limits_of_peaks(simulation, names, found.peaks, trajectory.limits)) trajectory.limits.push_back(std::move(one));
  return named(names, found.peaks);
}

// A panel's run as files, and where it is whole the record of them. What it ended with where it should not have is put into `trouble`; all that is known is told before it is thrown.
Json simulate_panel(const PreparedFilm& film, const PreparedScene& prepared, TableFiles& files, TableRecords& records,
                    const Wanted& wanted, const SimulateOptions& options, bool alone, std::optional<Error>& trouble) {
  say_choice(prepared, options.common.quiet);
  Trajectory trajectory = run_scene(film, prepared, options);
  throw_if_interrupted();
  const DataTable table =
      motion_table(prepared.simulation, trajectory, wanted.columns.empty() ? usual_columns(prepared.simulation.chain) : wanted.columns);
  const bool is_whole = is_complete(trajectory.status) || prepared.scene.expect == Outcome::diverge;
  if (is_whole)
    files.write(table);
  else
    files.write_partial(table);
  const std::vector<NamedPeak> peaks = peaks_of_run(prepared.simulation, wanted.peaks, trajectory);
  try {
    require_expected_end(trajectory, prepared.scene);
  } catch (const Error& error) {
    throw_if_interrupted();
    if (!trouble) trouble = error;
    if (!is_complete(trajectory.status) && !options.common.json) throw;
  }
  const RunReport run = run_report(prepared, trajectory);
  const std::string name = prepared.scene.name + (alone ? "" : ", '" + in_plain_words(prepared.scene.title) + "'");
  tell_warnings(warning_lines(name, run));
  if (!options.common.quiet)
    for (const std::string& note : notes_of(prepared, trajectory)) std::fprintf(stderr, "%s: %s\n", name.c_str(), note.c_str());
  Json report = to_json(run);
  report["panels"] = Json::array();
  report["rows"] = trajectory.size();
  report["peaks"] = to_json(peaks);
  report.update(files_json(files.paths()));
  if (!options.common.json) files.tell(options.common, table.rows, {}, peaks.empty() ? "" : words_of(peaks));
  if (is_whole)
    records.write();
  else
    records.drop();
  return report;
}

// The panels that are asked for, from 0.
std::vector<std::size_t> chosen_panels(const PreparedFilm& film, const SimulateOptions& options) {
  if (options.panel > 0) return {chosen_panel(film.scene, options.panel)};
  std::vector<std::size_t> all(film.panels.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// Numbers are looked at more closely than pictures: where a method is chosen and nothing is said of how exact the run has to be.
void tighten(Scene& scene) {
  constexpr Accuracy kOfTables{1e-8, AccuracyUnit::relative};
  if (scene.chooses_method() && scene.places.count("accuracy") == 0) scene.accuracy = kOfTables;
  for (Scene& panel : scene.compare) tighten(panel);
}

// A run's report, or those of all panels.
void print_reports(const Scene& scene, Json& reports, bool alone) {
  if (alone) return print_json(reports.front());
  std::vector<std::string> written;
  for (Json& panel : reports) {
    for (const Json& file : panel["files"]) written.push_back(file.get<std::string>());
    panel.erase("panels");
  }
  Json all{{"scene", scene.file}, {"title", scene.title}, {"duration", scene.duration}, {"panels", reports}};
  all.update(files_json(written));
  print_json(all);
}

void run_simulate(const SimulateOptions& options) {
  if (options.every_step && !options.every.empty()) throw Error(ExitCode::usage, "--every gives rows at instants, --every-step at the method's steps: take one of them");
  Scene scene = read_scene(options.scene, overrides_of(options.common));
  tighten(scene);
  const double between = between_rows(scene, options.every);
  const PreparedFilm film = film_of(std::move(scene), false, options.common.quiet, {}, between);
  const std::vector<std::size_t> chosen = chosen_panels(film, options);
  const bool alone = chosen.size() == 1;
  std::vector<std::string> outputs = options.outputs;
  if (outputs.empty()) outputs.push_back("out/" + film.scene.name + ".csv");
  if (!alone && std::find(outputs.begin(), outputs.end(), "-") != outputs.end())
    throw Error(ExitCode::usage, "-o - takes one run, but the scene has " +
                                     std::to_string(film.panels.size()) + " panels: choose one with --panel");
  Wanted wanted;
  if (options.columns != kUsualColumns) wanted.columns = parse_columns(options.columns, "--columns");
  if (!options.peaks.empty()) wanted.peaks = parse_peaks(options.peaks, "--peaks");
  if (!wanted.peaks.empty() && std::find(outputs.begin(), outputs.end(), "-") != outputs.end())
    throw Error(ExitCode::usage, "-o - gives the table to standard output, where --peaks has no room: write the table to a file");
  for (const std::size_t i : chosen) {
    require_columns(film.panels[i].simulation, wanted.columns, "--columns");
    require_peaks(film.panels[i].simulation, wanted.peaks, "--peaks");
  }
  Json reports = Json::array();
  std::optional<Error> trouble;
  TableRecords records(*options.command, options.common.force);
  for (const std::size_t i : chosen) {
    std::vector<std::string> paths;
    for (const std::string& output : outputs) paths.push_back(panel_table_path(output, i, alone));
    TableFiles files(paths, options.common);
    records.open(paths, outputs);
    reports.push_back(simulate_panel(film, film.panels[i], files, records, wanted, options, alone, trouble));
  }
  if (options.common.json) print_reports(film.scene, reports, alone);
  if (trouble) throw Error(*trouble);
}

}  // namespace

void add_simulate_command(CommandLine& app) {
  auto options = std::make_shared<SimulateOptions>();
  Command* command = app.add_subcommand("simulate", "run a scene and write its motion as a table: CSV, JSON or NPZ");
  options->command = command;
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  add_table_option(*command, options->outputs, "out/NAME.csv; of a scene with several panels NAME.1.csv, NAME.2.csv, ..");
  command
      ->add_option("--columns", options->columns,
                   "what stands in the table, like t,q,tau; there are " + joined(words_of(names_of(MotionColumn{}))) +
                       "; usual: t,q,qd,tau,energy and the end effector's")
      .show_default();
  command->add_option("--peaks", options->peaks,
                      "told beside the table: of these columns, like qd,tau,energy, the value of each number that is farthest from zero, and when; "
                      "looked for at 2000 instants and closely about what is found");
  add_panel_option(*command, options->panel);
  command->add_flag("--every-step", options->every_step, "a row a step instead of a row a frame");
  command->add_option("--every", options->every, "time between rows, like 1ms, instead of that between frames");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Rows are as many a second as frames of the film: --every 1ms for a row a millisecond. Where `method: auto` chooses, a table\n"
      "is exact to 1e-8 of the room that the motion takes, as far as that can be had, unless the scene says `accuracy`; `render -o NAME.csv` writes the numbers that the film shows.\n"
      "Example: chainreel simulate pp_free -o out/pp_free.csv -o out/pp_free.npz\n"
      "         chainreel simulate rr_free --columns t,q,qdd,tau -o -\n"
      "         chainreel simulate rr_torque --peaks qd,tau");
  command->callback([options] { run_simulate(*options); });
}

}  // namespace chainreel

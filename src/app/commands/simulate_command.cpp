// chainreel simulate SCENE -o FILE.csv

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>

#include "app/cli/command.hpp"
#include "app/cli/streams.hpp"
#include "app/film/automatic.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "app/report/trajectory_csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "sim/audit.hpp"

namespace chainreel {
namespace {

struct SimulateOptions {
  std::string scene;
  std::string output;
  bool every_step = false;
  int panel = 0;  // from 1; 0: all
  CommonOptions common;
};

Trajectory run_scene(const PreparedScene& prepared, bool every_step) {
  const auto stop = [](double) { return interrupted(); };
  if (every_step) return simulate_every_step(prepared.simulation, stop);
  std::vector<double> times = frame_times(prepared.scene);
  const double duration = prepared.scene.duration;
  // One row at the end exactly, and no frame within round-off before it.
  while (!times.empty() && times.back() > duration - same_instant(prepared.simulation)) times.pop_back();
  times.push_back(duration);
  return simulate_audited(prepared.simulation, times, stop);
}

// A panel's run as a CSV file, or on standard output where `output` is "-".
Json simulate_panel(const PreparedScene& prepared, const std::string& output,
                    const SimulateOptions& options, bool alone) {
  const bool to_stdout = output == "-";
  say_choice(prepared, options.common.quiet);
  std::unique_ptr<OutputFile> file;
  if (!to_stdout) file = std::make_unique<OutputFile>(output, options.common.force);
  const Trajectory trajectory = run_scene(prepared, options.every_step);
  throw_if_interrupted();
  const std::string text = trajectory_csv(prepared.simulation.chain, trajectory);
  const bool as_expected = is_complete(trajectory.status) || prepared.scene.expect == Outcome::diverge;
  if (to_stdout) {
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else if (as_expected) {
    write_whole(*file, text);
  } else {
    write_partial(*file, text);
  }
  require_expected_end(trajectory, prepared.scene);
  const RunReport run = run_report(prepared, trajectory);
  tell_warnings(warning_lines(prepared.scene.name + (alone ? "" : ", '" + prepared.scene.title + "'"), run));
  Json report = to_json(run);
  report["rows"] = trajectory.size();
  report["file"] = output;
  return report;
}

// The panels that are asked for, from 0.
std::vector<std::size_t> chosen_panels(const PreparedFilm& film, const SimulateOptions& options) {
  const std::size_t count = film.panels.size();
  if (options.panel > int(count))
    throw Error(ExitCode::usage, "--panel " + std::to_string(options.panel) + ": the scene has " +
                                     std::to_string(count) + (count == 1 ? " panel" : " panels"));
  if (options.panel > 0) return {std::size_t(options.panel) - 1};
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void run_simulate(const SimulateOptions& options) {
  const PreparedFilm film = load_film(options.scene, overrides_of(options.common), false, options.common.quiet);
  const std::vector<std::size_t> chosen = chosen_panels(film, options);
  const bool alone = chosen.size() == 1;
  const std::string output = options.output.empty() ? "out/" + film.scene.name + ".csv" : options.output;
  if (output == "-" && options.common.json)
    throw Error(ExitCode::usage, "-o - and --json both write to standard output: name a file");
  if (output == "-" && !alone)
    throw Error(ExitCode::usage, "-o - takes one run, but the scene has " +
                                     std::to_string(film.panels.size()) + " panels: choose one with --panel");
  Json reports = Json::array();
  for (const std::size_t i : chosen) {
    reports.push_back(simulate_panel(film.panels[i], panel_csv_path(output, i, alone), options, alone));
    if (!options.common.json && !options.common.quiet && output != "-")
      std::printf("%s  %d rows\n", reports.back()["file"].get<std::string>().c_str(),
                  reports.back()["rows"].get<int>());
  }
  if (options.common.json) std::puts((alone ? reports.front() : Json{{"panels", reports}}).dump(2).c_str());
}

}  // namespace

void add_simulate_command(CommandLine& app) {
  auto options = std::make_shared<SimulateOptions>();
  Command* command = app.add_subcommand("simulate", "run a scene and write its states as CSV");
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  command->add_option("-o,--output", options->output,
                      "a .csv file, or - for standard output (default out/NAME.csv); of a scene with several "
                      "panels NAME.1.csv, NAME.2.csv, ...");
  command->add_option("--panel", options->panel, "one panel of a scene that compares several, from 1")
      .range(1, 12);
  command->add_flag("--every-step", options->every_step, "a row a step instead of a row a frame");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel simulate assets/scenes/pp_free.yaml -o out/pp_free.csv");
  command->callback([options] { run_simulate(*options); });
}

}  // namespace chainreel

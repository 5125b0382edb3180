// chainreel simulate SCENE -o FILE.csv

#include <cstdio>
#include <memory>

#include "app/command.hpp"
#include "app/pipeline.hpp"
#include "app/report.hpp"
#include "app/signals.hpp"
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
  CommonOptions common;
};

// t, then q1.. and qd1.. of a serial chain, or q.NAME and qd.NAME of trees and floating bases.
std::string csv_head(const Chain& chain) {
  const bool plain = chain.serial && !chain.has_floating;
  std::string head = "t";
  const std::vector<std::string> q_names = position_names(chain);
  for (int i = 0; i < chain.nq; ++i)
    head += plain ? ",q" + std::to_string(i + 1) : ",q." + q_names[std::size_t(i)];
  for (int i = 0; i < chain.nv; ++i)
    head += plain ? ",qd" + std::to_string(i + 1) : ",qd." + chain.coordinate_names[std::size_t(i)];
  return head + "\n";
}

std::string csv_text(const Chain& chain, const Trajectory& trajectory) {
  std::string text = csv_head(chain);
  for (int k = 0; k < trajectory.size(); ++k) {
    text += format_exact(trajectory.t[std::size_t(k)]);
    for (double value : trajectory.q_at(k)) text += "," + format_exact(value);
    for (double value : trajectory.qd_at(k)) text += "," + format_exact(value);
    text += "\n";
  }
  return text;
}

Trajectory run_scene(const PreparedScene& prepared, bool every_step) {
  const auto stop = [](double) { return interrupted(); };
  if (every_step) return simulate_every_step(prepared.simulation, stop);
  std::vector<double> times = frame_times(prepared.scene);
  const double duration = prepared.scene.duration;
  // One row at the end exactly, and no frame within round-off before it.
  while (!times.empty() && times.back() > duration - same_instant(prepared.simulation)) times.pop_back();
  times.push_back(duration);
  return simulate(prepared.simulation, times, stop);
}

void run_simulate(const SimulateOptions& options) {
  const PreparedScene prepared = load_scene(options.scene, overrides_of(options.common), false);
  std::string output = options.output;
  if (output.empty()) output = "out/" + prepared.scene.name + ".csv";
  const bool to_stdout = output == "-";
  if (to_stdout && options.common.json)
    throw Error(ExitCode::usage, "-o - and --json both write to standard output: name a file");

  std::unique_ptr<OutputFile> file;
  if (!to_stdout) file = std::make_unique<OutputFile>(output, options.common.force);
  const Trajectory trajectory = run_scene(prepared, options.every_step);
  throw_if_interrupted();
  const std::string text = csv_text(prepared.simulation.chain, trajectory);
  if (to_stdout) {
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else if (is_complete(trajectory.status)) {
    write_whole(*file, text);
  } else {
    write_partial(*file, text);
  }
  require_finished(trajectory, prepared.scene);

  if (options.common.json) {
    const Audit audit = audit_of(prepared.simulation, trajectory);
    Json report = audit_report(prepared, trajectory, audit, {});
    report.erase("seconds");
    report["rows"] = trajectory.size();
    report["file"] = output;
    std::puts(report.dump(2).c_str());
  } else if (!options.common.quiet && !to_stdout) {
    std::printf("%s  %d rows\n", output.c_str(), trajectory.size());
  }
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand("simulate", "run a scene and write its states as CSV");
  command->add_option("scene", options->scene, "a scene file")->required();
  command->add_option("-o,--output", options->output,
                      "a .csv file, or - for standard output (default out/NAME.csv)");
  command->add_flag("--every-step", options->every_step, "a row a step instead of a row a frame");
  add_common_options(*command, options->common);
  command->footer("Example: chainreel simulate assets/scenes/pp_free.yaml -o out/pp_free.csv");
  command->callback([options] { run_simulate(*options); });
}

}  // namespace chainreel

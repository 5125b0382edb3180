// chainreel inverse MODEL|SCENE --trajectory q.csv -o tau.csv

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/film/model_scene.hpp"
#include "app/report/report.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/drive/reference.hpp"
#include "sim/inverse_along.hpp"

namespace chainreel {
namespace {

struct InverseOptions {
  std::string file;
  std::string trajectory;
  std::string output;
  std::string gravity;
  CommonOptions common;
};

// What moves: a model, or a scene's mechanism with its constraints and the forces to press on them.
struct Mechanism {
  Chain chain;
  ConstraintPlan constraints;
};

Mechanism load_mechanism(const InverseOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.gravity.empty()) overrides.push_back(gravity_override(options.gravity));
  if (is_model_file(options.file)) {
    ModelScene model = model_scene_of(options.file, overrides, "inverse", keys_of_models(OfModel::mechanism));
    model.options.meshes = false;
    return {read_chain(options.file, model.options), {}};
  }
  Scene scene = read_scene(options.file, overrides);
  require_single_run(scene);
  Simulation simulation = prepare(scene, false);
  return {std::move(simulation.chain), std::move(simulation.constraints)};
}

// A row per instant of the trajectory: t,tau1.. and the multipliers that go with them.
std::string table_of(const InverseAlong& inverse) {
  std::string text = "t";
  for (std::size_t i = 1; i <= inverse.nv; ++i) text += ",tau" + std::to_string(i);
  for (std::size_t i = 1; i <= inverse.rows.size(); ++i) text += ",lambda" + std::to_string(i);
  for (std::size_t k = 0; k < inverse.t.size(); ++k) {
    text += "\n" + format_exact(inverse.t[k]);
    for (std::size_t i = 0; i < inverse.nv; ++i) text += "," + format_exact(inverse.tau[k * inverse.nv + i]);
    for (std::size_t i = 0; i < inverse.rows.size(); ++i)
      text += "," + format_exact(inverse.lambda[k * inverse.rows.size() + i]);
  }
  return text + "\n";
}

Json report_of(const InverseAlong& inverse, const std::string& output) {
  Json json{{"file", output}, {"rows", inverse.t.size()}};
  if (!inverse.rows.empty())
    json["constraints"] = {{"rows", inverse.rows},
                           {"position_error", inverse.position_error},
                           {"velocity_error", inverse.velocity_error},
                           {"acceleration_error", inverse.acceleration_error}};
  return json;
}

void run_inverse(const InverseOptions& options) {
  const Mechanism mechanism = load_mechanism(options);
  if (mechanism.chain.has_floating)
    throw Error(ExitCode::bad_input, "a floating base follows no given joint motion: take --base fixed",
                {options.file});
  std::string output = options.output;
  if (output.empty())
    output = "out/" + std::filesystem::path(options.trajectory).stem().string() + "_tau.csv";
  const bool to_stdout = output == "-";
  if (to_stdout && options.common.json)
    throw Error(ExitCode::usage, "-o - and --json both write to standard output: name a file");
  const InverseAlong inverse = inverse_along(mechanism.chain, mechanism.constraints, options.trajectory);
  const std::string text = table_of(inverse);
  if (to_stdout) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  write_text_file(output, text, options.common.force);
  if (options.common.json)
    std::puts(report_of(inverse, output).dump(2).c_str());
  else if (!options.common.quiet)
    std::printf("%s  %zu rows\n", output.c_str(), inverse.t.size());
}

}  // namespace

void add_inverse_command(CommandLine& app) {
  auto options = std::make_shared<InverseOptions>();
  Command* command = app.add_subcommand(
      "inverse", "the torques that a motion takes, from CSV to CSV; of a scene while it presses on its constraints");
  command
      ->add_option("file", options->file,
                   "a model (.urdf), or a scene (.yaml) for its mechanism with constraints and contact_force; "
                   "constraints that are not pressed bear nothing")
      .required()
      .names_input();
  command
      ->add_option("--trajectory", options->trajectory,
                   "a .csv with t,q1.. and maybe qd1.., qdd1.. (else splines)")
      .required();
  command->add_option("-o,--output", options->output, "a .csv file, or - (default out/TRAJECTORY_tau.csv)");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel inverse models/rr.urdf --trajectory out/rr_free.csv -o out/tau.csv");
  command->callback([options] { run_inverse(*options); });
}

}  // namespace chainreel

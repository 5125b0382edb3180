// chainreel inverse MODEL|SCENE --trajectory q.csv -o tau.csv

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/table_files.hpp"
#include "app/film/model_scene.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/run_report.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "scene/run/prepare.hpp"
#include "scene/run/scene_doubts.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/drive/reference.hpp"
#include "sim/inverse_along.hpp"

namespace chainreel {
namespace {

struct InverseOptions {
  std::string file;
  std::string trajectory;
  std::vector<std::string> outputs;
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
    Mechanism mechanism{read_chain(options.file, model.options), {}};
    if (const std::string doubt = doubt_of_gravity(mechanism.chain); !doubt.empty()) tell_warnings({doubt});
    return mechanism;
  }
  Scene scene = read_scene(options.file, overrides);
  require_single_run(scene);
  if (scene.motion)
    throw Error(ExitCode::bad_input,
                "shows a recorded motion of its own: `chainreel simulate` writes its torques, by inverse dynamics, too",
                scene.place_of("motion"));
  Simulation simulation = prepare(scene, false);
  for (const std::string& doubt : scene.doubts) tell_warnings({scene.name + ": " + doubt});
  return {std::move(simulation.chain), std::move(simulation.constraints)};
}

// A row per instant of the trajectory: t,tau1.. and the multipliers that go with them.
DataTable table_of(const Chain& chain, const InverseAlong& inverse) {
  DataTable table;
  table.rows = inverse.t.size();
  table.add("t", "s", inverse.t);
  table.add("tau", torque_columns(chain), {inverse.nv}, inverse.tau);
  if (!inverse.rows.empty()) table.add("lambda", multiplier_columns(int(inverse.rows.size())), {inverse.rows.size()}, inverse.lambda);
  return table;
}

Json report_of(const InverseAlong& inverse) {
  Json json{{"rows", inverse.t.size()}};
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
  std::vector<std::string> outputs = options.outputs;
  if (outputs.empty()) outputs.push_back("out/" + std::filesystem::path(options.trajectory).stem().string() + "_tau.csv");
  TableFiles files(outputs, options.common);
  const InverseAlong inverse = inverse_along(mechanism.chain, mechanism.constraints, options.trajectory);
  files.write(table_of(mechanism.chain, inverse));
  files.tell(options.common, inverse.t.size(), report_of(inverse));
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
  add_table_option(*command, options->outputs, "out/TRAJECTORY_tau.csv");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel inverse rr.urdf --trajectory out/rr_free.csv -o out/tau.csv");
  command->callback([options] { run_inverse(*options); });
}

}  // namespace chainreel

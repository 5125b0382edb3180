// chainreel inverse MODEL|SCENE --trajectory q.csv -o tau.csv

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/command.hpp"
#include "app/cli/table_files.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/runs.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/peaks.hpp"
#include "app/report/run_report.hpp"
#include "app/today/table_record.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "scene/run/prepare.hpp"
#include "scene/run/scene_doubts.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/drive/recorded_motion.hpp"
#include "sim/inverse_along.hpp"

namespace chainreel {
namespace {

struct InverseOptions {
  std::string file;
  std::string trajectory;
  std::vector<std::string> outputs;
  std::string gravity;
  const Command* command = nullptr;
  CommonOptions common;
};

// What moves, a model or a scene's mechanism with its constraints and the forces to press on them; and how.
struct Recorded {
  Chain chain;
  ConstraintPlan constraints;
  std::shared_ptr<const RecordedMotion> motion;
  std::optional<Scene> scene{};  // none of a model
};

std::shared_ptr<const RecordedMotion> motion_of(const Chain& chain, const InverseOptions& options) {
  if (chain.has_floating)
    throw Error(ExitCode::bad_input, "a floating base follows no given joint motion: take --base fixed", {options.file});
  if (options.trajectory.empty())
    throw Error(ExitCode::usage, "--trajectory is required: the motion, t,q1.. as CSV; or a scene with the key motion in the place of " + options.file);
  const ColumnNames usual;
  return std::make_shared<const RecordedMotion>(chain, std::make_shared<const Table>(read_log(options.trajectory, usual)), usual);
}

Recorded load(const InverseOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.gravity.empty()) overrides.push_back(gravity_override(options.gravity));
  if (is_model_file(options.file)) {
    ModelScene model = model_scene_of(options.file, overrides, "inverse", keys_of_models(OfModel::mechanism));
    model.options.meshes = false;
    Recorded recorded{read_chain(options.file, model.options), {}, nullptr};
    tell_warnings(recorded.chain.slips);
    if (const std::string doubt = doubt_of_gravity(recorded.chain); !doubt.empty()) tell_warnings({doubt});
    recorded.motion = motion_of(recorded.chain, options);
    return recorded;
  }
  Scene scene = read_scene(options.file, overrides);
  require_single_run(scene);
  if (scene.motion && !options.trajectory.empty())
    throw Error(ExitCode::bad_input, "shows a recorded motion of its own: leave --trajectory out for its torques", scene.place_of("motion"));
  if (!scene.push.empty())
    throw Error(ExitCode::bad_input, "`push` acts at instants of a run, which a motion of a table does not have: leave it out, --set push=, for the "
                                     "torques of the motion alone", scene.place_of("push"));
  Simulation simulation = prepare(scene, false);
  for (const std::string& doubt : scene.doubts) tell_warnings({scene.name + ": " + doubt});
  Recorded recorded{std::move(simulation.chain), std::move(simulation.constraints), simulation.motion, std::move(scene)};
  if (!recorded.motion) recorded.motion = motion_of(recorded.chain, options);
  return recorded;
}

// What speaks against the motion; of a scene that holds it, its doubts have been told.
void tell_doubts(const InverseOptions& options, const RecordedMotion& motion, const InverseAlong& inverse) {
  if (!options.trajectory.empty()) tell_warnings(motion.doubts());
  if (options.common.quiet) return;
  for (const LimitEvent& limit : inverse.limits) std::fprintf(stderr, "%s\n", to_string(limit).c_str());
  for (const std::string& remark : motion.remarks(motion.own_torques_beside(inverse.tau))) std::fprintf(stderr, "%s\n", remark.c_str());
}

// A row per instant of the trajectory: t,tau1.. and the multipliers that go with them.
DataTable table_of(const Recorded& recorded, const InverseAlong& inverse) {
  DataTable table;
  table.rows = inverse.t.size();
  table.add("t", "s", inverse.t);
  table.add("tau", torque_columns(recorded.chain), {inverse.nv}, inverse.tau);
  if (!inverse.rows.empty()) table.add("lambda", multiplier_columns(recorded.chain, recorded.constraints.list), {inverse.rows.size()}, inverse.lambda);
  return table;
}

Json report_of(const RecordedMotion& motion, const InverseAlong& inverse, const std::vector<NamedPeak>& peaks) {
  Json json{{"rows", inverse.t.size()}, {"peaks", to_json(peaks)}, {"limits_passed", to_json(inverse.limits)}, {"coarse_torques", nullptr}};
  if (const auto& coarse = motion.coarse_torques()) json["coarse_torques"] = {{"largest_difference", coarse->largest}, {"t", coarse->t}, {"freedom", coarse->freedom}};
  json["constraints"] = nullptr;
  if (!inverse.rows.empty())
    json["constraints"] = {{"rows", inverse.rows},
                           {"position_error", inverse.position_error},
                           {"velocity_error", inverse.velocity_error},
                           {"acceleration_error", inverse.acceleration_error}};
  return json;
}

void run_inverse(const InverseOptions& options) {
  const Recorded recorded = load(options);
  const std::string& table = recorded.motion->table().file;
  std::vector<std::string> outputs = options.outputs;
  if (outputs.empty()) outputs.push_back("out/" + std::filesystem::path(table).stem().string() + "_tau.csv");
  TableFiles files(outputs, options.common);
  TableRecords records(*options.command, options.common.force);
  records.open(outputs, outputs);
  const InverseAlong inverse = inverse_along(recorded.chain, recorded.constraints, *recorded.motion);
  tell_doubts(options, *recorded.motion, inverse);
  const DataTable found = table_of(recorded, inverse);
  const std::vector<NamedPeak> peaks = peaks_of(found);
  files.write(found);
  records.write();
  files.tell(options.common, inverse.t.size(), report_of(*recorded.motion, inverse, peaks), words_of(peaks));
  if (!recorded.scene) return;
  Trajectory ended;
  ended.limits = inverse.limits;
  require_expected_end(ended, *recorded.scene);
}

}  // namespace

void add_inverse_command(CommandLine& app) {
  auto options = std::make_shared<InverseOptions>();
  Command* command = app.add_subcommand(
      "inverse", "the torques that a motion takes, from CSV to CSV; of a scene while it presses on its constraints");
  options->command = command;
  command
      ->add_option("file", options->file,
                   "a model (.urdf), or a scene (.yaml) for its mechanism with constraints and contact_force; "
                   "constraints that are not pressed bear nothing; of a scene with `motion:` its own table, at its rows")
      .required()
      .names_input();
  command
      ->add_option("--trajectory", options->trajectory,
                   "a .csv with t,q1.. and maybe qd1.., qdd1.. (else splines); columns of other names and units are told "
                   "in a scene: `motion: {csv: log.csv, columns: {time: stamp, shoulder: \"pos_1 [deg]\"}}`");
  add_table_option(*command, options->outputs, "out/TRAJECTORY_tau.csv");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel inverse rr.urdf --trajectory out/rr_free.csv -o out/tau.csv\n"
                  "of what  chainreel simulate rr_free  writes");
  command->callback([options] { run_inverse(*options); });
}

}  // namespace chainreel

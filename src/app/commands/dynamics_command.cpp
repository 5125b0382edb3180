// chainreel dynamics MODEL --q .. [--qd ..] [--tau ..] | SCENE [--at ..]; [--gravity ..] [--formulation ..] [--json]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/cli/named_pose.hpp"
#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/film/automatic.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/lagrange.hpp"
#include "model/read_chain.hpp"
#include "scene/quantity.hpp"
#include "scene/run/scene_doubts.hpp"
#include "sim/instant.hpp"

namespace chainreel {
namespace {

struct DynamicsOptions {
  std::string file;
  std::string at;  // of a scene; "": 0
  int panel = 0;   // of a scene, from 1; 0: the only one
  std::string q, qd, tau, gravity, end_effector;
  std::string formulation = "newton_euler";
  std::string task = "linear";
  CommonOptions common;
};

struct State {
  std::vector<double> q, qd, tau;
};

// What the command line says of the mechanism, in the words of a scene.
std::vector<std::string> overrides_of(const DynamicsOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.gravity.empty()) overrides.push_back(gravity_override(options.gravity));
  if (!options.end_effector.empty())
    overrides.push_back("end_effector=" + Json(options.end_effector).dump());
  return overrides;
}

Chain load_chain(const DynamicsOptions& options) {
  std::vector<std::string> honoured = keys_of_models(OfModel::mechanism);
  honoured.push_back("end_effector");
  ModelScene model = model_scene_of(options.file, overrides_of(options), "dynamics", honoured);
  model.options.meshes = false;
  Chain chain = read_chain(options.file, model.options);
  tell_warnings(chain.slips);
  if (const std::string doubt = doubt_of_gravity(chain); !doubt.empty()) tell_warnings({doubt});
  return chain;
}

Json list(const std::vector<double>& values) {
  return to_json(std::span<const double>(values));
}

Json list(const Eigen::VectorXd& values) {
  return to_json(std::span<const double>(values.data(), std::size_t(values.size())));
}

// M, nle, tau_g, qdd from the recursions.
void add_newton_euler(Json& json, const Chain& chain, Workspace& ws, const State& state) {
  compute_mass_matrix(chain, ws, state.q);
  json["M"] = to_json(ws.M);
  compute_nle(chain, ws, state.q, state.qd);
  json["nle"] = list(ws.nle);
  compute_gravity_torque(chain, ws, state.q);
  json["tau_g"] = list(ws.tau_g);
  compute_forward_dynamics(chain, ws, state.q, state.qd, state.tau);
  json["qdd"] = list(ws.qdd);
}

// The same from the two energies alone.
void add_lagrange(Json& json, const Chain& chain, const State& state) {
  const LagrangeDynamics lagrange = lagrange_dynamics_of(chain, state.q, state.qd, state.tau);
  json["M"] = to_json(lagrange.M);
  json["nle"] = list(lagrange.nle);
  json["tau_g"] = list(lagrange.tau_g);
  json["qdd"] = list(lagrange.qdd);
}

void add_split(Json& json, const Chain& chain, Workspace& ws, const State& state) {
  const Eigen::MatrixXd C = coriolis_matrix_of(chain, state.q, state.qd);
  const Eigen::Map<const Eigen::VectorXd> qd(state.qd.data(), Eigen::Index(state.qd.size()));
  json["C"] = to_json(C);
  json["C_qd"] = list(Eigen::VectorXd(C * qd));
  compute_friction(chain, ws, state.qd);
  json["tau_f"] = list(ws.tau_f);
}

void add_task(Json& json, const TipMass& tip, Workspace& ws, const State& state, Task task) {
  const Chain& chain = tip.chain();
  json["ends"] = Json::array();
  for (const int leaf : chain.leaf_frames) json["ends"].push_back(chain.frames[std::size_t(leaf)].name);
  if (chain.end_effector < 0) {
    for (const char* key : {"end_effector", "x", "xd", "J", "Jd_qd", "basis", "basis_directions", "Lambda_inv", "Lambda", "mobility", "directions",
                            "singular_directions"})
      json[key] = nullptr;
    return;
  }
  compute_kinematics(chain, ws, state.q, state.qd);
  json["end_effector"] = chain.frames[std::size_t(chain.end_effector)].name;
  json["x"] = to_json(frame_position(chain, ws, chain.end_effector));
  json["xd"] = to_json(frame_velocity(chain, ws, chain.end_effector));
  compute_jacobian(chain, ws, state.q, chain.end_effector, task);
  json["J"] = to_json(ws.J);
  compute_jacobian_rate(chain, ws, state.q, state.qd, chain.end_effector, task);
  json["Jd_qd"] = list(ws.Jd_qd);
  add_effective_mass(json, tip.at(ws, state.q, task));
}

std::vector<double> sum_of(const Json& a, const Json& b) {
  std::vector<double> sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum.push_back(a[i].get<double>() + b[i].get<double>());
  return sum;
}

Json energy_report(const Energy& energy, const Momentum& momentum) {
  return {{"kinetic", energy.kinetic},
          {"potential", energy.potential},
          {"linear_momentum", to_json(momentum.linear)},
          {"angular_momentum", to_json(momentum.angular)}};
}

void add_energies(Json& json, const Chain& chain, Workspace& ws, const State& state) {
  json.update(
      energy_report(energy_of(chain, ws, state.q, state.qd), momentum_of(chain, ws, state.q, state.qd)));
  const std::vector<BodyEnergy> bodies = body_energies_of(chain, ws, state.q, state.qd);
  json["fixed_mass"] = chain.bodies[0].inertia.mass;  // kg, whose energy never changes and is left out
  json["bodies"] = Json::array();
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    Json body{{"name", chain.bodies[i].name}};
    body.update(energy_report(bodies[i].energy, bodies[i].momentum));
    json["bodies"].push_back(body);
  }
}

// Numbers of the mechanism without its constraints, but Lambda of the tip under them.
Json report(const TipMass& tip, const State& state, const DynamicsOptions& options) {
  const Chain& chain = tip.chain();
  Workspace ws(chain);
  Json json;
  json["model"] = chain.name;
  json["formulation"] = options.formulation;
  json["gravity"] = to_json(chain.gravity);
  json["q"] = list(state.q);
  json["qd"] = list(state.qd);
  json["tau"] = list(state.tau);
  if (options.formulation == "lagrange")
    add_lagrange(json, chain, state);
  else
    add_newton_euler(json, chain, ws, state);
  add_split(json, chain, ws, state);
  add_task(json, tip, ws, state, options.task == "full" ? Task::full : Task::linear);
  add_energies(json, chain, ws, state);
  json["scene"] = json["t"] = nullptr;
  json["tau_push"] = Json::array();
  json["h"] = sum_of(json["nle"], json["tau_f"]);
  json["constraint_rows"] = json["phi"] = json["J_c"] = json["Jcd_qd"] = json["lambda"] = json["contact_forces"] = Json::array();
  json["constraint_status"] = json["baumgarte_gain"] = nullptr;
  return json;
}

// What ties the mechanism, and the motion that it then has. Contact forces are what it presses on its ties with, in the sign of lambda and of
// the key contact_force; what the layer constraint_force shows, on the robot, is their opposite.
void add_constraints(Json& json, const Instant& now, const ConstraintPlan& plan) {
  json["constraint_rows"] = now.rows;
  json["constraint_status"] = now.status;
  if (plan.stabilize == Stabilization::baumgarte) json["baumgarte_gain"] = plan.gain;
  json["phi"] = list(now.phi);
  json["J_c"] = to_json(now.Jc);
  json["Jcd_qd"] = list(now.Jcd_qd);
  json["lambda"] = list(now.lambda);
  json["contact_forces"] = Json::array();
  for (std::size_t k = 0; k < now.forces.size(); ++k)
    json["contact_forces"].push_back({{"constraint", now.constraints[k]}, {"force", to_json(now.forces[k])}});
}

// The run's own state at that instant, as a film shows it.
Trajectory state_at(const PreparedScene& prepared, double at) {
  const double times[] = {at};
  Trajectory run = simulate(prepared.simulation, times, [](double) { return interrupted(); });
  throw_if_interrupted();
  const bool reached = run.size() == 1 && std::abs(run.t[0] - at) <= same_instant(prepared.simulation);
  if (reached) return run;
  if (!is_complete(run.status)) require_expected_end(run, prepared.scene);
  throw Error(ExitCode::usage, "--at " + format_quantity(at, "s") + ": the run ended at " +
                                   format_quantity(run.end_time, "s") + ", it " + to_string(run.status));
}

Json scene_report(const DynamicsOptions& options) {
  if (!options.q.empty() || !options.qd.empty() || !options.tau.empty())
    throw Error(ExitCode::usage,
                "--q, --qd and --tau go with a model; a scene has the state of its run at --at: to start elsewhere, "
                "take --set 'start.q=[..]' and --set 'torque=[..]'");
  PreparedFilm film = load_film(options.file, overrides_of(options), false);
  PreparedScene& prepared = film.panels[chosen_panel(film.scene, options.panel)];
  const double at = options.at.empty() ? 0 : parse_seconds(options.at, "--at");
  if (!(at >= 0 && at <= film.scene.duration))
    throw Error(ExitCode::usage, "--at " + options.at + " lies outside the scene's duration of " +
                                     format_quantity(film.scene.duration, "s"));
  const Simulation& simulation = prepared.simulation;
  const TipMass tip(simulation.chain, simulation.constraints);
  if (tip.is_constrained() && options.formulation == "lagrange")
    throw Error(ExitCode::usage,
                "--formulation lagrange knows no constraints, which `" + options.file + "` has: leave it out");
  say_choice(prepared, options.common.quiet);
  const Trajectory run = state_at(prepared, at);
  const Instant now = instant_of(simulation, run, 0);
  State state{{run.q_at(0).begin(), run.q_at(0).end()}, {run.qd_at(0).begin(), run.qd_at(0).end()}, now.tau};
  for (std::size_t i = 0; i < now.tau_push.size(); ++i) state.tau[i] += now.tau_push[i];
  Json json = report(tip, state, options);
  json["tau"] = list(now.tau);
  json["tau_push"] = list(now.tau_push);
  json["scene"] = options.file;
  json["t"] = at;
  if (options.formulation != "lagrange") json["qdd"] = list(now.qdd);
  if (tip.is_constrained()) add_constraints(json, now, simulation.constraints);
  prepared.simulation.duration = at;  // until there
  warn_of_run(prepared);
  return json;
}

Json model_report(const DynamicsOptions& options) {
  if (!options.at.empty() || options.panel > 0)
    throw Error(ExitCode::usage, "--at and --panel go with a scene; the state of a model is what --q, --qd and --tau say");
  const Chain chain = load_chain(options);
  const State state{parse_pose(chain, named_pose_text(chain, options.file, options.q, "--q"), "--q"), parse_freedoms(chain, options.qd, "--qd", StateNumbers::qd),
                    parse_freedoms(chain, options.tau, "--tau", StateNumbers::tau)};
  return report(TipMass(chain), state, options);
}

std::string text_of(const Json& value) {
  if (value.is_null()) return "none: infinite along singular_directions";
  if (value.is_number()) return format_significant(value.get<double>(), 9);
  if (value.is_string()) return value.get<std::string>();
  std::string text = "[";
  for (const Json& entry : value)
    text += (text.size() > 1 ? (entry.is_array() ? "; " : " ") : "") + text_of(entry);
  return text + "]";
}

void run_dynamics(const DynamicsOptions& options) {
  const Json json = is_model_file(options.file) ? model_report(options) : scene_report(options);
  if (options.common.json) {
    print_json(json);
    return;
  }
  for (const auto& [key, value] : json.items()) {
    const bool may_be_infinite = key == "Lambda" && !json["end_effector"].is_null();
    if (value.empty() && key != "end_effector" && !may_be_infinite) continue;  // null, or a list of nothing
    if (key == "contact_forces")
      for (const Json& one : value)
        std::printf("%-20s %s on %s\n", "contact_force", text_of(one["force"]).c_str(),
                    one["constraint"].get<std::string>().c_str());
    else if (key == "end_effector" && value.is_null())
      std::printf("end_effector         none, as the model has several ends and no link 'gripper': for x, J and Lambda choose one with "
                  "--end-effector NAME: %s\n",
                  joined(json["ends"].get<std::vector<std::string>>()).c_str());
    else if (key == "ends" || (key == "fixed_mass" && value == 0.0))
      continue;
    else if (key == "fixed_mass")
      std::printf("%-20s %s, which `potential` and the momenta leave out: it is fixed to the world\n", key.c_str(), text_of(value).c_str());
    else if (key != "bodies")
      std::printf("%-20s %s\n", key.c_str(), text_of(value).c_str());
  }
}

}  // namespace

void add_dynamics_command(CommandLine& app) {
  auto options = std::make_shared<DynamicsOptions>();
  Command* command =
      app.add_subcommand("dynamics", "M, nle, qdd, J, Lambda and the energies of a model in one state, or of a scene's "
                                     "mechanism at an instant, with J_c and lambda of its constraints");
  command->add_option("file", options->file, "a model (.urdf) or a scene (.yaml)").required().names_input(".urdf");
  command->add_option("--at", options->at, "instant of the scene in seconds (default 0)");
  add_panel_option(*command, options->panel);
  command->add_option("--q", options->q, "of a model: joint positions, --q 0,90deg, or a state of an SRDF beside it: --q home");
  command->add_option("--qd", options->qd, "of a model: joint rates");
  command->add_option("--tau", options->tau, "of a model: joint torques, N m or N");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  command->add_option("--end-effector", options->end_effector, "the link that x, J and Lambda speak of");
  command->add_option("--formulation", options->formulation, "where M, nle, tau_g and qdd come from")
      .one_of({"newton_euler", "lagrange"})
      .show_default();
  command->add_option("--task", options->task, "rows of J: linear velocity, or angular and linear")
      .one_of({"linear", "full"})
      .show_default();
  add_scene_options(*command, options->common);
  add_json_option(*command, options->common);
  add_quiet_option(*command, options->common);
  command->footer("Example: chainreel dynamics rr.urdf --q 0,90deg --json");
  command->callback([options] { run_dynamics(*options); });
}

}  // namespace chainreel

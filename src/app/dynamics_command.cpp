// chainreel dynamics MODEL --q .. [--qd ..] [--tau ..] [--gravity ..] [--formulation ..] [--json]

#include <cstdio>
#include <memory>

#include "app/command.hpp"
#include "app/report.hpp"
#include "core/format.hpp"
#include "dynamics/coriolis.hpp"
#include "dynamics/crba.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/forward_dynamics.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/jacobian.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/lagrange.hpp"
#include "dynamics/rnea.hpp"
#include "model/read_chain.hpp"

namespace chainreel {
namespace {

struct DynamicsOptions {
  std::string model;
  std::string q, qd, tau, gravity, end_effector;
  std::string formulation = "newton_euler";
  std::string task = "linear";
  CommonOptions common;
};

struct State {
  std::vector<double> q, qd, tau;
};

Chain load_chain(const DynamicsOptions& options) {
  ModelOptions model = model_options_of(options.common);
  model.meshes = false;
  model.end_effector = options.end_effector;
  if (!options.gravity.empty()) model.gravity = parse_gravity(options.gravity);
  Chain chain = read_chain(options.model, model);
  require_end_effector(chain);
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

void add_task(Json& json, const Chain& chain, Workspace& ws, const State& state, Task task) {
  compute_kinematics(chain, ws, state.q, state.qd);
  json["end_effector"] = chain.frames[std::size_t(chain.end_effector)].name;
  json["x"] = to_json(frame_position(chain, ws, chain.end_effector));
  json["xd"] = to_json(frame_velocity(chain, ws, chain.end_effector));
  compute_jacobian(chain, ws, state.q, chain.end_effector, task);
  json["J"] = to_json(ws.J);
  compute_jacobian_rate(chain, ws, state.q, state.qd, chain.end_effector, task);
  json["Jd_qd"] = list(ws.Jd_qd);
  add_effective_mass(json, effective_mass_of(chain, ws, state.q, chain.end_effector, task));
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
  json["bodies"] = Json::array();
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    Json body{{"name", chain.bodies[i].name}};
    body.update(energy_report(bodies[i].energy, bodies[i].momentum));
    json["bodies"].push_back(body);
  }
}

Json report(const Chain& chain, const State& state, const DynamicsOptions& options) {
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
  add_task(json, chain, ws, state, options.task == "full" ? Task::full : Task::linear);
  add_energies(json, chain, ws, state);
  return json;
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
  const Chain chain = load_chain(options);
  const State state{parse_pose(chain, options.q, "--q"), parse_freedoms(chain, options.qd, "--qd"),
                    parse_freedoms(chain, options.tau, "--tau")};
  const Json json = report(chain, state, options);
  if (options.common.json) {
    std::puts(json.dump(2).c_str());
    return;
  }
  for (const auto& [key, value] : json.items())
    if (key != "bodies") std::printf("%-20s %s\n", key.c_str(), text_of(value).c_str());
}

}  // namespace

void add_dynamics_command(CommandLine& app) {
  auto options = std::make_shared<DynamicsOptions>();
  Command* command =
      app.add_subcommand("dynamics", "M, nle, qdd, J, Lambda and the energies of a model in one state");
  command->add_option("model", options->model, "a model (.urdf)").required();
  command->add_option("--q", options->q, "joint positions: --q 0,90deg");
  command->add_option("--qd", options->qd, "joint rates");
  command->add_option("--tau", options->tau, "joint torques, N m or N");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  command->add_option("--end-effector", options->end_effector, "the link that x, J and Lambda speak of");
  command->add_option("--formulation", options->formulation, "where M, nle, tau_g and qdd come from")
      .one_of({"newton_euler", "lagrange"})
      .show_default();
  command->add_option("--task", options->task, "rows of J: linear velocity, or angular and linear")
      .one_of({"linear", "full"})
      .show_default();
  add_common_options(*command, options->common);
  command->footer("Example: chainreel dynamics models/rr.urdf --q 0,90deg --json");
  command->callback([options] { run_dynamics(*options); });
}

}  // namespace chainreel

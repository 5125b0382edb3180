// chainreel dynamics MODEL --q .. [--qd ..] [--tau ..] [--gravity ..] [--json]

#include <cstdio>
#include <memory>

#include "app/command.hpp"
#include "app/report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/crba.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/forward_dynamics.hpp"
#include "dynamics/jacobian.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/rnea.hpp"
#include "model/read_chain.hpp"

namespace chainreel {
namespace {

struct DynamicsOptions {
  std::string model;
  std::string q, qd, tau, gravity, end_effector;
  CommonOptions common;
};

struct State {
  std::vector<double> q, qd, tau;
};

Chain load_chain(const DynamicsOptions& options) {
  ModelOptions model;
  model.meshes = false;
  model.end_effector = options.end_effector;
  if (!options.gravity.empty()) {
    const std::vector<double> g = parse_list(options.gravity, "--gravity");
    if (g.size() != 3)
      throw Error(ExitCode::usage, "--gravity takes three numbers, world x,y,z: --gravity 0,-9.81,0");
    model.gravity = Eigen::Vector3d(g[0], g[1], g[2]);
  }
  Chain chain = read_chain(options.model, model);
  require_end_effector(chain);
  return chain;
}

Json report(const Chain& chain, const State& state) {
  Workspace ws(chain);
  const auto list = [](const std::vector<double>& values) {
    return to_json(std::span<const double>(values));
  };
  Json json;
  json["model"] = chain.name;
  json["gravity"] = to_json(chain.gravity);
  json["q"] = list(state.q);
  json["qd"] = list(state.qd);
  json["tau"] = list(state.tau);
  compute_mass_matrix(chain, ws, state.q);
  json["M"] = to_json(ws.M);
  compute_nle(chain, ws, state.q, state.qd);
  json["nle"] = list(ws.nle);
  compute_gravity_torque(chain, ws, state.q);
  json["tau_g"] = list(ws.tau_g);
  compute_forward_dynamics(chain, ws, state.q, state.qd, state.tau);
  json["qdd"] = list(ws.qdd);
  compute_kinematics(chain, ws, state.q, state.qd);
  json["end_effector"] = chain.frames[std::size_t(chain.end_effector)].name;
  json["x"] = to_json(frame_position(chain, ws, chain.end_effector));
  json["xd"] = to_json(frame_velocity(chain, ws, chain.end_effector));
  compute_jacobian(chain, ws, state.q, chain.end_effector, Task::linear);
  json["J"] = to_json(ws.J);
  add_effective_mass(json, effective_mass_of(chain, ws, state.q, chain.end_effector, Task::linear));
  const Energy energy = energy_of(chain, ws, state.q, state.qd);
  json["kinetic"] = energy.kinetic;
  json["potential"] = energy.potential;
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
  const Json json = report(chain, state);
  if (options.common.json) {
    std::puts(json.dump(2).c_str());
    return;
  }
  for (const auto& [key, value] : json.items())
    std::printf("%-20s %s\n", key.c_str(), text_of(value).c_str());
}

}  // namespace

void add_dynamics_command(CLI::App& app) {
  auto options = std::make_shared<DynamicsOptions>();
  CLI::App* command =
      app.add_subcommand("dynamics", "M, nle, qdd, J, Lambda and the energies of a model in one state");
  command->add_option("model", options->model, "a model (.urdf)")->required();
  command->add_option("--q", options->q, "joint positions: --q 0,90deg");
  command->add_option("--qd", options->qd, "joint rates");
  command->add_option("--tau", options->tau, "joint torques, N m or N");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  command->add_option("--end-effector", options->end_effector, "the link that x, J and Lambda speak of");
  add_common_options(*command, options->common);
  command->footer("Example: chainreel dynamics models/rr.urdf --q 0,90deg --json");
  command->callback([options] { run_dynamics(*options); });
}

}  // namespace chainreel

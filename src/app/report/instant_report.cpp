#include "app/report/instant_report.hpp"

#include "app/report/report.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/kinematics.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

// Its name and where it is, by kinematics that were computed.
Json end_effector_json(const Chain& chain, const Workspace& ws) {
  return {{"name", chain.frames[std::size_t(chain.end_effector)].name}, {"x", to_json(frame_position(chain, ws, chain.end_effector))}};
}

}  // namespace

Json sample_report(const Simulation& simulation, const Trajectory& trajectory, int k) {
  const Chain& chain = simulation.chain;
  const ConstVec q = trajectory.q_at(k), qd = trajectory.qd_at(k);
  const double t = trajectory.t[std::size_t(k)];
  ChainSystem system(simulation);
  hold_as_then(system, simulation, trajectory, t);
  const ConstVec tau = system.torque(t, q, qd);
  Json json{{"t", t}, {"q", to_json(q)}, {"qd", to_json(qd)}, {"tau", to_json(tau)}, {"lambda", to_json(trajectory.lambda_at(k))}};
  simulation.torque->leave_pieces();
  Workspace ws(chain);
  const Energy energy = energy_of(chain, ws, q, qd);
  json["kinetic"] = energy.kinetic;
  json["potential"] = energy.potential;
  json["end_effector"] = nullptr;
  if (chain.end_effector < 0) return json;
  json["end_effector"] = end_effector_json(chain, ws);
  json["end_effector"]["xd"] = to_json(frame_velocity(chain, ws, chain.end_effector));
  return json;
}

Json pose_report(const Chain& chain, ConstVec q) {
  Json json{{"q", to_json(q)}};
  json["end_effector"] = nullptr;
  if (chain.end_effector < 0) return json;
  Workspace ws(chain);
  const std::vector<double> still(std::size_t(chain.nv));
  compute_kinematics(chain, ws, q, still);
  json["end_effector"] = end_effector_json(chain, ws);
  return json;
}

}  // namespace chainreel

// Runs that show a recorded motion.
#include "sim/drive/recorded_motion.hpp"
#include "sim/simulate.hpp"

namespace chainreel {
namespace {

// What reports call the method of a run that has none.
const Method& replay_method() {
  static const Method method = [] {
    Method row = find_method("rk4");  // for the price of what is not done
    row.name = "replay";
    row.title = "recorded motion";
    row.kind = "no method";
    row.source = "the table";
    row.order = row.dense_order = 3;  // of the spline between rows
    row.adaptive = true;
    row.make_stepper = nullptr;
    row.make = nullptr;
    return row;
  }();
  return method;
}

}  // namespace

void replay(Simulation& simulation, std::shared_ptr<const RecordedMotion> motion) {
  const auto n = std::size_t(simulation.chain.nv);
  apply({&replay_method(), {}, 0}, simulation);
  simulation.torque = make_replay_torque(simulation.chain, motion);
  simulation.q0.resize(n);
  simulation.qd0.resize(n);
  std::vector<double> qdd(n);
  motion->evaluate(0, simulation.q0, simulation.qd0, qdd);
  simulation.motion = std::move(motion);
}

}  // namespace chainreel

#include "sim/runs.hpp"

#include "model/read_chain.hpp"

namespace chainreel {

Simulation run_of(const std::string& model, const std::vector<std::string>& torque, double duration,
                  const std::string& method, double step) {
  Simulation run;
  run.chain = read_chain("models/" + model + ".urdf");
  run.q0 = zero_configuration(run.chain);
  run.qd0.resize(std::size_t(run.chain.nv));
  std::vector<TorqueEntry> entries(std::size_t(run.chain.nv));
  for (std::size_t i = 0; i < torque.size(); ++i) entries[i].text = torque[i];
  run.torque = make_torque_law(run.chain, entries, {});
  run.method = &find_method(method);
  run.step = step;
  run.duration = duration;
  return run;
}

std::vector<double> instants(double end, double dt) {
  std::vector<double> times;
  for (int k = 0; k * dt <= end * (1 + 1e-12); ++k) times.push_back(k * dt);
  return times;
}

}  // namespace chainreel

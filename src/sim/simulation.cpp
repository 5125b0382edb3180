// What stands ready to be run.
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "sim/simulate.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/system/forms.hpp"

namespace chainreel {

ChainSystem::ChainSystem(const Simulation& simulation)
    : ChainSystem(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints) {}

void apply(const MethodSetting& setting, Simulation& simulation) {
  simulation.method = setting.method;
  simulation.options = setting.options;
  simulation.step = setting.step;
}

void check_method(const Simulation& simulation) {
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  const ChainForms forms(system, *simulation.method);
}

void check_ready(const Simulation& simulation, std::span<const double> times) {
  const auto refuse = [](const std::string& why) { throw Error(ExitCode::usage, "the simulation " + why); };
  const auto size_of = [&](const char* name, const std::vector<double>& values, int wanted) {
    if (values.size() != std::size_t(wanted))
      refuse("has " + std::to_string(values.size()) + " numbers of " + name + ", the chain " + std::to_string(wanted));
  };
  if (simulation.method == nullptr) refuse("has no method: one of find_method");
  if (!simulation.torque) refuse("has no torque: make_torque_law makes one, that of 0, too");
  size_of("q0", simulation.q0, simulation.chain.nq);
  size_of("qd0", simulation.qd0, simulation.chain.nv);
  for (const auto& [name, value] : {std::pair{"step", simulation.step}, {"duration", simulation.duration}})
    if (!(value >= 0) || !std::isfinite(value)) refuse("has a " + std::string(name) + " of " + format_shortest(value) + " s");
  const double end = simulation.duration + same_instant(simulation);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(times[i] >= (i == 0 ? 0 : times[i - 1])) || !(times[i] <= end))
      refuse("is asked for samples at times that do not rise from 0 to its duration: " + format_shortest(times[i]) + " s");
}

}  // namespace chainreel

// What stands ready to be run.
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

}  // namespace chainreel

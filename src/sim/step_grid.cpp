#include "sim/step_grid.hpp"

namespace chainreel {

double same_instant(const Simulation& simulation) {
  return simulation.step > 0 ? kSameInstant * simulation.step : kSameBreak * simulation.duration;
}

double longest_step_of(const Simulation& simulation) {
  const double own = simulation.longest_step;
  if (simulation.step > 0 || simulation.motion) return own;
  const TorqueLaw& law = *simulation.torque;
  const bool may_change = !law.is_constant() && !law.affine();
  const bool is_watched = (simulation.events && !simulation.events->list.empty()) || !LimitWatch(simulation.chain).are_none();
  if (!may_change && !is_watched) return own;
  const double watchful = std::max(simulation.duration, simulation.whole_duration) / kLeastWatchedSteps;
  return own > 0 ? std::min(own, watchful) : watchful;
}

}  // namespace chainreel

#include "sim/workload.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/format.hpp"
#include "sim/cost_table.hpp"

namespace chainreel {
namespace {

std::string duration_text(double ns) {
  const double hours = ns / 3.6e12;
  return hours < 48 ? format_significant(hours, 2) + " hours"
                    : hours < 17520 ? format_significant(hours / 24, 2) + " days"
                                    : format_significant(hours / 8760, 2) + " years";
}

}  // namespace

double steps_of(const Simulation& simulation) {
  return simulation.step > 0 ? simulation.duration / simulation.step : 0;
}

double least_work(const Simulation& simulation) {
  const double steps = steps_of(simulation);
  return run_cost(simulation.chain, *simulation.method, simulation.options, steps,
                  steps * std::max(1, simulation.method->evaluations_per_step));
}

void require_possible(const Simulation& simulation, double runs) {
  const double steps = steps_of(simulation);
  if (steps > kMostSteps)
    throw Error(ExitCode::limit, "a run of " + format_shortest(simulation.duration) + " s in steps of " +
                                     format_shortest(simulation.step) + " s takes " + format_significant(steps, 3) +
                                     " steps, some " + duration_text(least_work(simulation)) +
                                     "; the most is " + format_shortest(kMostSteps) + " steps: take longer ones");
  require_possible(runs * least_work(simulation), runs);
}

void require_possible(double work, double runs) {
  if (work <= kMostWork) return;
  throw Error(ExitCode::limit, (runs > 1 ? format_significant(runs, 6) + " runs take" : std::string("this run takes")) +
                                   " some " + duration_text(work) +
                                   " by the count of their steps: take fewer, shorter ones or longer steps");
}

}  // namespace chainreel

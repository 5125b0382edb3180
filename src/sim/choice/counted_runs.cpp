#include "sim/choice/counted_runs.hpp"

#include <algorithm>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr int kUsualEvaluations = 4;  // a step, of methods that do not say

// What an evaluation costs more than that of the free chain, and a step.
ConstraintCost price_of_constraints(const Simulation& simulation) {
  if (simulation.constraints.empty()) return {0, 0};
  ConstraintCost cost = constraint_cost(simulation.chain, simulation.constraints);
  cost.evaluation = std::max(0.0, cost.evaluation - forward_dynamics_cost(simulation.chain));
  return cost;
}

}  // namespace

std::string to_string(const MethodSetting& setting) {
  std::string text = setting.method->name;
  if (setting.options.order > 0) text += ", order " + std::to_string(setting.options.order);
  if (setting.step > 0) text += ", step " + format_shortest(setting.step) + " s";
  if (setting.options.tolerance > 0) text += ", tolerance " + format_shortest(setting.options.tolerance);
  return text;
}

bool takes_the_chain(Simulation& simulation, const Method& method) {
  simulation.method = &method;
  try {
    check_method(simulation);
    return true;
  } catch (const Error&) {
    return false;
  }
}

CountedRuns::CountedRuns(Simulation& simulation, double budget, const ChoiceWatch& watch)
    : simulation_(simulation),
      budget_(budget),
      watch_(watch),
      constraints_(price_of_constraints(simulation)),
      torque_(simulation.torque->price(simulation.chain)) {}

CountedRuns::~CountedRuns() {
  simulation_.longest_step = 0;
  simulation_.most_evaluations = 0;
  simulation_.motion_only = false;
}

Trajectory CountedRuns::run(const MethodSetting& setting, std::span<const double> times, double most,
                            double longest_step) {
  apply(setting, simulation_);
  simulation_.longest_step = longest_step;
  const double affordable = std::clamp(std::min(most, left()), 0.0, budget_) / price_of_evaluation(setting);
  simulation_.most_evaluations = std::max(1L, long(affordable));
  simulation_.motion_only = true;
  const std::string doing = to_string(setting);
  const auto stop = [&](double t) { return watch_ && watch_({doing, runs_, spent_ / budget_, t}); };
  Trajectory trajectory = simulate(simulation_, times, stop);
  stopped_ = stopped_ || trajectory.status == RunStatus::interrupted;
  spent_ += cost_of(setting, trajectory);
  ++runs_;
  return trajectory;
}

double CountedRuns::cost_of(const MethodSetting& setting, double steps, double evaluations) const {
  const double free = run_cost(simulation_.chain, *setting.method, setting.options, steps, evaluations);
  return free + evaluations * (constraints_.evaluation + torque_) + steps * constraints_.projection;
}

double CountedRuns::price_of_evaluation(const MethodSetting& setting) const {
  const int evaluations = setting.method->evaluations_per_step;
  return cost_of(setting, 1.0 / (evaluations > 0 ? evaluations : kUsualEvaluations), 1);
}

}  // namespace chainreel

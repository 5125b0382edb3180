// The runs that a choice of method takes, with their cost counted (cost_table.hpp) and a budget for all of them. Never
// timed: what fits into the budget is the same on every machine.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "sim/cost_table.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// "taylor, order 16, tolerance 1e-6".
std::string to_string(const MethodSetting& setting);
// Whether the method takes the chain; it is the simulation's from here on.
bool takes_the_chain(Simulation& simulation, const Method& method);

// What a choice is doing, asked for now and then; true stops it.
struct ChoiceProgress {
  const std::string& doing;  // the setting that runs
  int runs;                  // before it
  double spent;              // of the budget, 0 to 1
  double t;                  // s, that this run has reached
};
using ChoiceWatch = std::function<bool(const ChoiceProgress&)>;

class CountedRuns {
 public:
  // `budget`: ns by the table of costs. References must outlive it.
  CountedRuns(Simulation& simulation, double budget, const ChoiceWatch& watch);
  CountedRuns(const CountedRuns&) = delete;
  CountedRuns& operator=(const CountedRuns&) = delete;
  // Leaves the simulation without bounds on steps and evaluations.
  ~CountedRuns();

  // Sampled at `times`; with RunStatus::out_of_budget behind `most` ns, or what is left of the budget.
  Trajectory run(const MethodSetting& setting, std::span<const double> times, double most,
                 double longest_step = 0);

  // ns, of the whole budget's kind.
  double cost_of(const MethodSetting& setting, double steps, double evaluations) const;
  double cost_of(const MethodSetting& setting, const Trajectory& run) const {
    return cost_of(setting, double(run.steps), double(run.evaluations));
  }
  // ns, of one evaluation and its share of a step.
  double price_of_evaluation(const MethodSetting& setting) const;
  // For work that is no run.
  void spend(double ns) { spent_ += ns; }

  Simulation& simulation() { return simulation_; }
  double budget() const { return budget_; }
  double left() const { return budget_ - spent_; }
  bool is_spent() const { return spent_ >= budget_; }
  bool is_stopped() const { return stopped_; }  // by the watch

 private:
  Simulation& simulation_;
  double budget_;
  const ChoiceWatch& watch_;
  ConstraintCost constraints_{0, 0};  // beyond a free chain's
  double torque_ = 0;                 // of the law, an evaluation
  double spent_ = 0;
  int runs_ = 0;
  bool stopped_ = false;
};

}  // namespace chainreel

// `method: auto`: the cheapest method and step whose error stays below what the scene allows, at every
// point that can be seen and of every curve over time, in every frame, where the torque bends or jumps, and halfway between. Cost is counted (cost_table.hpp), never timed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/accuracy.hpp"
#include "sim/choice/counted_runs.hpp"

namespace chainreel {

struct Choice {
  struct Candidate {
    MethodSetting setting;
    double error = 0;  // no larger over the samples, in the accuracy's unit; the reference's own is added
    // The largest of rates, torques and what else is plotted, a share of the curve's range, likewise with the reference's
    // own; none: not looked at, since the points are too far off already.
    std::optional<double> curve_error;
    std::string curve;  // that is it: "tau2"
    double cost = 0;   // ns by the table
    long steps = 0, evaluations = 0;
    std::string trouble;  // "" where it ran to the end
  };
  Candidate best;
  // s: the best one's cost and counts are those until there, since no candidate came to the end; none: of the whole run.
  std::optional<double> counted_until;
  std::optional<double> cost_to_end;  // ns: at that rate, where the budget alone kept it from the end
  bool is_met = false;                // the best one's errors are below the accuracy and what that allows of curves
  double curve_allowed = 0;           // a share of a curve's range; see share_of_curves
  std::optional<double> holds_until;  // s: what is said of errors holds until there only; none: to the end
  std::string why_until;              // then a clause without end mark: what happens behind that
  std::string reference;              // what they were compared with
  double reference_uncertainty = 0;   // in the accuracy's unit, up to there
  std::optional<double> attainable;   // an accuracy for which it would hold to the end, where that is known
  bool out_of_budget = false;         // the search ended before all candidates were tried
  double spent = 0, budget = 0;       // ns by the table
  std::vector<Candidate> tried;
  std::vector<std::string> remarks;  // clauses without end mark: what was not judged, or not as it is
};

// ns by the table of costs: some seconds.
inline constexpr double kChoiceBudget = 6e9;

// `times`: of the frames. Leaves the best setting in `simulation`. Where the run ends early (a torque that is
// not finite, limits that stop), what can be compared is. Throws Error (numerical) where what is asked for cannot be
// promised for a single frame, (bad input) where its unit judges nothing of this chain.
Choice choose_method(Simulation& simulation, const Accuracy& accuracy, std::span<const double> times,
                     const ChoiceWatch& watch = {}, double budget = kChoiceBudget);

}  // namespace chainreel

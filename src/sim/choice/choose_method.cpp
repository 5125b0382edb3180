#include "sim/choice/choose_method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/scalar.hpp"
#include "sim/choice/choice_reference.hpp"
#include "sim/choice/curve_deviation.hpp"
#include "sim/choice/error_growth.hpp"

namespace chainreel {
namespace {

constexpr double kStepLadder[] = {0.2,  0.1,  0.05, 0.02, 0.01, 5e-3, 2e-3,
                                  1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5};
constexpr double kToleranceLadder[] = {1e-2, 1e-3, 1e-4,  1e-5,  1e-6,  1e-7,
                                       1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
constexpr int kOrders[] = {12, 20};
constexpr std::size_t kMostBreaks = 4000;  // of a torque at which runs are compared; of more, as of long tables, some, evenly
constexpr double kSameInstant = 1e-9;      // of the duration
constexpr double kShareOfCandidate = 0.1;  // of the budget, where nothing is exact enough yet
// Where a part of the run decides, what is cheapest there may be dear behind: candidates are looked at up to this many
// times its cost, and then run to the end with equal bounds, from this share of the budget on.
constexpr double kSpread = 4;
constexpr double kFirstBound = 1e-3;
constexpr double kNextBound = 4;  // times the one before
constexpr double kFarMiss = 10;   // times the accuracy
constexpr double kSmallErrors = 100;  // times the accuracy: up to there errors of a chaotic motion grow with their own size
// Where a method is exact enough with no setting, others are tried up to this many times the cost of the most exact one.
constexpr double kBeyondMostExact = 3;

// Frames show them; what is between two frames is asked for by slow motion, captions and tables. A pulse may come and go there, so that
// they are judged where the torque bends or jumps, too.
std::vector<double> with_breaks(std::span<const double> frames, const std::vector<double>& breaks, double end) {
  std::vector<double> times(frames.begin(), frames.end());
  const std::size_t every = 1 + breaks.size() / kMostBreaks;
  for (std::size_t k = 0; k < breaks.size(); k += every)
    if (breaks[k] > 0 && breaks[k] < end) times.push_back(breaks[k]);
  times.push_back(end);
  std::sort(times.begin(), times.end());
  const double apart = kSameInstant * end;
  times.erase(std::unique(times.begin(), times.end(), [&](double a, double b) { return b - a <= apart; }), times.end());
  while (times.size() > 1 && times.back() > end) times.pop_back();
  return times;
}

std::vector<double> sorted(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list;
}

// .. and halfway between.
std::vector<double> with_halves(const std::vector<double>& instants) {
  std::vector<double> times;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    if (k > 0) times.push_back(0.5 * (instants[k - 1] + instants[k]));
    times.push_back(instants[k]);
  }
  return times;
}

class Chooser {
 public:
  Chooser(Simulation& simulation, const Accuracy& accuracy, std::span<const double> frames,
          const ChoiceWatch& watch, double budget)
      : simulation_(simulation),
        accuracy_(accuracy),
        duration_(simulation.duration),
        whole_duration_(std::max(simulation.duration, simulation.whole_duration)),
        times_(with_halves(with_breaks(frames, sorted(simulation.torque->breaks(duration_)), duration_))),
        runs_(simulation, budget, watch),
        growth_(kSmallErrors * accuracy.value) {
    for (const Method& method : methods())
      if (takes_the_chain(simulation_, method)) methods_.push_back(&method);
    // Adaptive ones first: what they cost bounds the search of all others.
    std::stable_partition(methods_.begin(), methods_.end(), [](const Method* m) { return m->adaptive; });
  }

  Choice choose() {
    check_accuracy(simulation_.chain, accuracy_);
    if (auto quick = find_quick_reference(runs_, accuracy_, times_)) {
      reference_ = std::move(*quick);
      look_through_methods();
    }
    if (!choice_.is_met && !has_ended()) {  // by the most exact reference some may be that are not by a quick one
      choice_ = {};
      most_beyond_.reset();
      growth_ = ErrorGrowth(kSmallErrors * accuracy_.value);
      reference_ = find_reference(runs_, accuracy_, times_);
      if (!runs_.is_stopped()) look_through_methods();
    }
    stay_whole();
    be_exact_behind();
    if (!choice_.best.setting.method) choice_.best.setting = {&find_method("dop853"), {1e-12, 0}, 0};
    apply(choice_.best.setting, simulation_);
    tell_of_reference();
    return std::move(choice_);
  }

 private:
  void look_through_methods() {
    choice_.best.setting = reference_.setting;
    choice_.best.error = kInfinity;
    if (reference_.samples < 2) return;  // the start alone tells nothing
    deviation_.emplace(simulation_, accuracy_, reference_.size);
    choice_.curve_allowed = share_of_curves(accuracy_, reference_.size);
    curves_.emplace(simulation_, reference_, choice_.curve_allowed);
    shorten();
    for (const Method* method : methods_) {
      if (has_ended()) break;
      if (!choice_.is_met && std::isfinite(choice_.best.error)) most_beyond_ = kBeyondMostExact * choice_.best.cost;
      if (method->adaptive)
        try_tolerances(*method);
      else
        try_steps(*method);
    }
    // What is held until there by the reference alone is held by it.
    if (!choice_.is_met && !has_ended()) try_one(reference_.setting);
    if (is_shortened()) confirm();
  }

  // Behind what is known of the motion candidates cannot be told apart: they are run until there, the best to the end.
  void shorten() {
    samples_ = times_;
    if (reference_.is_whole) return;
    samples_.resize(std::size_t(reference_.samples));
    if (!(samples_.back() > 0)) return;
    simulation_.duration = samples_.back();
    simulation_.whole_duration = whole_duration_;
  }
  void stay_whole() {
    simulation_.duration = duration_;
    simulation_.whole_duration = whole_duration_;
  }

  bool is_shortened() const { return samples_.size() < times_.size(); }

  bool has_ended() const { return runs_.is_stopped() || runs_.is_spent(); }

  // The largest of the deviations known, with what the reference itself may be off.
  double error_of(const Trajectory& trajectory) {
    errors_.clear();
    if (trajectory.size() < reference_.samples) return kInfinity;
    for (int k = 0; k < reference_.samples; ++k)
      errors_.push_back(deviation_->at(trajectory, reference_.run, k) + reference_.uncertainty[std::size_t(k)]);
    growth_.learn(errors_);
    return *std::max_element(errors_.begin(), errors_.end());
  }

  // It came to the end, or to that of the motion itself.
  bool ran(const Trajectory& trajectory) const {
    return reference_.is_whole ? trajectory.status == reference_.run.status : is_complete(trajectory.status);
  }

  Choice::Candidate candidate_of(const MethodSetting& setting, const Trajectory& trajectory) {
    Choice::Candidate candidate;
    candidate.setting = setting;
    candidate.error = error_of(trajectory);
    candidate.cost = runs_.cost_of(setting, trajectory);
    candidate.steps = trajectory.steps;
    candidate.evaluations = trajectory.evaluations;
    if (candidate.error <= accuracy_.value) {
      const CurveDeviation::Worst worst = curves_->largest(trajectory);
      candidate.curve_error = worst.share;
      candidate.curve = worst.name;
    }
    if (trajectory.status == RunStatus::out_of_budget)
      candidate.trouble = choice_.is_met     ? "given up: dearer than the best"
                          : most_beyond_ ? "given up: far dearer than the most exact so far"
                                            : "given up: out of the budget";
    else if (!ran(trajectory))
      candidate.trouble = trajectory.trouble.empty() ? "does not end where the motion does" : trajectory.trouble;
    return candidate;
  }

  bool holds(const Choice::Candidate& candidate) const {
    return candidate.trouble.empty() && candidate.error <= accuracy_.value &&
           candidate.curve_error && *candidate.curve_error <= choice_.curve_allowed;
  }

  // Of two that do not hold: points first, then curves.
  static bool is_more_exact(const Choice::Candidate& one, const Choice::Candidate& other) {
    if (one.curve_error && other.curve_error) return *one.curve_error < *other.curve_error;
    if (one.curve_error || other.curve_error) return one.curve_error.has_value();
    return one.error < other.error;
  }

  enum class Verdict {
    met,
    not_met,
    too_dear,  // and so is all that is finer
    stopped,
  };

  // What costs more than the best can be left.
  double ceiling() const {
    const double most = kShareOfCandidate * runs_.budget();
    if (!choice_.is_met) return std::min(most, most_beyond_.value_or(most));
    return is_shortened() ? std::min(most, kSpread * choice_.best.cost) : choice_.best.cost;
  }

  Verdict try_one(const MethodSetting& setting) {
    const Trajectory trajectory = runs_.run(setting, samples_, ceiling());
    if (runs_.is_stopped()) return Verdict::stopped;
    const Choice::Candidate candidate = candidate_of(setting, trajectory);
    const bool met = holds(candidate);
    const bool better = met ? !choice_.is_met || candidate.cost < choice_.best.cost
                            : !choice_.is_met && is_more_exact(candidate, choice_.best);
    if (better) {
      choice_.best = candidate;
      choice_.is_met = met;
    }
    choice_.tried.push_back(candidate);
    if (trajectory.status == RunStatus::out_of_budget) {
      left_out_ = left_out_ || !most_beyond_;
      return Verdict::too_dear;
    }
    return met ? Verdict::met : Verdict::not_met;
  }

  // Takes, of the candidates that hold until there, the one that comes to the end of the whole run for the
  // least. All have the same bound, and a larger one from round to round, until one comes to the end.
  void confirm() {
    choice_.counted_until = samples_.back();
    stay_whole();
    std::vector<Choice::Candidate> racers;
    for (const Choice::Candidate& one : choice_.tried)
      if (holds(one)) racers.push_back(one);
    std::stable_sort(racers.begin(), racers.end(),
                     [](const auto& one, const auto& other) { return one.cost < other.cost; });
    if (racers.empty()) return;
    double bound = std::max(kFirstBound * runs_.budget(), kSpread * racers.front().cost);
    std::optional<Choice::Candidate> winner;
    while (!racers.empty() && !winner && !has_ended()) {
      std::vector<Choice::Candidate> others;
      for (const Choice::Candidate& one : racers) {
        if (has_ended()) break;
        const Trajectory whole = runs_.run(one.setting, times_, winner ? winner->cost : bound);
        const Choice::Candidate run = candidate_of(one.setting, whole);
        if (whole.status == RunStatus::out_of_budget) {
          others.push_back(one);
          keep_furthest(one, run, whole.end_time);
        } else if (holds(run)) {
          winner = run;
        }
      }
      racers = std::move(others);
      bound *= kNextBound;
    }
    if (winner) {
      choice_.best = *winner;
      choice_.counted_until.reset();
      choice_.cost_to_end.reset();
    }
  }

  // Where the motion is known for a part of the run alone, the cheapest there may lose the rest by more than it has to: an exact
  // setting goes on, where it costs little. A finer one than this would stand still where ways cross, as at change points of loops,
  // and leave on that of its own rounding.
  void be_exact_behind() {
    constexpr double kTolerance = 1e-6;
    if (reference_.is_whole || !choice_.is_met || has_ended()) return;
    MethodSetting exact = choice_.best.setting;
    if (!exact.method->adaptive) exact = {&find_method("dop853"), {}, 0};
    if (!takes_the_chain(simulation_, *exact.method) || (exact.options.tolerance > 0 && exact.options.tolerance <= kTolerance)) return;
    exact.options.tolerance = kTolerance;
    const Trajectory whole = runs_.run(exact, times_, kShareOfCandidate * runs_.budget());
    if (runs_.is_stopped() || whole.status == RunStatus::out_of_budget) return;
    const Choice::Candidate candidate = candidate_of(exact, whole);
    choice_.tried.push_back(candidate);
    if (!holds(candidate)) return;
    choice_.remarks.push_back("the cheapest is " + to_string(choice_.best.setting) + ", but the motion is known for a part of the run alone, and the rest is followed more closely");
    choice_.best = candidate;
    choice_.counted_until.reset();
    choice_.cost_to_end.reset();
  }

  // The best as long as none comes to the end: who would cost the least there at the rate so far.
  void keep_furthest(const Choice::Candidate& candidate, const Choice::Candidate& run, double end_time) {
    const double cost_to_end = run.cost * duration_ / end_time;
    const bool longer = to_string(candidate.setting) == to_string(choice_.best.setting);
    if (!(end_time > samples_.back()) || (choice_.cost_to_end && !longer && cost_to_end >= *choice_.cost_to_end)) return;
    choice_.best = run;
    choice_.best.error = candidate.error;
    choice_.best.curve_error = candidate.curve_error;
    choice_.best.curve = candidate.curve;
    choice_.best.trouble.clear();
    choice_.counted_until = end_time;
    choice_.cost_to_end = cost_to_end;
  }

  bool is_hopeless(double cost) const { return choice_.is_met && cost >= ceiling(); }

  // Whether steps as short as may be would miss the accuracy, too, by far, though errors fell an order faster than those of
  // a method of that order. Errors as large as the motion itself fall later than that, and count, where the motion
  // forgets where it came from, as what they would have grown to.
  bool is_out_of_reach(int order, const Choice::Candidate& last) const {
    if ((!choice_.is_met && !most_beyond_) || !std::isfinite(last.error)) return false;
    const double finer = std::max(1.0, ceiling() / last.cost);
    const double error = is_shortened() ? growth_.unbounded(errors_) : last.error;
    return error > kFarMiss * accuracy_.value * std::pow(finer, order + 1);
  }

  void try_steps(const Method& method) {
    for (const double step : kStepLadder) {
      if (step > simulation_.duration) continue;
      const MethodSetting setting{&method, {0, 0}, step};
      const double steps = simulation_.duration / step;
      const double cost = runs_.cost_of(setting, steps, steps * std::max(1, method.evaluations_per_step));
      if (is_hopeless(cost)) return;
      if (cost > ceiling()) {
        left_out_ = left_out_ || !most_beyond_;
        return;
      }
      if (has_ended() || try_one(setting) != Verdict::not_met) return;
      if (is_out_of_reach(method.order, choice_.tried.back())) return;
    }
  }

  void try_tolerances(const Method& method) {
    if (method.highest_order == 0) return try_tolerances(method, 0);
    for (const int order : kOrders) try_tolerances(method, order);
  }

  void try_tolerances(const Method& method, int order) {
    for (const double tolerance : kToleranceLadder) {
      if (has_ended() || try_one({&method, {tolerance, order}, 0}) != Verdict::not_met) return;
      if (is_hopeless(choice_.tried.back().cost)) return;
      if (is_shortened() && is_out_of_reach(order > 0 ? order : method.order, choice_.tried.back())) return;
    }
  }

  void tell_of_reference() {
    choice_.reference = reference_.how;
    tell_what_is_not_judged();
    choice_.attainable = reference_.attainable;
    // What was left out is dearer than a best one that is exact enough.
    choice_.out_of_budget = runs_.is_spent() || (left_out_ && !choice_.is_met);
    choice_.budget = runs_.budget();
    choice_.spent = runs_.budget() - runs_.left();
    for (const double apart : reference_.uncertainty)
      choice_.reference_uncertainty = std::max(choice_.reference_uncertainty, apart);
    if (reference_.is_whole) return;
    choice_.holds_until = reference_.samples > 0 ? times_[std::size_t(reference_.samples) - 1] : 0;
    choice_.why_until = reference_.why_no_further;
  }

  void tell_what_is_not_judged() {
    if (curves_ && !curves_->remark().empty()) choice_.remarks.push_back(curves_->remark());
    if (const auto& links = simulation_.outline.unmeasured; !links.empty())
      choice_.remarks.push_back("in place of meshes that cannot be read, of " + quoted_list(links) +
                                ", boxes of the same mass and inertia are judged");
    if (accuracy_.unit == AccuracyUnit::rad) return;
    if (const auto names = unseen_freedoms(simulation_, reference_.run); !names.empty())
      choice_.remarks.push_back(quoted_list(names) + (names.size() == 1 ? " moves" : " move") +
                                " nothing that can be seen, and no error of that is judged: `accuracy: 1e-3 rad` does");
  }

  Simulation& simulation_;
  Accuracy accuracy_;
  double duration_;            // s, of the whole run
  double whole_duration_;      // s, as the simulation has it, or that
  std::vector<double> times_;  // frames and what is between them
  std::vector<double> samples_;  // of candidates' runs
  CountedRuns runs_;
  ErrorGrowth growth_;
  std::vector<double> errors_;  // of the last candidate, at its samples; empty where it did not come so far
  std::vector<const Method*> methods_;
  ChoiceReference reference_;
  std::optional<Deviation> deviation_;
  std::optional<CurveDeviation> curves_;
  bool left_out_ = false;  // something, for its price
  std::optional<double> most_beyond_;  // where none of the methods so far is exact enough
  Choice choice_;
};

}  // namespace

Choice choose_method(Simulation& simulation, const Accuracy& accuracy, std::span<const double> times,
                     const ChoiceWatch& watch, double budget) {
  return Chooser(simulation, accuracy, times, watch, budget).choose();
}

}  // namespace chainreel

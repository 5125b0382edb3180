#include "sim/choose_method.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"
#include "sim/cost_table.hpp"
#include "sim/deviation.hpp"

namespace chainreel {
namespace {

constexpr double kStepLadder[] = {0.2,  0.1,  0.05, 0.02, 0.01, 5e-3, 2e-3,
                                  1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5};
constexpr double kToleranceLadder[] = {1e-2, 1e-3, 1e-4,  1e-5,  1e-6,  1e-7,
                                       1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
constexpr int kOrders[] = {12, 20};
// Two runs that are each as exact as double precision allows may share this part of what is allowed.
constexpr double kShareOfReference = 0.5;

bool takes_the_chain(Simulation& simulation, const Method& method) {
  simulation.method = &method;
  try {
    check_method(simulation);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// What an evaluation costs more than that of the free chain, and a step.
ConstraintCost price_of_constraints(const Simulation& simulation) {
  ConstraintCost cost = constraint_cost(simulation.chain, simulation.constraints);
  cost.evaluation = std::max(0.0, cost.evaluation - forward_dynamics_cost(simulation.chain));
  return cost;
}

class Chooser {
 public:
  Chooser(Simulation& simulation, const Accuracy& accuracy, std::span<const double> times,
          const StopRequest& stop)
      : simulation_(simulation), accuracy_(accuracy), times_(times), stop_(stop) {
    if (!simulation.constraints.empty()) constraints_ = price_of_constraints(simulation);
    for (const Method& method : methods())
      if (takes_the_chain(simulation_, method)) methods_.push_back(&method);
    // Adaptive ones first: what they cost bounds the search of all others.
    std::stable_partition(methods_.begin(), methods_.end(), [](const Method* m) { return m->adaptive; });
  }

  Choice choose() {
    find_reference();
    for (const Method* method : methods_) {
      if (stopped_) break;
      if (method->adaptive)
        try_tolerances(*method);
      else
        try_steps(*method);
    }
    apply(choice_.best.setting, simulation_);
    return std::move(choice_);
  }

 private:
  Trajectory run(const MethodSetting& setting) {
    apply(setting, simulation_);
    Trajectory trajectory = simulate(simulation_, times_, stop_);
    stopped_ = stopped_ || trajectory.status == RunStatus::interrupted;
    return trajectory;
  }

  const Method* one_that_fits(const char* name) const {
    for (const Method* method : methods_)
      if (method->name == name) return method;
    return nullptr;
  }

  // Two runs that share no text where that can be had; up to where they part no third can be called exact.
  void find_reference() {
    const Method* const series = one_that_fits("taylor");
    const Method* const general = one_that_fits("dop853");
    reference_ = run(series ? MethodSetting{series, {1e-15, 24}, 0} : MethodSetting{general, {1e-14, 0}, 0});
    const Trajectory second = run({general, {1e-12, 0}, 0});
    const MotionSize size = motion_size(simulation_.chain, reference_);
    deviation_.emplace(simulation_.chain, accuracy_, size);
    samples_ = std::min(reference_.size(), second.size());
    for (int k = 0; k < samples_; ++k) {
      const double apart = deviation_->at(reference_, second, k);
      if (apart > kShareOfReference * accuracy_.value) {
        choice_.holds_until = k > 0 ? times_[std::size_t(k) - 1] : 0;
        samples_ = k;
        break;
      }
      choice_.reference_uncertainty = std::max(choice_.reference_uncertainty, apart);
    }
  }

  double cost_of(const MethodSetting& setting, double steps, double evaluations) const {
    const double free = run_cost(simulation_.chain, *setting.method, setting.options, steps, evaluations);
    return free + evaluations * constraints_.evaluation + steps * constraints_.projection;
  }

  // True where the setting is exact enough.
  bool try_one(const MethodSetting& setting) {
    const Trajectory trajectory = run(setting);
    Choice::Candidate candidate{setting,
                                deviation_->largest(trajectory, reference_, samples_),
                                cost_of(setting, double(trajectory.steps), double(trajectory.evaluations)),
                                trajectory.steps,
                                trajectory.evaluations,
                                {}};
    const bool ran = trajectory.status == reference_.status;
    if (!ran) candidate.trouble = trajectory.trouble;
    const bool met = ran && candidate.error <= accuracy_.value;
    const bool better =
        met ? !choice_.is_met || candidate.cost < choice_.best.cost
            : !choice_.is_met && (choice_.tried.empty() || candidate.error < choice_.best.error);
    if (better) {
      choice_.best = candidate;
      choice_.is_met = met;
    }
    choice_.tried.push_back(std::move(candidate));
    return met;
  }

  bool is_hopeless(double cost) const { return choice_.is_met && cost >= choice_.best.cost; }

  void try_steps(const Method& method) {
    for (const double step : kStepLadder) {
      if (step > simulation_.duration) continue;
      const MethodSetting setting{&method, {0, 0}, step};
      const double steps = simulation_.duration / step;
      if (is_hopeless(cost_of(setting, steps, steps * std::max(1, method.evaluations_per_step)))) return;
      if (stopped_ || try_one(setting)) return;
    }
  }

  void try_tolerances(const Method& method) {
    if (method.highest_order == 0) return try_tolerances(method, 0);
    for (const int order : kOrders) try_tolerances(method, order);
  }

  void try_tolerances(const Method& method, int order) {
    for (const double tolerance : kToleranceLadder) {
      if (stopped_ || try_one({&method, {tolerance, order}, 0})) return;
      if (is_hopeless(choice_.tried.back().cost)) return;
    }
  }

  Simulation& simulation_;
  Accuracy accuracy_;
  std::span<const double> times_;
  const StopRequest& stop_;
  std::vector<const Method*> methods_;
  Trajectory reference_;
  std::optional<Deviation> deviation_;
  ConstraintCost constraints_{0, 0};  // beyond a free chain's
  int samples_ = 0;
  bool stopped_ = false;
  Choice choice_;
};

}  // namespace

void apply(const MethodSetting& setting, Simulation& simulation) {
  simulation.method = setting.method;
  simulation.options = setting.options;
  simulation.step = setting.step;
}

std::string to_string(const MethodSetting& setting) {
  std::string text = setting.method->name;
  if (setting.options.order > 0) text += ", order " + std::to_string(setting.options.order);
  if (setting.step > 0) text += ", step " + format_shortest(setting.step) + " s";
  if (setting.options.tolerance > 0) text += ", tolerance " + format_shortest(setting.options.tolerance);
  return text;
}

Choice choose_method(Simulation& simulation, const Accuracy& accuracy, std::span<const double> times,
                     const StopRequest& stop) {
  return Chooser(simulation, accuracy, times, stop).choose();
}

}  // namespace chainreel

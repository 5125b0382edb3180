#include "sim/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "core/format.hpp"
#include "sim/between_samples.hpp"
#include "sim/rank_loss.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/system/forms.hpp"
#include "sim/unstable_rest.hpp"

namespace chainreel {
namespace {

constexpr double kAuditRounding = 1e-10;     // of all energies at play: below it an audit error says nothing
constexpr double kNoEnergy = 1e-16;     // J/kg: rates of 1e-8 m/s, of a chain that is held or at rest
constexpr int kSteps = 32;              // that are taken again
constexpr double kNotable = 1e-3;       // of the fastest freedom's rate: slower ones are measured by it
constexpr double kStill = 1e-9;         // rad/s or m/s: no motion
constexpr double kAim = 0.1;            // of what is still not doubted: where a remedy aims
constexpr double kTightening = 0.1, kLeastTightening = 1e-6;  // of an accuracy
constexpr double kLeastAccuracy = 1e-9;  // in any unit: what is below is better had by a method that is named

std::string percent(double part) {
  return format_significant(100 * part, 2) + " %";
}

// The largest of 1, 2 and 5 times a power of ten that is not above x.
double round_down(double x) {
  const double decade = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= x * (1 + 1e-12)) return digit * decade;
  return decade;
}

// What makes a choice finer.
std::string finer_choice(const Accuracy& accuracy, double factor) {
  const std::string named = "--set method=dop853 --set tolerance=1e-12 --set accuracy=null";
  const double tighter = round_down(accuracy.value * std::clamp(factor, kLeastTightening, kTightening));
  if (tighter < kLeastAccuracy) return named;
  return "--set 'accuracy=" + to_string({tighter, accuracy.unit}) + "', or " + named;
}

// `factor`: by which the error would have to shrink.
std::string finer(const Simulation& simulation, const std::optional<Accuracy>& chosen_by, double factor) {
  if (chosen_by) return finer_choice(*chosen_by, factor);
  std::string text = "--set method=auto --set step=null --set tolerance=null";
  if (simulation.method->highest_order > 0) text += " --set order=null";
  if (simulation.step > 0) {
    const double shorter = simulation.step * std::min(std::pow(factor, 1.0 / simulation.method->order), 0.5);
    return "--set step=" + format_significant(round_down(shorter), 1) + ", or " + text;
  }
  const double tolerance = simulation.options.tolerance;
  if (tolerance > 1e-12) return "--set tolerance=" + format_significant(std::max(1e-12, round_down(1e-3 * tolerance)), 1);
  return text;
}

// Where the curve that a frame follows bends at once the chain is struck, which takes energy: no step and no tolerance keeps it.
std::string cornered_curve(const Simulation& simulation) {
  for (const Constraint& one : simulation.constraints.list)
    if (const auto* curve = std::get_if<CurveConstraint>(&one))
      if (const auto* written = dynamic_cast<const ExpressionCurve*>(curve->curve.get()); written != nullptr && !written->cornered().empty())
        return written->cornered();
  return "";
}

std::optional<Doubt> doubt_constraints(const Simulation& simulation, const Trajectory& trajectory, const std::optional<Accuracy>& chosen_by) {
  if (!(trajectory.position_error > kDoubtfulConstraint)) return {};
  return Doubt{"constraint", trajectory.position_error,
               "the constraints are missed by up to " + format_significant(trajectory.position_error, 3) + " " + unit_of_misses(simulation.constraints.list),
               "--set stabilize=project, or " + (chosen_by ? finer_choice(*chosen_by, kTightening) : "a shorter step")};
}

// Steps of a run taken again.
class StepsAgain {
 public:
  StepsAgain(const Simulation& simulation, const Trajectory& trajectory)
      : simulation_(simulation),
        trajectory_(trajectory),
        system_(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints),
        forms_(system_, *simulation.method),
        whole_(make_integrator(*simulation.method, forms_.forms(), simulation.options)),
        halves_(make_integrator(*simulation.method, forms_.forms(), simulation.options)),
        breaks_(simulation.torque->breaks(simulation.duration)),
        size_(std::size_t(simulation.chain.nv)) {
    double fastest = 0;
    for (int k = 0; k < trajectory.size(); ++k)
      for (std::size_t i = 0; i < size_.size(); ++i) size_[i] = std::max(size_[i], std::abs(trajectory.qd_at(k)[i]));
    for (const double one : size_) fastest = std::max(fastest, one);
    for (double& one : size_) one = std::max({one, kNotable * fastest, kStill});
  }

  std::optional<Doubt> doubt(const std::optional<Accuracy>& chosen_by) {
    const int count = std::min(kSteps, trajectory_.size() - 1);
    int looked_at = 0, doubtful = 0;
    for (int j = 0; j < count; ++j) {
      const std::optional<Apart> apart = take(int(long(j) * trajectory_.size() / count));
      if (!apart) continue;
      ++looked_at;
      doubtful += apart->part > kDoubtfulStep;
      if (apart->part > worst_.part) worst_ = *apart;
    }
    if (doubtful < 2 || 10 * doubtful < looked_at) return {};
    return Doubt{"step", worst_.part,
                 "the step of " + format_shortest(simulation_.step) + " s does not resolve the motion: halved, it " +
                     "changes the rate of '" + simulation_.chain.coordinate_names[worst_.freedom] + "' by " +
                     format_significant(worst_.change, 3) + " at t = " + format_significant(worst_.t, 4) + " s, " +
                     percent(worst_.part) + " of its largest (" + std::to_string(doubtful) + " of " +
                     std::to_string(looked_at) + " steps looked at)",
                 "--set method=radau5 --set step=null --set tolerance=1e-8" +
                     std::string(chosen_by ? " --set accuracy=null" : "") + ", or " +
                     finer(simulation_, chosen_by, std::pow(kAim, simulation_.method->order))};
  }

 private:
  struct Apart {
    double part = 0, change = 0, t = 0;
    std::size_t freedom = 0;
  };

  // Nothing where sample k is no place for a whole step.
  std::optional<Apart> take(int k) {
    const double t = trajectory_.t[std::size_t(k)], h = simulation_.step, end = t + h;
    const auto within = [&](double one) { return one > t && one < end; };
    if (end > trajectory_.end_time || std::any_of(breaks_.begin(), breaks_.end(), within)) return {};
    // Where a corner of the torques is held, the law by itself would jump across it to and fro.
    const auto holds = [&](const Trajectory::Hold& hold) { return hold.begin < end && hold.end > t; };
    if (std::any_of(trajectory_.holds.begin(), trajectory_.holds.end(), holds)) return {};
    whole_->start(t, trajectory_.q_at(k), trajectory_.qd_at(k));
    halves_->start(t, trajectory_.q_at(k), trajectory_.qd_at(k));
    if (whole_->step(end, h) != StepResult::ok || halves_->step(t + h / 2, h / 2) != StepResult::ok ||
        halves_->step(end, h / 2) != StepResult::ok)
      return {};
    Apart apart;
    apart.t = t;
    for (std::size_t i = 0; i < size_.size(); ++i) {
      const double change = std::abs(whole_->v()[i] - halves_->v()[i]);
      if (change <= apart.part * size_[i]) continue;
      apart.part = change / size_[i], apart.change = change, apart.freedom = i;
    }
    return apart;
  }

  const Simulation& simulation_;
  const Trajectory& trajectory_;
  ChainSystem system_;
  ChainForms forms_;
  std::unique_ptr<Integrator> whole_, halves_;
  std::vector<double> breaks_;
  std::vector<double> size_;  // of each freedom's rate
  Apart worst_;
};

}  // namespace

std::optional<Doubt> doubt_of_events(const Simulation& simulation, const Trajectory& trajectory, const std::optional<Accuracy>& chosen_by) {
  if (trajectory.events.hasty.empty()) return {};
  const EventHits::Hasty& first = trajectory.events.hasty.front();
  const double mean = trajectory.end_time / double(std::max(trajectory.steps, 1L));
  const double shorter = round_down(kAim * (simulation.step > 0 ? simulation.step : std::min(mean, simulation.duration / kLeastWatchedSteps)));
  return Doubt{"events", double(trajectory.events.hasty.size()),
               "the event '" + simulation.events->list[std::size_t(first.event)].name + "' comes and goes faster than a run is looked at, first seen at t = " +
                   format_significant(first.t, 4) + " s: some of it may be missed",
               (simulation.step > 0 && !chosen_by ? "" : "--set method=rk4 ") + std::string("--set step=") + format_shortest(shorter)};
}

namespace {

// A curve is followed from step to step, and not to be begun in the midst of a run.
bool follows_a_curve(const Simulation& simulation) {
  const auto& list = simulation.constraints.list;
  return std::any_of(list.begin(), list.end(),
                     [](const Constraint& one) { return std::holds_alternative<CurveConstraint>(one); });
}

}  // namespace

std::optional<Doubt> doubt_of_energy(const Simulation& simulation, const Trajectory& trajectory, const Audit& audit,
                                  const std::optional<Accuracy>& chosen_by) {
  const auto lost = std::ranges::find_if(trajectory.work, [](double work) { return !std::isfinite(work); });
  if (lost != trajectory.work.end()) {
    // The rates may be finite again behind a pole that a step went over.
    const std::size_t k = std::size_t(lost - trajectory.work.begin());
    const double t = trajectory.t[k], before = k == 0 ? 0 : trajectory.t[k - 1];
    return Doubt{"energy", std::numeric_limits<double>::infinity(),
                 "the work of the torques is no number from t = " + format_significant(t, 4) + " s on, as behind a pole of a torque, where no motion goes on",
                 before > 0 ? "--set duration=" + format_significant(round_down(before), 3) + ", which ends before it" : "a torque that stays finite"};
  }
  double largest_work = 0;
  for (const double work : trajectory.work) largest_work = std::max(largest_work, std::abs(work));
  const double at_play = std::abs(audit.energy_start) + audit.energy_moved + largest_work;
  const auto& steps = trajectory.energy_at_steps;  // without what the frames between them miss
  const double error = steps ? steps->largest_error : audit.largest_error;
  const double time = steps ? steps->time : audit.largest_error_time;
  if (!(error > kDoubtfulEnergy * audit.energy_moved && error > kAuditRounding * at_play && error > kNoEnergy * mass_of(simulation.chain))) return {};
  const double part = error / audit.energy_moved;
  const std::string cornered = cornered_curve(simulation);
  return Doubt{"energy", part,
               "the energy is off by " + format_significant(error, 3) + " J at t = " +
                   format_significant(time, 4) + " s, " + percent(part) + " of the " +
                   format_significant(audit.energy_moved, 3) + " J that this motion moves" +
                   (cornered.empty() ? "" : ": a corner of its curve `" + cornered + "` strikes the chain, whatever the step"),
               !cornered.empty() ? "a curve without corners, as sqrt(x^2 + 1e-4) in the place of abs(x)" : finer(simulation, chosen_by, kAim * kDoubtfulEnergy / part)};
}

std::span<const Name> doubt_names() {
  static constexpr Name names[] = {{"energy", "the method makes or loses some"},
                                   {"constraint", "they are missed"},
                                   {"step", "it is too long for the motion"},
                                   {"accuracy", "what method: auto promises ends before the run"},
                                   {"rank", "constraints depend on each other at an instant"},
                                   {"events", "they come and go faster than a run is looked at"},
                                   {"samples", "more happens between the frames than they show"},
                                   {"rest", "nothing but rounding moves the start"}};
  return names;
}

std::vector<Doubt> doubts_of(const Simulation& simulation, const Trajectory& trajectory, const Audit& audit,
                             const std::optional<Accuracy>& chosen_by) {
  std::vector<Doubt> doubts;
  if (trajectory.size() < 2 || !is_complete(trajectory.status)) return doubts;
  const auto add = [&](std::optional<Doubt> doubt) {
    if (doubt) doubts.push_back(std::move(*doubt));
  };
  if (simulation.motion) return doubts;  // no method erred: what a table does not tell truly, its remarks say
  add(doubt_of_rest(simulation));
  const std::optional<Doubt> rank = doubt_of_rank(simulation, trajectory);
  add(rank);
  add(doubt_of_energy(simulation, trajectory, audit, chosen_by));
  if (trajectory.rows > 0) add(doubt_constraints(simulation, trajectory, chosen_by));
  // Steps end at corners of the state; taken again across one they would be others. What `auto` took has been judged.
  const bool has_corners = simulation.torque && simulation.torque->corners() != nullptr;
  if (simulation.step > 0 && !follows_a_curve(simulation) && !(has_corners && chosen_by)) add(StepsAgain(simulation, trajectory).doubt(chosen_by));
  add(doubt_of_events(simulation, trajectory, chosen_by));
  add(doubt_between(simulation, trajectory));
  // No method finds what the equations leave open: what goes wrong there is not mended by another.
  if (rank)
    for (Doubt& doubt : doubts)
      if (doubt.kind != "rest" && doubt.kind != "events") doubt.remedy = rank->remedy;
  return doubts;
}

}  // namespace chainreel

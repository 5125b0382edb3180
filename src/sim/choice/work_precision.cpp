#include "sim/choice/work_precision.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/scalar.hpp"
#include "sim/audit.hpp"
#include "sim/choice/quad_reference.hpp"
#include "sim/cost_table.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

constexpr double kLeastStep = 1e-7;  // s
// A ladder ends where errors this small do not get smaller any more: what is left is rounding.
constexpr int kRungsOfRounding = 2;
constexpr double kSmallError = 1e-7;
// Very short runs are repeated inside one measurement, or the clock would be what is measured.
constexpr double kShortestMeasurement = 2e-4;  // s

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double apart(ConstVec x, const std::vector<double>& reference) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double error = std::abs(x[i] - reference[i]);
    largest = std::isfinite(error) ? std::max(largest, error) : kInfinity;
  }
  return largest;
}

void find_errors(const Trajectory& trajectory, const EndState& reference, Rung& rung) {
  rung.error = rung.error_q = rung.error_qd = kInfinity;
  if (trajectory.status != RunStatus::finished || trajectory.size() == 0) return;
  rung.error_q = apart(trajectory.q_at(trajectory.size() - 1), reference.q);
  rung.error_qd = apart(trajectory.qd_at(trajectory.size() - 1), reference.qd);
  rung.error = std::max(rung.error_q, reference.qd_scale * rung.error_qd);
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// 1, 2, 5, 10, ... downwards from `longest`.
std::vector<double> steps_from(double longest) {
  std::vector<double> steps;
  for (double parts = 1; 1 / parts >= 0.99 * kLeastStep; parts *= 10)  // exact, as numbers that one writes are
    for (const double digit : {5.0, 2.0, 1.0})
      if (digit / parts <= longest * (1 + 1e-12)) steps.push_back(digit / parts);
  return steps;
}

std::vector<MethodSetting> settings_of(const Simulation& simulation, const Method& method,
                                       const LadderOptions& options) {
  std::vector<MethodSetting> settings;
  if (method.adaptive) {
    for (double parts = 100; 1 / parts >= 0.99 * options.lowest_tolerance; parts *= 10)  // exact, and so are their inverses as one writes them
      settings.push_back({&method, {1 / parts, method.highest_order > 0 ? method.order : 0}, 0});
    return settings;
  }
  for (const double step : steps_from(std::min(options.longest_step, simulation.duration))) {
    const double steps = simulation.duration / step;
    const double evaluations = steps * std::max(1, method.evaluations_per_step);
    if (1e-9 * run_cost(simulation.chain, method, {}, steps, evaluations) > options.longest_run) break;
    settings.push_back({&method, {}, step});
  }
  return settings;
}

}  // namespace

// No double comes nearer to what it stands for, however near a run may come by luck.
double rounding_of(const EndState& reference) {
  double largest = 0;
  for (const double q : reference.q) largest = std::max(largest, std::abs(q));
  return 0x1p-53 * largest;
}

Rung measure(Simulation& simulation, const MethodSetting& setting, const EndState& reference, int runs,
             const StopRequest& stop) {
  apply(setting, simulation);
  const double end[] = {simulation.duration};
  Rung rung;
  rung.setting = setting;
  std::vector<double> seconds;
  while (int(seconds.size()) < runs) {
    const auto begin = std::chrono::steady_clock::now();
    int repeats = 0;
    Trajectory trajectory;
    do {
      trajectory = simulate(simulation, end, stop);
      ++repeats;
    } while (seconds_since(begin) < kShortestMeasurement);
    seconds.push_back(seconds_since(begin) / repeats);
    if (seconds.size() > 1) continue;
    rung.status = trajectory.status;
    rung.trouble = trajectory.trouble;
    rung.steps = trajectory.steps;
    rung.evaluations = trajectory.evaluations;
    find_errors(trajectory, reference, rung);
    rung.error = std::max(rung.error, rounding_of(reference));
    rung.energy_error = kInfinity;
    if (trajectory.size() > 0) {
      const Trajectory audited = simulate_audited(simulation, end, stop);
      rung.energy_error = std::max(audit_of(simulation, trajectory).largest_error, audited.energy_at_steps ? audited.energy_at_steps->largest_error : 0.0);
    }
    if (trajectory.status != RunStatus::finished) break;  // nobody asks how fast it failed
  }
  rung.runs = int(seconds.size());
  rung.seconds = median(seconds);
  return rung;
}

Ladder climb(Simulation& simulation, const Method& method, const EndState& reference,
             const LadderOptions& options, const StopRequest& stop) {
  Ladder ladder{&method, {}, {}};
  simulation.method = &method;
  try {
    check_method(simulation);
  } catch (const Error& error) {
    ladder.refusal = error.problems().front().message;
    return ladder;
  }
  double best = kInfinity;
  int without_gain = 0;
  for (const MethodSetting& setting : settings_of(simulation, method, options)) {
    Rung rung = measure(simulation, setting, reference, options.runs, stop);
    const bool interrupted = rung.status == RunStatus::interrupted;
    const double judged = options.judges_energy ? rung.energy_error : rung.error;
    const bool gained = judged < best;
    best = std::min(best, judged);
    if (!interrupted) ladder.rungs.push_back(rung);
    without_gain = gained || !(best < kSmallError) ? 0 : without_gain + 1;
    if (interrupted || without_gain >= kRungsOfRounding || rung.seconds > 2 * options.longest_run) break;
  }
  return ladder;
}

namespace {

// Small against the start, large against rounding.
constexpr double kPush = 1e-9;
constexpr int kLooks = 200;  // at rates and their changes

EndState run(Simulation& simulation, const MethodSetting& setting) {
  apply(setting, simulation);
  const double end[] = {simulation.duration};
  const Trajectory trajectory = simulate(simulation, end);
  if (trajectory.status != RunStatus::finished || trajectory.size() == 0)
    throw Error(ExitCode::numerical, "no reference: " + to_string(setting) + " " + trajectory.trouble);
  const ConstVec q = trajectory.q_at(0), qd = trajectory.qd_at(0);
  return {{q.begin(), q.end()}, {qd.begin(), qd.end()}, 1};
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// By how much errors of a start coordinate or rate grow, one by one; the largest. Rotations of a floating
// base are left alone.
double amplification_of(Simulation& simulation, const MethodSetting& setting, const EndState& end) {
  double largest = 1;
  for (std::vector<double>* start : {&simulation.q0, &simulation.qd0}) {
    if (start == &simulation.q0 && simulation.chain.has_floating) continue;
    for (double& x : *start) {
      const double x0 = x;
      x = x0 + kPush;
      const double moved = x - x0;
      largest = std::max(largest, apart(run(simulation, setting).q, end.q) / moved);
      x = x0;
    }
  }
  return largest;
}

// The time in which rates change by their own size; see EndState. Two or three digits are plenty.
double qd_scale_of(Simulation& simulation) {
  apply({&find_method("dop853"), {1e-6, 0}, 0}, simulation);
  std::vector<double> times;
  for (int k = 0; k <= kLooks; ++k) times.push_back(simulation.duration * k / kLooks);
  const Trajectory trajectory = simulate(simulation, times);
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  std::vector<double> qdd(simulation.qd0.size());
  double rate = 0, change = 0;
  for (int k = 0; k < trajectory.size(); ++k) {
    system.acceleration(trajectory.t[std::size_t(k)], trajectory.q_at(k), trajectory.qd_at(k), qdd);
    for (const double x : trajectory.qd_at(k)) rate = std::max(rate, std::abs(x));
    for (const double x : qdd) change = std::max(change, std::abs(x));
  }
  return rate > 0 && rate < change * simulation.duration ? rate / change : simulation.duration;
}

std::optional<EndReference> by_quads(const Simulation& simulation) {
  const double end[] = {simulation.duration};
  const auto quads = quad_reference(simulation, end);
  const auto amplification = quad_amplification(simulation, simulation.duration);
  if (!quads || !amplification) return std::nullopt;
  return EndReference{{quads->q, quads->qd, 1}, quads->uncertainty.back(), *amplification, quads->how};
}

// For torques that cannot be had in quadruple precision.
EndReference by_doubles(Simulation& simulation) {
  const MethodSetting first{&find_method("dop853"), {1e-14, 0}, 0};
  const MethodSetting second{&find_method("radau5"), {1e-11, 0}, 0};
  EndReference reference;
  reference.state = run(simulation, first);
  reference.uncertainty = apart(reference.state.q, run(simulation, second).q);
  reference.amplification = amplification_of(simulation, first, reference.state);
  reference.how = "dop853 at 1e-14 beside radau5, in doubles";
  return reference;
}

}  // namespace

EndReference end_reference(Simulation& simulation) {
  const Method* const method = simulation.method;
  const MethodOptions options = simulation.options;
  const double step = simulation.step;
  const auto quads = by_quads(simulation);
  EndReference reference = quads ? *quads : by_doubles(simulation);
  reference.state.qd_scale = qd_scale_of(simulation);
  simulation.method = method;
  simulation.options = options;
  simulation.step = step;
  return reference;
}

}  // namespace chainreel

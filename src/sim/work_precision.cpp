#include "sim/work_precision.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/scalar.hpp"
#include "sim/audit.hpp"
#include "sim/cost_table.hpp"

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
  for (double decade = 1; decade >= kLeastStep; decade /= 10)
    for (const double digit : {5.0, 2.0, 1.0})
      if (digit * decade <= longest * (1 + 1e-12)) steps.push_back(digit * decade);
  return steps;
}

std::vector<MethodSetting> settings_of(const Simulation& simulation, const Method& method,
                                       const LadderOptions& options) {
  std::vector<MethodSetting> settings;
  if (method.adaptive) {
    for (double tolerance = 1e-2; tolerance >= 0.99 * options.lowest_tolerance; tolerance /= 10)
      settings.push_back({&method, {tolerance, method.highest_order > 0 ? method.order : 0}, 0});
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
    rung.energy_error = trajectory.size() > 0 ? audit_of(simulation, trajectory).largest_error : kInfinity;
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
    const bool gained = rung.error < best;
    best = std::min(best, rung.error);
    if (!interrupted) ladder.rungs.push_back(rung);
    without_gain = gained || !(best < kSmallError) ? 0 : without_gain + 1;
    if (interrupted || without_gain >= kRungsOfRounding || rung.seconds > 2 * options.longest_run) break;
  }
  return ladder;
}

}  // namespace chainreel

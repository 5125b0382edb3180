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
// The table of costs does not know how often an implicit method asks for its equations: a run may take so much longer than it says. Shorter steps may
// be quicker, as they converge sooner, but not for ever.
constexpr double kLonger = 2;
constexpr int kRungsTooLong = 3;
constexpr double kSmallError = 1e-7;
// Very short runs are repeated inside one measurement, or the clock would be what is measured.
constexpr double kShortestMeasurement = 2e-4;  // s

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// s a run, the last of which is kept.
double time_run(const Simulation& simulation, std::span<const double> times, const StopRequest& stop, Trajectory* kept = nullptr) {
  const auto begin = std::chrono::steady_clock::now();
  int repeats = 0;
  do {
    Trajectory trajectory = simulate(simulation, times, stop);
    if (kept != nullptr) *kept = std::move(trajectory);
    ++repeats;
  } while (seconds_since(begin) < kShortestMeasurement);
  return seconds_since(begin) / repeats;
}

double apart(ConstVec x, ConstVec reference) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double error = std::abs(x[i] - reference[i]);
    largest = std::isfinite(error) ? std::max(largest, error) : kInfinity;
  }
  return largest;
}

// Steps of one length end there, as far as decimal numbers tell. Between them a method's polynomial may be less exact than its steps.
bool ends_step(double t, double step) {
  constexpr double kOfStep = 1e-6;
  const double steps = t / step;
  return std::abs(steps - std::round(steps)) < kOfStep;
}

constexpr double kGross = 0.1;  // of the motion

// How far the coordinate goes that goes farthest.
double range_of(const ReferenceRun& reference) {
  double widest = 0;
  for (std::size_t i = 0; i < reference.q_at(0).size(); ++i) {
    double low = kInfinity, high = -kInfinity;
    for (std::size_t k = 0; k < reference.t.size(); ++k) low = std::min(low, reference.q_at(k)[i]), high = std::max(high, reference.q_at(k)[i]);
    widest = std::max(widest, high - low);
  }
  return widest;
}

// `run`: sampled at the reference's instants.
void find_errors(const Trajectory& run, const ReferenceRun& reference, Rung& rung) {
  constexpr StateError kFailed{kInfinity, kInfinity, kInfinity};
  rung.way = {};
  rung.final = kFailed;
  if (run.status != RunStatus::finished || run.size() != int(reference.t.size())) {
    rung.way = kFailed;
    return;
  }
  // What a film shows between the ends of steps may not be another motion.
  const double gross = kGross * range_of(reference);
  for (int k = 0; k < run.size(); ++k) {
    const bool is_end = k + 1 == run.size();
    const double q = apart(run.q_at(k), reference.q_at(std::size_t(k))), qd = apart(run.qd_at(k), reference.qd_at(std::size_t(k)));
    if (!is_end && rung.setting.step > 0 && !ends_step(run.t[std::size_t(k)], rung.setting.step) && !(q > gross)) continue;
    rung.final = {q, qd, std::max(q, reference.qd_scale * qd)};
    rung.way = {std::max(rung.way.q, q), std::max(rung.way.qd, qd), std::max(rung.way.size, rung.final.size)};
  }
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Inside of steps, at which a run of long ones may be another motion though its energy is right at all of their ends: Verlet at omega h = 2 jumps
// from one turning point to the other.
std::vector<double> instants_within_steps(const MethodSetting& setting, double duration) {
  constexpr int kMost = 200;
  const double steps = setting.step > 0 ? std::floor(duration / setting.step) : kMost;
  const double step = setting.step > 0 ? setting.step : duration / kMost;
  const int count = int(std::min(steps, double(kMost)));
  std::vector<double> times;
  for (int k = 0; k < count; ++k) times.push_back((std::floor(k * steps / count) + 0.5) * step);
  return times;
}

// The largest error of the energy within steps, J, where that is gross; else 0: the polynomial between the ends is not what is judged.
double gross_energy_within_steps(const Simulation& simulation, const MethodSetting& setting, const ReferenceRun& reference, const StopRequest& stop) {
  const std::vector<double> times = instants_within_steps(setting, simulation.duration);
  if (times.empty() || !(reference.energy > 0)) return 0;
  const double error = audit_of(simulation, simulate(simulation, times, stop)).largest_error;
  return error > kGross * reference.energy ? error : 0;
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

// No double comes nearer to what it stands for, however near a run may come by luck.
double rounding_of(ConstVec numbers) {
  double largest = 0;
  for (const double q : numbers) largest = std::max(largest, std::abs(q));
  return 0x1p-53 * largest;
}

}  // namespace

double judged_error(const Rung& rung, Judged judged) {
  switch (judged) {
    case Judged::way:
      return rung.way.size;
    case Judged::final:
      return rung.final.size;
    case Judged::energy:
      break;
  }
  return rung.energy_error;
}

Rung measure(Simulation& simulation, const MethodSetting& setting, const ReferenceRun& reference, int runs,
             const StopRequest& stop, double longest) {
  apply(setting, simulation);
  const double end[] = {simulation.duration};
  Rung rung;
  rung.setting = setting;
  std::vector<double> seconds;
  while (int(seconds.size()) < runs) {
    const auto begin = std::chrono::steady_clock::now();
    const bool is_first = seconds.empty();
    bool is_too_long = false;
    const StopRequest stop_in_time = [&](double t) {
      is_too_long = is_first && seconds_since(begin) > longest;
      return is_too_long || (stop && stop(t));
    };
    Trajectory trajectory;
    seconds.push_back(time_run(simulation, end, stop_in_time, &trajectory));
    if (is_too_long) trajectory.status = RunStatus::out_of_budget;
    if (seconds.size() > 1) continue;
    rung.status = trajectory.status;
    rung.trouble = trajectory.trouble;
    rung.steps = trajectory.steps;
    rung.evaluations = trajectory.evaluations;
    rung.energy_error = rung.way.size = rung.final.size = kInfinity;
    if (trajectory.size() == 0 || is_too_long) break;
    const Trajectory audited = simulate_audited(simulation, reference.t, stop);
    find_errors(audited, reference, rung);
    rung.way.size = std::max(rung.way.size, rounding_of(reference.q));
    rung.final.size = std::max(rung.final.size, rounding_of(reference.q_at(reference.t.size() - 1)));
    rung.energy_error = std::max(audit_of(simulation, trajectory).largest_error, audited.energy_at_steps ? audited.energy_at_steps->largest_error : 0.0);
    rung.energy_error = std::max(rung.energy_error, gross_energy_within_steps(simulation, setting, reference, stop));
    if (trajectory.status != RunStatus::finished) break;  // nobody asks how fast it failed
  }
  rung.runs = int(seconds.size());
  rung.seconds = median(seconds);
  return rung;
}

namespace {

// An evaluation takes about as long on all rungs of a ladder: where it takes longer than on both rungs beside it, the machine did something else.
void time_outliers_again(Simulation& simulation, Ladder& ladder, const LadderOptions& options, const StopRequest& stop) {
  constexpr double kOutlier = 1.2;  // scatter of medians of five is some per cent
  constexpr int kTimes = 3;
  auto& rungs = ladder.rungs;
  const auto per_evaluation = [&](std::size_t k) { return rungs[k].seconds / double(std::max(1L, rungs[k].evaluations)); };
  const auto is_outlier = [&](std::size_t k) {
    return rungs[k].status == RunStatus::finished && per_evaluation(k) > kOutlier * std::max(per_evaluation(k - 1), per_evaluation(k + 1));
  };
  const double end[] = {simulation.duration};
  for (int time = 0; time < kTimes; ++time)
    for (std::size_t k = 1; k + 1 < rungs.size(); ++k) {
      if (!is_outlier(k) || (stop && stop(0))) continue;
      apply(rungs[k].setting, simulation);
      std::vector<double> seconds;
      for (int run = 0; run < options.runs; ++run) seconds.push_back(time_run(simulation, end, stop));
      rungs[k].seconds = std::min(rungs[k].seconds, median(seconds));
    }
}

}  // namespace

Ladder climb(Simulation& simulation, const Method& method, const ReferenceRun& reference,
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
  int without_gain = 0, too_long = 0;
  for (const MethodSetting& setting : settings_of(simulation, method, options)) {
    Rung rung = measure(simulation, setting, reference, options.runs, stop, kLonger * options.longest_run);
    if (rung.status == RunStatus::out_of_budget) {
      if (++too_long == kRungsTooLong) break;
      continue;
    }
    too_long = 0;
    const bool interrupted = rung.status == RunStatus::interrupted;
    const double judged = judged_error(rung, options.judged);
    const bool gained = judged < best;
    best = std::min(best, judged);
    if (!interrupted) ladder.rungs.push_back(rung);
    without_gain = gained || !(best < kSmallError) ? 0 : without_gain + 1;
    if (interrupted || without_gain >= kRungsOfRounding || rung.seconds > kLonger * options.longest_run) break;
  }
  time_outliers_again(simulation, ladder, options, stop);
  return ladder;
}

namespace {

// Small against the start, large against rounding.
constexpr double kPush = 1e-9;
constexpr int kLooks = 200;  // at rates and their changes
constexpr double kFewestInstants = 40;

// Ends of as many ladders' steps as there are: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> instants_of(double duration) {
  std::vector<double> times;
  const double decade = std::floor(std::log10(duration / kFewestInstants)), unit = std::pow(10, std::abs(decade));
  for (const double digit : {5.0, 2.0, 1.0}) {
    const double step = decade < 0 ? digit / unit : digit * unit;  // exact, as numbers that one writes are
    if (duration / step < kFewestInstants) continue;
    for (double k = 1; k * step < duration * (1 - 1e-9); ++k) times.push_back(k * step);
    break;
  }
  times.push_back(duration);
  return times;
}

// How far a run goes from step to step: of each coordinate and rate in its own range, the largest; summed up.
std::vector<double> ways_of(const Trajectory& run) {
  const auto shares = [&](const auto& row_at) {
    std::vector<double> low, high;
    for (int k = 0; k < run.size(); ++k) {
      const ConstVec row = row_at(k);
      if (k == 0) low.assign(row.begin(), row.end()), high = low;
      for (std::size_t i = 0; i < row.size(); ++i) low[i] = std::min(low[i], row[i]), high[i] = std::max(high[i], row[i]);
    }
    std::vector<double> moved(std::size_t(run.size()), 0);
    for (int k = 1; k < run.size(); ++k)
      for (std::size_t i = 0; i < low.size(); ++i)
        if (high[i] > low[i]) moved[std::size_t(k)] = std::max(moved[std::size_t(k)], std::abs(row_at(k)[i] - row_at(k - 1)[i]) / (high[i] - low[i]));
    return moved;
  };
  const std::vector<double> q = shares([&](int k) { return run.q_at(k); }), qd = shares([&](int k) { return run.qd_at(k); });
  std::vector<double> ways(q.size(), 0);
  for (std::size_t k = 1; k < ways.size(); ++k) ways[k] = ways[k - 1] + std::max(q[k], qd[k]);
  return ways;
}

// Where a motion goes far in a small part of the time from one of the usual instants to the next, as a stiff one at its start: behind
// each such place the next ends of steps of each length.
std::vector<double> quick_instants(Simulation& simulation, double usual, const StopRequest& stop) {
  constexpr double kQuick = 0.25;  // of the usual time
  constexpr long kMostSteps = 200'000;
  apply({&find_method("dop853"), {1e-6, 0}, 0}, simulation);
  const Trajectory run = simulate_every_step(simulation, stop);
  std::vector<double> times;
  if (run.size() < 2 || run.size() > kMostSteps) return times;
  const std::vector<double> ways = ways_of(run);
  double before = 0;
  for (int k = 1; k < int(kFewestInstants); ++k) {
    const auto at = std::lower_bound(ways.begin(), ways.end(), ways.back() * k / kFewestInstants) - ways.begin();
    const double t = run.t[std::size_t(std::min(at, std::ptrdiff_t(run.size()) - 1))], gap = t - before;
    before = t;
    if (!(gap < kQuick * usual)) continue;
    for (const double step : steps_from(usual)) {
      if (step < 0.5 * gap) break;
      const double end = std::ceil(t / step * (1 - 1e-12)) * step;
      if (end < simulation.duration * (1 - 1e-9)) times.push_back(end);
    }
  }
  return times;
}

// All of both, none twice.
std::vector<double> merged(std::vector<double> times, const std::vector<double>& others, double duration) {
  times.insert(times.end(), others.begin(), others.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end(), [&](double a, double b) { return b - a <= 1e-12 * duration; }), times.end());
  return times;
}

Trajectory run(Simulation& simulation, const MethodSetting& setting, std::span<const double> times, const StopRequest& stop) {
  constexpr long kMostEvaluations = 20'000'000;  // a minute of a long chain
  apply(setting, simulation);
  simulation.most_evaluations = kMostEvaluations;
  Trajectory trajectory = simulate(simulation, times, stop);
  simulation.most_evaluations = 0;
  if (trajectory.status != RunStatus::finished || trajectory.size() == 0)
    throw Error(ExitCode::numerical, "no reference: " + to_string(setting) + " " + (trajectory.trouble.empty() ? "takes longer than anybody waits for" : trajectory.trouble));
  return trajectory;
}

// By how much errors of a start coordinate or rate grow, one by one; the largest. Rotations of a floating
// base are left alone.
double amplification_of(Simulation& simulation, const MethodSetting& setting, ConstVec q_at_end, const StopRequest& stop) {
  const double end[] = {simulation.duration};
  double largest = 1;
  for (std::vector<double>* start : {&simulation.q0, &simulation.qd0}) {
    if (start == &simulation.q0 && simulation.chain.has_floating) continue;
    for (double& x : *start) {
      const double x0 = x;
      x = x0 + kPush;
      const double moved = x - x0;
      largest = std::max(largest, apart(run(simulation, setting, end, stop).q_at(0), q_at_end) / moved);
      x = x0;
    }
  }
  return largest;
}

// The time in which rates change by their own size; see ReferenceRun. Two or three digits are plenty.
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

std::optional<LadderReference> by_quads(const Simulation& simulation, const std::vector<double>& times, const StopRequest& stop) {
  const auto quads = quad_reference(simulation, times, stop);
  const auto amplification = quads ? quad_amplification(simulation, simulation.duration, stop) : std::nullopt;
  if (!quads || !amplification) return std::nullopt;
  return LadderReference{{times, quads->q, quads->qd, 1}, *std::ranges::max_element(quads->uncertainty), quads->uncertainty.back(), *amplification, quads->how};
}

// For torques that cannot be had in quadruple precision. Between the instants steps are short enough for dense output to lose nothing; where
// steps of another length end elsewhere, it shows how little.
LadderReference by_doubles(Simulation& simulation, const std::vector<double>& times, double usual, const StopRequest& stop) {
  constexpr double kFirstSteps = 0.5, kSecondSteps = 0.31;  // of the usual distance of instants
  const MethodSetting first{&find_method("dop853"), {1e-14, 0}, 0}, second{&find_method("radau5"), {1e-11, 0}, 0};
  const double longest_step = simulation.longest_step, end[] = {simulation.duration};
  const auto with_steps = [&](double share) {
    simulation.longest_step = share * usual;
    Trajectory one = run(simulation, first, times, stop);
    simulation.longest_step = longest_step;
    return one;
  };
  const Trajectory one = with_steps(kFirstSteps), other = with_steps(kSecondSteps);
  const ConstVec last = one.q_at(one.size() - 1);
  LadderReference reference;
  reference.run = {times, one.q, one.qd, 1};
  reference.final_uncertainty = apart(last, run(simulation, second, end, stop).q_at(0));
  reference.uncertainty = reference.final_uncertainty;
  for (int k = 0; k < one.size(); ++k) reference.uncertainty = std::max(reference.uncertainty, apart(one.q_at(k), other.q_at(k)));
  reference.amplification = amplification_of(simulation, first, last, stop);
  reference.how = "dop853 at 1e-14 beside radau5, in doubles";
  return reference;
}

}  // namespace

LadderReference find_reference_run(Simulation& simulation, const StopRequest& stop) {
  const MethodSetting own{simulation.method, simulation.options, simulation.step};
  const std::vector<double> regular = instants_of(simulation.duration);
  const double usual = regular.front();
  const std::vector<double> times = merged(regular, quick_instants(simulation, usual, stop), simulation.duration);
  apply(own, simulation);
  const auto quads = by_quads(simulation, times, stop);
  LadderReference reference = quads ? *quads : by_doubles(simulation, times, usual, stop);
  reference.run.qd_scale = qd_scale_of(simulation);
  reference.run.energy = energy_scale(simulation, stop).value_or(0);
  apply(own, simulation);
  return reference;
}

}  // namespace chainreel

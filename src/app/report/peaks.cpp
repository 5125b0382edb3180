#include "app/report/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sim/audit.hpp"

namespace chainreel {
namespace {

constexpr int kSamples = 500;       // that the work is known at
constexpr double kInstants = 2000;  // that all else is known at

DataTable table_of(const Simulation& simulation, const Trajectory& run, MotionColumn column) {
  return motion_table(simulation, run, {column});
}

}  // namespace

std::vector<MotionColumn> parse_peaks(const std::string& text, const std::string& option) {
  std::vector<MotionColumn> columns = parse_columns(text, option);
  if (std::find(columns.begin(), columns.end(), MotionColumn::t) != columns.end())
    throw Error(ExitCode::usage, option + ": t has no peak; name what goes up and down, like qd,tau,energy_error");
  return columns;
}

std::vector<std::string> peak_names(const Simulation& simulation, const std::vector<MotionColumn>& columns) {
  Trajectory none;
  none.nq = simulation.chain.nq, none.nv = simulation.chain.nv;
  none.rows = int(multiplier_columns(simulation.chain, simulation.constraints.list).size());
  std::vector<std::string> names;
  for (const MotionColumn column : columns)
    for (const DataArray& array : table_of(simulation, none, column).arrays)
      for (const std::string& name : array.columns) names.push_back("peak_" + name);
  return names;
}

namespace {

// Of each number the value that is farthest from zero, and when.
struct Farthest {
  double value = 0, t = 0;
};

// Between samples the work is no number, and the constraints are as the method's dense output has them.
bool is_seen_between(const Trajectory& run, MotionColumn column) {
  return run.between && column != MotionColumn::work && column != MotionColumn::constraint_error;
}

// The method's own error, at the ends of its steps: what its dense output adds between them is none of the run's.
void look_at_steps(const Trajectory& run, Farthest& peak) {
  if (run.energy_at_steps && run.energy_at_steps->largest_error > peak.value) peak = {run.energy_at_steps->largest_error, run.energy_at_steps->time};
}

void look_at(const Simulation& simulation, const Trajectory& run, const std::vector<MotionColumn>& columns, std::vector<Farthest>& peaks) {
  std::size_t first = 0;
  for (const MotionColumn column : columns) {
    if (column == MotionColumn::energy_error) {
      peaks.resize(std::max(peaks.size(), first + 1));
      look_at_steps(run, peaks[first++]);
      continue;
    }
    const Trajectory& seen = is_seen_between(run, column) ? *run.between : run;
    for (const DataArray& array : table_of(simulation, seen, column).arrays) {
      const std::size_t count = array.columns.size();
      peaks.resize(std::max(peaks.size(), first + count));
      for (std::size_t k = 0; k < array.values.size(); ++k)
        if (Farthest& peak = peaks[first + k % count]; std::abs(array.values[k]) > std::abs(peak.value))
          peak = {array.values[k], seen.t[std::min(k / count, seen.t.size() - 1)]};
      first += count;
    }
  }
}

// Instants close together about those peaks, where the largest of what goes up and down smoothly lies.
std::vector<double> times_about(const std::vector<Farthest>& peaks, double duration) {
  constexpr int kFiner = 100;
  std::vector<double> times{0, duration};
  for (const Farthest& peak : peaks)
    for (int k = -kFiner; k <= kFiner; ++k) times.push_back(std::clamp(peak.t + k * duration / (kSamples * kFiner), 0.0, duration));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

PeaksOfRun simulate_for_peaks(const Simulation& simulation, const std::vector<MotionColumn>& columns, const StopRequest& stop) {
  std::vector<double> times;
  for (int k = 0; k <= kSamples; ++k) times.push_back(simulation.duration * k / kSamples);
  for (double share = 1e-10; share < 1.0 / kSamples; share *= 10) times.push_back(simulation.duration * share);  // what jumps at the start
  std::sort(times.begin(), times.end());
  const bool asks_for_energy = std::find(columns.begin(), columns.end(), MotionColumn::energy_error) != columns.end();
  const double between = simulation.duration / kInstants;
  PeaksOfRun found{asks_for_energy ? simulate_audited(simulation, times, stop, between) : simulate(simulation, times, stop, {}, between), {}};
  std::vector<Farthest> peaks;
  look_at(simulation, found.run, columns, peaks);
  look_at(simulation, simulate(simulation, times_about(peaks, simulation.duration), stop), columns, peaks);
  for (const Farthest& peak : peaks) found.peaks.push_back(peak.value);
  return found;
}

}  // namespace chainreel

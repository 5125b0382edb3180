#include "app/report/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace chainreel {
namespace {

constexpr int kSamples = 500;       // that the work and the energy's error are known at
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

Trajectory simulate_for_peaks(const Simulation& simulation, const StopRequest& stop) {
  std::vector<double> times;
  for (int k = 0; k <= kSamples; ++k) times.push_back(simulation.duration * k / kSamples);
  return simulate(simulation, times, stop, {}, simulation.duration / kInstants);
}

std::vector<double> peaks_of(const Simulation& simulation, const Trajectory& run, const std::vector<MotionColumn>& columns) {
  std::vector<double> peaks;
  for (const MotionColumn column : columns) {
    // Between samples the work is no number.
    const bool is_seen_between = run.between && column != MotionColumn::energy_error && column != MotionColumn::work;
    for (const DataArray& array : table_of(simulation, is_seen_between ? *run.between : run, column).arrays) {
      const std::size_t count = array.columns.size(), first = peaks.size();
      peaks.resize(first + count, 0);
      for (std::size_t k = 0; k < array.values.size(); ++k)
        if (double& peak = peaks[first + k % count]; std::abs(array.values[k]) > std::abs(peak)) peak = array.values[k];
    }
  }
  return peaks;
}

}  // namespace chainreel

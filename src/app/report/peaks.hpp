// How far the numbers of a run go: of each the one that is farthest from zero.
#pragma once

#include <string>
#include <vector>

#include "app/report/motion_table.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// "qd,tau,energy_error", as parse_columns reads them; of t there is no peak. Throws Error (usage) naming the option.
std::vector<MotionColumn> parse_peaks(const std::string& text, const std::string& option);

// "peak_qd2 [rad/s]", one a number of those columns.
std::vector<std::string> peak_names(const Simulation& simulation, const std::vector<MotionColumn>& columns);

// A run, and its peaks up to where it ended, with their signs, in the order of their names: looked for at 2000 instants, on both
// sides of where torques jump, and about those that were found at 100 times as many. That of the energy's error is the largest at the ends of steps, without its sign.
struct PeaksOfRun {
  Trajectory run;
  std::vector<double> peaks;
};
PeaksOfRun simulate_for_peaks(const Simulation& simulation, const std::vector<MotionColumn>& columns, const StopRequest& stop = {});

}  // namespace chainreel

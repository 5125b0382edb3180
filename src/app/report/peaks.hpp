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

// The run at so many instants that its peaks are seen: 2000, and on both sides of where torques jump.
Trajectory simulate_for_peaks(const Simulation& simulation, const StopRequest& stop = {});

// With their signs, in the order of their names, up to where such a run ended.
std::vector<double> peaks_of(const Simulation& simulation, const Trajectory& run, const std::vector<MotionColumn>& columns);

}  // namespace chainreel

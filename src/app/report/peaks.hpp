// How far the numbers of a run go: of each the one that is farthest from zero.
#pragma once

#include <string>
#include <vector>

#include "app/report/motion_table.hpp"
#include "core/json.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Of which numbers peaks are asked for: of whole columns, or of one number of one.
struct PeaksAsked {
  std::vector<MotionColumn> columns;
  std::vector<std::string> single{};  // "qd2": of its column this one alone

  bool empty() const { return columns.empty(); }
  // Whether they are asked of this one, "qd2 [rad/s]".
  bool hold(const std::string& name) const;
};

// "qd,tau2,energy_error", as parse_columns reads them; of t there is no peak. Throws Error (usage) naming the option.
PeaksAsked parse_peaks(const std::string& text, const std::string& option);
// Throws Error (usage) where the run has no such numbers.
void require_peaks(const Simulation& simulation, const PeaksAsked& asked, const std::string& option);

// Of a number the value that is farthest from zero, with its sign, and when.
struct Peak {
  double value = 0, t = 0;
};

// What has peaks, one a number that is asked for: "qd2 [rad/s]".
std::vector<std::string> names_of_peaks(const Simulation& simulation, const PeaksAsked& asked);

// A run, and its peaks up to where it ended, in the order of their names: looked for at 2000 instants and all steps, within steps, on both
// sides of where torques jump, and ever closer about those that were found, and all but as far. That of the energy's error is the largest at the ends of steps, without its sign.
struct PeaksOfRun {
  Trajectory run;
  std::vector<Peak> peaks;
};
PeaksOfRun simulate_for_peaks(const Simulation& simulation, const PeaksAsked& asked, const StopRequest& stop = {});

// Limits of joints that peaks of q, qd and tau lie beyond, and that are not among those that the run was seen to pass: of a peak between all that it looked at.
std::vector<LimitEvent> limits_of_peaks(const Simulation& simulation, const std::vector<std::string>& names, const std::vector<Peak>& peaks, const std::vector<LimitEvent>& seen);

// Those of a table's columns but of t, at its rows alone.
struct NamedPeak {
  std::string name, unit;
  Peak peak;
};
std::vector<NamedPeak> peaks_of(const DataTable& table);
std::vector<NamedPeak> named(const std::vector<std::string>& names, const std::vector<Peak>& peaks);

Json to_json(const std::vector<NamedPeak>& peaks);            // [{name, unit, value, t}]
std::string words_of(const std::vector<NamedPeak>& peaks);    // a table to be read

}  // namespace chainreel

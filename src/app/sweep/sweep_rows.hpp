// What the rows of a sweep's table come to: how many failed or are doubtful, and where its peaks are largest.
#pragma once

#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "scene/run/grid.hpp"

namespace chainreel {

// How what speaks against a row begins, in its column `trouble`.
inline const std::string kDoubtful = "doubtful: ", kLimits = "limits: ", kCalm = "was expected to diverge, but ";

// Columns of an event: its first and last instant, how often it happens, and whether it holds at the end.
inline constexpr std::size_t kCellsOfEvent = 4;

// The largest of a column of peaks, in magnitude; of equal ones that of the first run.
struct SweepPeak {
  std::string column;  // "tau1 [N m]", without its peak_
  double value = 0;
  std::size_t run = 0;
  double least = 0;       // of all runs, in magnitude
  std::size_t count = 0;  // of runs that have one

  // Of several runs that differ by no more than rounding: none of them is the one.
  bool is_of_all() const { return count > 1 && std::fabs(value) - least <= 1e-9 * std::fabs(value); }
};

struct SweepOutcome {
  std::size_t done = 0, skipped = 0;  // skipped: a former run of the program has done them
  std::size_t failed = 0;
  std::size_t failed_by_limits = 0;  // of them, runs that came to their end and should have kept within limits
  std::size_t doubtful = 0;  // rows of a table that say so
  std::size_t with_repeats = 0;  // rows of runs in which an event happens more than once
  std::size_t beyond_limits = 0;  // rows whose runs pass limits of joints
  std::string first_failure;  // "torque.1=5: diverged at .."
  std::vector<SweepPeak> largest;  // of each column of peaks that has a number
};

// May be used by several threads.
class SeenRows {
 public:
  // `peaks`: the names of these columns, which stand behind `ended_by` and `before` others; `behind` others, then kCellsOfEvent a piece for `events`.
  SeenRows(const Grid& grid, std::vector<std::string> peaks, std::size_t before, std::size_t behind, std::size_t events)
      : grid_(grid), peaks_(std::move(peaks)), before_(before), behind_(behind), events_(events), has_peak_(peaks_.size()), largest_(peaks_.size()) {}

  // A row without the end of its line.
  void look(const std::string& row);
  SweepOutcome outcome() const;

 private:
  // Returns the comma behind them.
  std::size_t look_at_peaks(const std::string& row, std::size_t run, std::size_t comma);
  void look_at_events(const std::string& row, std::size_t comma);

  const Grid& grid_;
  const std::vector<std::string> peaks_;
  const std::size_t before_, behind_, events_;
  std::mutex lock_;
  std::size_t first_ = 0;
  std::vector<bool> has_peak_;
  std::vector<SweepPeak> largest_;
  SweepOutcome outcome_;
};

}  // namespace chainreel

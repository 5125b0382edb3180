// What the runs of a grid come to, as a table: a row a run, with its last state, the first and last time of each event, how often it happens and whether it holds at the end.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/report/peaks.hpp"
#include "app/sweep/sweep_rows.hpp"
#include "app/works/part.hpp"
#include "scene/run/grid.hpp"

namespace chainreel {

struct SweepTableJob {
  std::string scene;
  std::vector<std::string> overrides;
  const Grid& grid;
  FrameRange runs;  // those of the grid that are asked for
  int threads = 1;
  std::vector<std::string> paths;  // one at least; the first grows as rows come, the others are made of it
  bool overwrite = false;
  bool quiet = false;
  PeaksAsked peaks{};
  std::vector<std::string> last{};  // expressions whose value at the end of each run is asked for
  std::function<void(const std::vector<std::string>&)> looks_at_names = nullptr;  // of the columns, before anything is computed; may throw
};

// Whether runs have several methods, steps or tolerances.
bool varies_method(const Grid& grid);

// Throws Error where the keys themselves lead nowhere, whatever their values: said once, not of each run.
void refuse_unknown_keys(const std::string& scene, const std::vector<std::string>& overrides, const Grid& grid);

// A run that cannot be made ready is a row that says why, wherever in the grid it stands; where none can, nothing is written.
// Rows are written as they come, in the order of the grid; what a run of the program that was ended has done is not done again,
// as long as the scene, its model and all that they read are the same. Throws what the first run is refused for where all are, Error (exit
// 6), and the signal's.
SweepOutcome write_sweep_table(const SweepTableJob& job);

// "# runs: 0 to 3 of 8", the line of facts by which parts of a table are put together.
std::string runs_line(const FrameRange& runs, std::size_t all);

// Parts of one table, by `--shard`, to the whole: the bytes of one that was computed whole. Throws Error (exit 3) where some
// are missing, doubled or of another sweep. What its rows come to is that of the sweep, but for peaks.
SweepOutcome join_tables(const std::vector<std::string>& parts, const std::string& path, bool overwrite);

// Throws Error (numerical) where some have, (limit) where all of these pass limits that they should have kept.
void require_none_failed(const SweepOutcome& outcome, const std::string& file);

}  // namespace chainreel

// Parts of one table, by `--shard`, to the whole.
#include <algorithm>
#include <cstdio>
#include <fstream>

#include "app/sweep/sweep_table.hpp"
#include "app/works/growing_table.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace {

struct TablePart {
  std::string path, facts, names;  // facts: the lines above that of the runs
  FrameRange runs;
  int all = 0;
};

TablePart read_head(const std::string& path) {
  require_plain_file(path, kLargestInput * 64);
  note_input(path);
  std::ifstream stream(path, std::ios::binary);
  TablePart part{path, {}, {}, {}, 0};
  std::string sweep, key, runs;
  std::getline(stream, sweep);
  std::getline(stream, key);
  std::getline(stream, runs);
  std::getline(stream, part.names);
  part.facts = sweep + "\n" + key + "\n";
  int last = -1;
  if (!stream || !sweep.starts_with("# sweep: ") || !key.starts_with("# key: ") ||
      std::sscanf(runs.c_str(), "# runs: %d to %d of %d", &part.runs.first, &last, &part.all) != 3)
    throw Error(ExitCode::bad_input, "is no table of `chainreel sweep`", {path});
  part.runs.behind = last + 1;
  return part;
}

}  // namespace

SweepOutcome join_tables(const std::vector<std::string>& paths, const std::string& path, bool overwrite) {
  std::vector<TablePart> parts;
  for (const std::string& one : paths) {
    parts.push_back(read_head(one));
    require_hash_of_rows(one);
  }
  for (const TablePart& part : parts)
    if (part.facts != parts.front().facts || part.names != parts.front().names || part.all != parts.front().all)
      throw Error(ExitCode::bad_input,
                  "is no part of the same sweep as " + parts.front().path + ": its scene, values or program are others",
                  {part.path});
  std::sort(parts.begin(), parts.end(), [](const TablePart& a, const TablePart& b) { return a.runs.first < b.runs.first; });
  int next = 0;
  for (const TablePart& part : parts) {
    if (part.runs.first != next)
      throw Error(ExitCode::bad_input, part.runs.first > next ? "runs " + std::to_string(next) + " to " +
                                                                    std::to_string(part.runs.first - 1) + " before it are missing"
                                                              : "its runs are in another part, too",
                  {part.path});
    next = part.runs.behind;
  }
  if (next != parts.front().all)
    throw Error(ExitCode::bad_input, "runs " + std::to_string(next) + " to " + std::to_string(parts.front().all - 1) + " are missing",
                {path});

  const std::vector<std::string> names = csv_fields(parts.front().names, {parts.front().path});
  const auto good = std::size_t(std::ranges::find(names, "good") - names.begin());
  SweepOutcome outcome;
  const auto look = [&](const std::string& row, int run) {
    const std::vector<std::string> cells = csv_fields(row, {path});
    if (good >= cells.size() || cells[good] != "0") return;
    if (outcome.failed++ == 0) outcome.first_failure = "run " + std::to_string(run) + ": " + cells.back();
    outcome.failed_by_limits += cells.back().find(kLimits) != std::string::npos && !cells.back().starts_with(kCalm) ? 1 : 0;
  };
  OutputFile output(path, overwrite);
  std::ofstream out(output.temporary_path(), std::ios::binary);
  out << parts.front().facts << runs_line({0, next}, std::size_t(next)) << parts.front().names << "\n";
  for (const TablePart& part : parts) {
    std::ifstream stream(part.path, std::ios::binary);
    std::string line;
    for (int k = 0; k < 4; ++k) std::getline(stream, line);
    int run = part.runs.first;
    // A row whose end is lost is none, nor is one of another run.
    for (; run < part.runs.behind && std::getline(stream, line) && !stream.eof() && line.starts_with(std::to_string(run) + ","); ++run) {
      look(line, run);
      out << line << "\n";
    }
    const bool ends = std::getline(stream, line) && line.starts_with(kHashOfRows);
    if (run != part.runs.behind || !ends)
      throw Error(ExitCode::bad_input, "does not hold the rows that it tells of", {part.path});
  }
  out.flush();
  out << line_of_hash(output.temporary_path());
  out.close();
  if (!out) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {path});
  output.commit();
  outcome.done = std::size_t(next);
  return outcome;
}

void require_none_failed(const SweepOutcome& outcome, const std::string& file) {
  if (outcome.failed == 0) return;
  throw Error(outcome.failed == outcome.failed_by_limits ? ExitCode::limit : ExitCode::numerical,
              std::to_string(outcome.failed) + " of the runs failed, first at " + outcome.first_failure, {file});
}

}  // namespace chainreel

#include "app/sweep/sweep_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/csv.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kOfTheEnd = 4;  // columns behind those of the grid: good, status, end_time, ended_by

// Where the cell that begins there ends, at a comma or the row's end.
std::size_t end_of_cell(const std::string& row, std::size_t begin) {
  bool is_quoted = false;
  for (; begin < row.size() && (is_quoted || row[begin] != ','); ++begin) is_quoted = is_quoted != (row[begin] == '"');
  return begin;
}

// The comma behind so many more cells.
std::size_t skip_cells(const std::string& row, std::size_t comma, std::size_t count) {
  for (std::size_t k = 0; k < count && comma < row.size(); ++k) comma = end_of_cell(row, comma + 1);
  return comma;
}

}  // namespace

void SeenRows::look(const std::string& row) {
  const std::size_t run = std::strtoull(row.c_str(), nullptr, 10);
  const std::size_t comma = skip_cells(row, end_of_cell(row, 0), grid_.axes().size());
  if (comma >= row.size()) return;
  const std::lock_guard guard(lock_);
  if (row.find("," + csv_words(kDoubtful).substr(0, kDoubtful.size())) != std::string::npos) ++outcome_.doubtful;
  const bool is_beyond_limits = row.find(kLimits, row.rfind(",\"")) != std::string::npos;
  outcome_.beyond_limits += is_beyond_limits ? 1 : 0;
  look_at_events(row, skip_cells(row, look_at_peaks(row, run, skip_cells(row, comma, kOfTheEnd + before_)), behind_));
  // What the first that failed in the grid's order says is kept.
  if (row.compare(comma, 3, ",0,") != 0) return;
  ++outcome_.failed;
  outcome_.failed_by_limits += is_beyond_limits && row.find(kCalm, row.rfind(",\"")) == std::string::npos ? 1 : 0;
  if (outcome_.failed > 1 && run > first_) return;
  first_ = run;
  const std::size_t quote = row.rfind(",\"");
  outcome_.first_failure = joined(grid_.settings(run), " ") + ": " +
                           (quote == std::string::npos ? row.substr(comma + 3) : row.substr(quote + 2, row.size() - quote - 3));
}

std::size_t SeenRows::look_at_peaks(const std::string& row, std::size_t run, std::size_t comma) {
  for (std::size_t i = 0; i < peaks_.size() && comma < row.size(); ++i) {
    const std::size_t end = end_of_cell(row, comma + 1);
    const std::optional<double> value = parse_number(std::string_view(row).substr(comma + 1, end - comma - 1));
    comma = end;
    if (!value) continue;
    SweepPeak& largest = largest_[i];
    largest.least = has_peak_[i] ? std::min(largest.least, std::fabs(*value)) : std::fabs(*value);
    ++largest.count;
    const double more = std::fabs(*value) - std::fabs(largest.value);
    if (has_peak_[i] && !(more > 0 || (more == 0 && run < largest.run))) continue;
    has_peak_[i] = true;
    largest = {peaks_[i], *value, run, largest.least, largest.count};
  }
  return comma;
}

void SeenRows::look_at_events(const std::string& row, std::size_t comma) {
  bool has_repeats = false;
  for (std::size_t i = 0; i < events_ && comma < row.size(); ++i) {
    const std::size_t begin = std::min(skip_cells(row, comma, 2) + 1, row.size()), end = end_of_cell(row, begin);
    const std::optional<double> times = parse_number(std::string_view(row).substr(begin, end - begin));
    comma = skip_cells(row, comma, kCellsOfEvent);
    has_repeats |= times.value_or(0) > 1;
  }
  outcome_.with_repeats += has_repeats ? 1 : 0;
}

SweepOutcome SeenRows::outcome() const {
  SweepOutcome outcome = outcome_;
  for (std::size_t i = 0; i < peaks_.size(); ++i)
    if (has_peak_[i]) outcome.largest.push_back(largest_[i]);
  return outcome;
}

}  // namespace chainreel

#include "app/commands/sweep_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "app/commands/map_axes.hpp"
#include "app/commands/sweep_table.hpp"
#include "app/film/formats.hpp"
#include "app/report/report.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "integrate/method.hpp"
#include "scene/run/title.hpp"

namespace chainreel {
namespace {

const std::string kPeak = "peak_";
constexpr const char* kGood = "good";  // of each row: 1, or 0 where the run failed

// "qd1" of "peak_qd1 [rad/s]".
std::string plain_name(const std::string& column) {
  const std::string name = ColumnName(column).name;
  return name.starts_with(kPeak) ? name.substr(kPeak.size()) : name;
}

std::size_t find_column(const std::vector<std::string>& header, const Grid& grid, const std::vector<std::string>& last, std::string wanted) {
  const bool has_peaks = std::ranges::any_of(header, [](const std::string& name) { return name.starts_with(kPeak); });
  if (wanted.empty() && !has_peaks && !last.empty()) wanted = last.front();
  // Behind the run and its keys all are numbers but a few.
  std::vector<std::string> names;
  std::size_t found = header.size();
  for (std::size_t i = 1 + grid.axes().size(); i < header.size(); ++i) {
    const std::string name = ColumnName(header[i]).name;
    if (name == kGood || name == "status" || name == "ended_by" || name == "trouble") continue;
    names.push_back(name);
    const bool is_peak = name.starts_with(kPeak);
    const bool is_meant = wanted.empty() ? is_peak : name == wanted || (is_peak && plain_name(header[i]) == wanted);
    // A peak rather than the last value of that name.
    if (is_meant && (found == header.size() || (!wanted.empty() && is_peak))) found = i;
  }
  if (found < header.size()) return found;
  if (wanted.empty())
    throw Error(ExitCode::usage, "a map shows one column of the table: name it with --map, of " + joined(names) + ", or give --peaks or --last, whose first it shows otherwise");
  std::vector<std::string> of_joints;
  for (const std::string& name : names)
    if (const std::string plain = plain_name(name); without_number(plain) == wanted && std::ranges::count(of_joints, plain) == 0)
      of_joints.push_back(plain);
  if (!of_joints.empty()) throw Error(ExitCode::usage, "--map " + wanted + ": a map shows one of them: " + joined(of_joints));
  throw Error(ExitCode::usage, "--map " + wanted + ": the table has no such column:" + did_you_mean(wanted, names) + " there are " + joined(names) + "; --last adds the value of an expression at the end");
}

// "largest $|qd1|$ [rad/s]".
std::string title_of_column(const std::string& column) {
  const ColumnName name(column);
  std::string plain = plain_name(column);
  const std::string stem = without_number(plain);
  const bool is_symbol = stem == "q" || stem == "qd" || stem == "qdd" || stem == "tau" || stem == "lambda";
  if (!is_symbol) std::ranges::replace(plain, '_', ' ');
  const bool is_peak = name.name.starts_with(kPeak);
  if (is_peak) plain = "|" + plain + "|";
  return (is_peak ? "largest " : "") + (is_symbol ? "$" + plain + "$" : plain) + (name.unit.empty() ? "" : " [" + name.unit + "]");
}

// ", semi-implicit Euler, step 0.001 s" where all runs have it.
std::string method_of(const Grid& grid, const Scene& scene) {
  return varies_method(grid) || scene.chooses_method() ? "" : ", " + method_title(scene.method) + method_text(scene).substr(scene.method.size());
}

// With ticks at the values, where these are few, and angles in degrees, as they are read.
Axis axis_of(const Sweep& sweep) {
  constexpr std::size_t kFewValues = 12;
  Axis axis = map_axis(sweep);
  if (!sweep.logarithmic && sweep.numbers.size() <= kFewValues) axis.at = sweep.numbers;
  const std::size_t unit = axis.title.find("[rad]");
  if (unit == std::string::npos || sweep.logarithmic) return axis;
  constexpr double kDegree = 180 / std::numbers::pi;
  axis.title.replace(unit, 5, "[deg]");
  for (double* end : {&axis.low, &axis.high}) *end *= kDegree;
  for (double& tick : axis.at) tick = std::round(1e9 * kDegree * tick) / 1e9;
  return axis;
}

}  // namespace

bool is_map_path(const std::string& path) {
  return find_output_format(path, Shows::still) != nullptr;
}

void require_map_grid(const Grid& grid) {
  if (grid.axes().size() != 2)
    throw Error(ExitCode::usage, "a map has two axes: give --over twice, like --over start.q.1=0:90deg:10 --over payload.mass=0:5:6");
  for (const Sweep& axis : grid.axes()) require_map_axis(axis, "--over " + axis.key);
}

void require_map_column(const std::vector<std::string>& names, const Grid& grid, const std::vector<std::string>& last, const std::string& wanted) {
  find_column(names, grid, last, wanted);
}

StabilityMap sweep_map(const Grid& grid, const Scene& scene, const std::string& path, const std::vector<std::string>& last, const std::string& wanted) {
  const Sweep &x = grid.axes()[0], &y = grid.axes()[1];
  StabilityMap map;
  map.nx = int(x.values.size());
  map.ny = int(y.values.size());
  map.cells.assign(grid.size(), {.failed = true});
  std::istringstream text(read_plain_file(path));
  std::vector<std::string> header;
  std::size_t column = 0, good = 0, doubtful = 0;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    const Place place{path, ++number};
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> fields = csv_fields(line, place);
    if (header.empty()) {
      header = fields;
      column = find_column(header, grid, last, wanted);
      good = std::size_t(std::ranges::find(header, kGood) - header.begin());
      continue;
    }
    const std::optional<double> run = parse_number(fields.front());
    if (fields.size() != header.size() || !run || !(*run >= 0 && *run < double(grid.size()))) throw Error(ExitCode::bad_input, "is no row of this sweep", place);
    const std::optional<double> value = parse_number(fields[column]);
    const std::vector<std::size_t> at = grid.places(std::size_t(*run));
    const bool is_good = good == header.size() || fields[good] == "1";
    // Of a peak the size: where its sign changes from run to run no cell would be like its neighbours.
    const double shown = is_good && value && ColumnName(header[column]).name.starts_with(kPeak) ? std::abs(*value) : value.value_or(0);
    if (!is_good || !value) continue;
    const bool is_doubtful = fields.back().starts_with(kDoubtful);
    map.cells[at[1] * x.values.size() + at[0]] = {false, shown, is_doubtful};
    doubtful += is_doubtful;
  }
  if (header.empty()) throw Error(ExitCode::bad_input, "has no line of names", {path});
  map.title = title_over_runs(scene);
  map.subtitle = std::to_string(grid.size()) + " runs of " + format_quantity(scene.duration, "s") + method_of(grid, scene);
  map.x = axis_of(x);
  map.y = axis_of(y);
  map.is_linear = true;
  map.error_title = title_of_column(header[column]);
  if (std::ranges::count(last, header[column]) > 0) {
    constexpr std::size_t kShort = 12;  // characters: longer ones would take the map's room
    map.error_title = header[column].size() <= kShort ? header[column] + " at the end" : "at the end";
    if (header[column].size() > kShort) map.subtitle += "; colour: " + header[column];
  }
  map.hatched = "no value";
  map.footer = "Each cell is a run; the table beside has its numbers" +
               (doubtful == 0 ? "." : doubtful == 1 ? ". One, with a dot, is doubtful: its column `trouble` says why." : ". " + std::to_string(doubtful) + ", with dots, are doubtful: their column `trouble` says why.");
  return map;
}

}  // namespace chainreel

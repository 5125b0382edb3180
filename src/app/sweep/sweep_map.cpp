#include "app/sweep/sweep_map.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

#include "app/film/formats.hpp"
#include "app/report/report.hpp"
#include "app/sweep/map_axes.hpp"
#include "app/sweep/sweep_table.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "integrate/method.hpp"
#include "scene/run/title.hpp"

namespace chainreel {
namespace {

const std::string kPeak = "peak_";
const std::string kEnergyOff = kDoubtful + "the energy is off";  // a row's doubt of a method that is too coarse for it
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

// "peak_tau [N m]" of "peak_tau1 [N m]".
std::string stem_column(const std::string& column) {
  const ColumnName name(column);
  return kPeak + without_number(plain_name(column)) + (name.unit.empty() ? "" : " [" + name.unit + "]");
}

}  // namespace

bool is_map_path(const std::string& path) {
  return find_output_format(path, Shows::still) != nullptr;
}

void require_map_grid(const Grid& grid) {
  const std::vector<Sweep>& axes = grid.axes();
  if (axes.size() > 2)
    throw Error(ExitCode::usage, "a picture shows one key as curves, or two as a map: give --over once or twice, like --over start.q.1=0:90deg:10 --over payload.mass=0:5:6");
  if (axes.size() == 1) return require_curve_axis(axes.front(), "--over " + axes.front().key);
  for (const Sweep& axis : axes) require_map_axis(axis, "--over " + axis.key);
}

namespace {

// The columns of one quantity, as of all joints.
using Quantity = std::vector<std::size_t>;

bool is_peak(const std::string& column) {
  return ColumnName(column).name.starts_with(kPeak);
}

Quantity joints_of(const std::vector<std::string>& header, std::size_t first) {
  const auto stem_of = [&](std::size_t i) { return without_number(plain_name(header[i])); };
  Quantity found;
  for (std::size_t i = first; i < header.size(); ++i)
    if (is_peak(header[i]) && stem_of(i) == stem_of(first) && ColumnName(header[i]).unit == ColumnName(header[first]).unit) found.push_back(i);
  return found;
}

// The quantities that one picture has curves of: `wanted`, else all peaks, else all of `last`.
std::vector<Quantity> quantities_of(const std::vector<std::string>& header, const Grid& grid, const std::vector<std::string>& last, const std::string& wanted) {
  const std::size_t begin = 1 + grid.axes().size();
  std::vector<Quantity> all;
  for (std::size_t i = begin; i < header.size(); ++i) {
    const bool is_told = std::ranges::any_of(all, [i](const Quantity& one) { return std::ranges::count(one, i) > 0; });
    if (is_peak(header[i]) && !is_told && (wanted.empty() || without_number(plain_name(header[i])) == wanted)) all.push_back(joints_of(header, i));
  }
  if (all.empty() && wanted.empty())
    for (const std::string& expression : last) all.push_back({find_column(header, grid, last, expression)});
  if (all.empty()) all.push_back({find_column(header, grid, last, wanted)});
  return all;
}

// A run's number in a column.
struct RowValue {
  std::optional<double> value;  // nothing where the run failed, too; of a peak the size: where its sign changes from run to run no neighbours would be alike
  bool is_doubtful = false, is_off_in_energy = false;
};

// A table's rows, each with its run and its value in each of the columns that `choose` picks of the header.
std::vector<std::string> read_rows(const Grid& grid, const std::string& path, const std::function<std::vector<std::size_t>(const std::vector<std::string>& header)>& choose,
                                   const std::function<void(std::size_t run, std::size_t column, const RowValue& value)>& look) {
  std::istringstream text(read_plain_file(path));
  std::vector<std::string> header;
  std::vector<std::size_t> columns;
  std::size_t good = 0;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    const Place place{path, ++number};
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> fields = csv_fields(line, place);
    if (header.empty()) {
      header = fields;
      columns = choose(header);
      good = std::size_t(std::ranges::find(header, kGood) - header.begin());
      continue;
    }
    const std::optional<double> run = parse_number(fields.front());
    if (fields.size() != header.size() || !run || !(*run >= 0 && *run < double(grid.size()))) throw Error(ExitCode::bad_input, "is no row of this sweep", place);
    const bool is_good = good == header.size() || fields[good] == "1";
    for (std::size_t i = 0; i < columns.size(); ++i) {
      RowValue found{is_good ? parse_number(fields[columns[i]]) : std::nullopt, fields.back().starts_with(kDoubtful), fields.back().starts_with(kEnergyOff)};
      if (found.value && is_peak(header[columns[i]])) found.value = std::abs(*found.value);
      look(std::size_t(*run), i, found);
    }
  }
  if (header.empty()) throw Error(ExitCode::bad_input, "has no line of names", {path});
  std::vector<std::string> names;
  for (const std::size_t column : columns) names.push_back(header[column]);
  return names;
}

std::string runs_text(const Grid& grid, const Scene& scene) {
  const bool is_swept = std::ranges::any_of(grid.axes(), [](const Sweep& axis) { return axis.key == "duration"; });
  return std::to_string(grid.size()) + " runs" + (is_swept ? "" : " of " + format_quantity(scene.duration, "s")) + method_of(grid, scene);
}

}  // namespace

void require_map_column(const std::vector<std::string>& names, const Grid& grid, const std::vector<std::string>& last, const std::string& wanted) {
  if (grid.axes().size() == 1)
    quantities_of(names, grid, last, wanted);
  else
    find_column(names, grid, last, wanted);
}

StabilityMap sweep_map(const Grid& grid, const Scene& scene, const std::string& path, const std::vector<std::string>& last, const std::string& wanted) {
  const Sweep x = with_unit_of_parameter(scene, grid.axes()[0]), y = with_unit_of_parameter(scene, grid.axes()[1]);
  StabilityMap map;
  map.nx = int(x.values.size());
  map.ny = int(y.values.size());
  map.cells.assign(grid.size(), {.failed = true});
  std::size_t doubtful = 0;
  const auto choose = [&](const std::vector<std::string>& header) { return std::vector<std::size_t>{find_column(header, grid, last, wanted)}; };
  const std::string column = read_rows(grid, path, choose, [&](std::size_t run, std::size_t, const RowValue& found) {
    if (!found.value) return;
    const std::vector<std::size_t> at = grid.places(run);
    map.cells[at[1] * x.values.size() + at[0]] = {false, *found.value, found.is_doubtful};
    doubtful += found.is_doubtful;
  }).front();
  map.title = title_over_runs(scene);
  map.subtitle = runs_text(grid, scene);
  map.x = map_axis_in_units(x);
  map.y = map_axis_in_units(y);
  map.is_linear = true;
  map.error_title = title_of_column(column);
  if (std::ranges::count(last, column) > 0) {
    constexpr std::size_t kShort = 12;  // characters: longer ones would take the map's room
    map.error_title = column.size() <= kShort ? column + " at the end" : "at the end";
    if (column.size() > kShort) map.subtitle += "; colour: " + column;
  }
  map.hatched = "no value";
  map.footer = "Each cell is a run; the table beside has its numbers" +
               (doubtful == 0 ? "." : doubtful == 1 ? ". One, with a dot, is doubtful: its column `trouble` says why." : ". " + std::to_string(doubtful) + ", with dots, are doubtful: their column `trouble` says why.");
  return map;
}

namespace {

// "3 of 7 runs are doubtful: energy off by more than 1 %; try --set method=auto"
std::string doubts_text(std::size_t doubtful, std::size_t of_energy, const Grid& grid, const Scene& scene) {
  if (doubtful == 0) return "";
  const std::string count = std::to_string(doubtful) + " of " + std::to_string(grid.size()) + (grid.size() == 1 ? " run" : " runs") + " doubtful: ";
  if (of_energy < doubtful) return count + "the table's column `trouble` says why";
  return count + "energy off by > 1 %" + (scene.chooses_method() || varies_method(grid) ? "" : "; try --set method=auto");
}

std::string title_of_quantity(const std::vector<std::string>& names, const std::vector<std::string>& last) {
  if (std::ranges::count(last, names.front()) > 0) return names.front() + " at the end";
  return title_of_column(names.size() == 1 ? names.front() : stem_column(names.front()));
}

}  // namespace

ResponseChart sweep_curves(const Grid& grid, const Scene& scene, const std::string& path, const std::vector<std::string>& last, const std::string& wanted) {
  const Sweep x = with_unit_of_parameter(scene, grid.axes().front());
  ResponseChart chart;
  std::vector<Quantity> quantities;
  std::vector<ResponseCurve> curves;  // of all columns
  std::size_t doubtful = 0, of_energy = 0;
  const auto choose = [&](const std::vector<std::string>& header) {
    quantities = quantities_of(header, grid, last, wanted);
    std::vector<std::size_t> columns;
    for (const Quantity& one : quantities) columns.insert(columns.end(), one.begin(), one.end());
    curves.resize(columns.size());
    for (ResponseCurve& curve : curves)
      for (const double value : x.numbers) curve.points.push_back({value * degrees_of(x)});
    return columns;
  };
  const std::vector<std::string> names = read_rows(grid, path, choose, [&](std::size_t run, std::size_t column, const RowValue& found) {
    ResponsePoint& point = curves[column].points[run];
    point.y = found.value;
    point.is_doubtful = found.is_doubtful;
    doubtful += column == 0 && found.is_doubtful;
    of_energy += column == 0 && found.is_off_in_energy;
  });
  chart.title = title_over_runs(scene);
  chart.subtitle = runs_text(grid, scene);
  chart.warning = doubts_text(doubtful, of_energy, grid, scene);
  chart.x = curve_axis_of(x);
  std::size_t next = 0;
  for (const Quantity& quantity : quantities) {
    const std::vector<std::string> own(names.begin() + std::ptrdiff_t(next), names.begin() + std::ptrdiff_t(next + quantity.size()));
    ResponsePanel panel{title_of_quantity(own, last), is_peak(own.front()), {}};
    for (const std::string& name : own) {
      panel.curves.push_back(std::move(curves[next++]));
      panel.curves.back().title = "$" + plain_name(name) + "$";
    }
    chart.panels.push_back(std::move(panel));
  }
  chart.footer = "Each mark is a run; the table beside has its numbers.";
  if (doubtful > 0) chart.footer += " Rings are doubtful: the column `trouble` says why.";
  return chart;
}

}  // namespace chainreel

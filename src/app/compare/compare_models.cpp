// Two models, and two trajectories as `simulate` writes them: what differs, in words.

#include <algorithm>

#include "app/compare/comparison.hpp"
#include "app/film/model_scene.hpp"
#include "app/report/report.hpp"
#include "app/verify/physics_record.hpp"
#include "core/change_words.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "model/model_description.hpp"
#include "sim/trajectory_difference.hpp"

namespace chainreel {
namespace {

// Columns t, q.. and qd.., and what else `simulate` writes, whose numbers are compared like rates; what they are called is
// all that a table says of its freedoms.
SampledTrajectory trajectory_of(const Table& table, const std::string& path) {
  const int time = table.find("t");
  if (time < 0)
    throw Error(ExitCode::bad_input, "has no column t: it is no trajectory as `simulate` writes it",
                {path, 1});
  SampledTrajectory trajectory;
  trajectory.t = table.columns[std::size_t(time)];
  std::vector<std::size_t> positions, rates;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::string& name = table.names[i];
    if (int(i) == time) continue;
    if (!name.starts_with("q") || name.starts_with("qd")) {
      rates.push_back(i);
      trajectory.qd_numbers.push_back({name, table.units[i]});
    } else {
      positions.push_back(i);
      trajectory.q_numbers.push_back({name, table.units[i]});
    }
  }
  if (positions.empty()) throw Error(ExitCode::bad_input, "has no column of positions, q..", {path, 1});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (row > 0 && trajectory.t[row] <= trajectory.t[row - 1])
      throw Error(ExitCode::bad_input, "t does not rise", {path, table.lines[row]});
    for (const std::size_t column : positions) trajectory.q.push_back(table.columns[column][row]);
    for (const std::size_t column : rates) trajectory.qd.push_back(table.columns[column][row]);
  }
  trajectory.end_time = trajectory.t.back();
  join_rotations(trajectory.q_numbers);
  return trajectory;
}

// The columns of `table` in the order of `names`, where those are its own.
bool give_columns_order(Table& table, const std::vector<std::string>& names) {
  if (!std::is_permutation(table.names.begin(), table.names.end(), names.begin(), names.end())) return false;
  std::vector<std::vector<double>> columns;
  for (const std::string& name : names) columns.push_back(std::move(table.columns[std::size_t(table.find(name))]));
  std::vector<std::string> units;
  for (const std::string& name : names) units.push_back(table.units[std::size_t(table.find(name))]);
  table.columns = std::move(columns);
  table.units = std::move(units);
  table.names = names;
  return true;
}

// Instants at which one of the two has no row are a difference, whatever the other rows say.
std::string row_words(const SampledTrajectory& before, const SampledTrajectory& after, std::size_t shared) {
  if (before.size() == shared && after.size() == shared) return "";
  std::string words = "rows " + change_text(std::to_string(before.size()), std::to_string(after.size())) + ", " +
                      std::to_string(shared) + " of them at instants that both have";
  const std::size_t most = std::min(before.size(), after.size());
  for (std::size_t i = 0; i < most; ++i)
    if (before.t[i] != after.t[i])
      return words + "; the first that only one has is at t = " + format_shortest(std::min(before.t[i], after.t[i])) + " s";
  return words;
}

std::vector<std::string> names_of(const SampledTrajectory& trajectory) {
  std::vector<std::string> names;
  for (const std::vector<SampledNumber>* numbers : {&trajectory.q_numbers, &trajectory.qd_numbers})
    for (const SampledNumber& number : *numbers) names.push_back(number.label);
  return names;
}

// Numbers of other units are other numbers, whatever they are called.
std::vector<std::string> units_of(const SampledTrajectory& trajectory) {
  std::vector<std::string> units;
  for (const std::vector<SampledNumber>* numbers : {&trajectory.q_numbers, &trajectory.qd_numbers})
    for (const SampledNumber& number : *numbers) units.push_back(number.unit);
  return units;
}

// Of a model's record.
std::vector<std::string> unread_meshes(const Json& record) {
  std::vector<std::string> files;
  for (const DescribedMesh& mesh : model_description_of(record).meshes)
    if (!mesh.sketch) files.push_back("mesh " + mesh.file);
  return files;
}

Comparison said(std::vector<std::string> words) {
  Comparison found;
  found.equal = found.passes = words.empty();
  found.report["explained"] = words;
  found.words = words.empty() ? std::vector<std::string>{"equal"} : std::move(words);
  return found;
}

}  // namespace

Comparison compare_models(const CompareOptions& options) {
  const std::vector<std::string> overrides = overrides_of(options.common);
  std::vector<std::string> honoured = keys_of_models(OfModel::mechanism);
  honoured.push_back("end_effector");
  Json records[2];
  for (const int i : {0, 1}) {
    const std::string& path = i == 0 ? options.before : options.after;
    note_input(path);
    records[i] = model_record(path, model_scene_of(path, overrides, "compare", honoured).options, DescribeCollisions::all);
  }
  Comparison found = said(explain_models(records[0], records[1]));
  std::vector<std::string> unread;
  for (const std::string& mesh : unread_meshes(records[1]))
    if (const auto old = unread_meshes(records[0]); std::find(old.begin(), old.end(), mesh) != old.end())
      unread.push_back(mesh);
  if (!unread.empty())
    found.words.push_back("not compared, for neither could be read: " + joined(unread));
  found.report["not_compared"] = unread;
  return found;
}

namespace {

// What each of several columns parts by; one alone is told in the sentence before.
std::string column_words(const TrajectoryDifference& difference) {
  if (difference.numbers.size() < 2) return "";
  std::vector<std::vector<std::string>> table{{"column", "differs from t, s, on", "largest", "at t, s", "of a range of"}};
  for (const FreedomDifference& one : difference.numbers)
    table.push_back({one.label, format_significant(one.first_time, 6), amount_text(format_significant(one.largest, 3), one.unit),
                     format_significant(one.largest_time, 6), amount_text(format_significant(one.range, 3), one.unit)});
  std::string text = table_text(table);
  text.pop_back();
  return text;
}

// The second table in the units of the first, where both are known; what differed, as words.
std::string put_in_units(Table& table, const Table& first) {
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < std::min(table.names.size(), first.names.size()); ++i) {
    const std::string before = first.units[i], after = table.units[i];
    if (table.names[i] != first.names[i] || before == after || before.empty() || after.empty()) continue;
    const auto from = factor_of_unit(after), to = factor_of_unit(before);
    if (!from || !to) continue;
    for (double& value : table.columns[i]) value *= *from / *to;
    table.units[i] = before;
    changes.push_back(table.names[i] + " " + change_text(before, after));
  }
  return changes.empty() ? "" : "units " + joined(changes) + ", compared in the first";
}

Json json_of(const TrajectoryDifference& difference) {
  Json columns = Json::array();
  for (const FreedomDifference& one : difference.numbers)
    columns.push_back({{"name", one.label}, {"unit", one.unit}, {"first_time", one.first_time}, {"at_first", one.at_first},
                       {"largest", one.largest}, {"largest_time", one.largest_time}, {"range", one.range}});
  return columns;
}

}  // namespace

Comparison compare_trajectories(const CompareOptions& options) {
  Table tables[2];
  for (const int i : {0, 1}) {
    const std::string& path = i == 0 ? options.before : options.after;
    note_input(path);
    tables[i] = read_csv(path);
  }
  const bool other_order = tables[0].names != tables[1].names && give_columns_order(tables[1], tables[0].names);
  const std::string other_units = put_in_units(tables[1], tables[0]);
  const SampledTrajectory before = trajectory_of(tables[0], options.before),
                          after = trajectory_of(tables[1], options.after);
  const double of_range = options.table_tolerance();
  const TrajectoryDifference difference = difference_of(before, after, of_range);
  std::vector<std::string> words = difference.others;
  if (const std::string rows = row_words(before, after, std::size_t(difference.instants)); !rows.empty())
    words.push_back(rows);
  const std::vector<std::string> old_names = names_of(before), names = names_of(after);
  if (old_names != names && old_names.size() == names.size())  // compared in their order
    words.push_back("columns " + change_text(joined(old_names), joined(names)));
  const std::vector<std::string> old_units = units_of(before), units = units_of(after);
  if (old_units != units && old_units.size() == units.size())
    words.push_back("units " + change_text(joined(old_units), joined(units)));
  if (!other_units.empty()) words.push_back(other_units);
  if (const std::string parted = freedom_words(difference); !parted.empty())
    words.insert(words.begin(), parted);
  Comparison found = said(words);
  found.equal = before.t == after.t && before.q == after.q && before.qd == after.qd && words.empty();
  if (!found.equal && found.passes) found.words = {"no number differs by more than " + format_shortest(of_range) + " of its range"};
  if (other_order) found.words.push_back("their columns stand in another order");
  if (const std::string columns = column_words(difference); !columns.empty()) found.words.push_back(columns);
  found.report["instants"] = difference.instants;
  found.report["tolerance"] = {{"of_range", of_range}};
  found.report["columns"] = json_of(difference);
  return found;
}

}  // namespace chainreel

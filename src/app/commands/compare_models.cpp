// Two models, and two trajectories as `simulate` writes them: what differs, in words.

#include "app/commands/comparison.hpp"
#include "app/film/model_scene.hpp"
#include "app/verify/physics_record.hpp"
#include "core/change_words.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "sim/trajectory_difference.hpp"

namespace chainreel {
namespace {

// Columns t, q.. and qd..; what they are called is all that a table says of its freedoms, so units are not
// known.
SampledTrajectory trajectory_in(const std::string& path) {
  note_input(path);
  const Table table = read_csv(path);
  const int time = table.find("t");
  if (time < 0)
    throw Error(ExitCode::bad_input, "has no column t: it is no trajectory as `simulate` writes it",
                {path, 1});
  SampledTrajectory trajectory;
  trajectory.t = table.columns[std::size_t(time)];
  std::vector<std::size_t> positions, rates;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::string& name = table.names[i];
    if (name.starts_with("qd")) {
      rates.push_back(i);
      trajectory.qd_numbers.push_back({name, ""});
    } else if (name.starts_with("q")) {
      positions.push_back(i);
      trajectory.q_numbers.push_back({name, ""});
    } else if (int(i) != time) {
      throw Error(ExitCode::bad_input, "has a column " + name + ": trajectories have t, q.. and qd.. alone",
                  {path, 1});
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

std::vector<std::string> names_of(const SampledTrajectory& trajectory) {
  std::vector<std::string> names;
  for (const std::vector<SampledNumber>* numbers : {&trajectory.q_numbers, &trajectory.qd_numbers})
    for (const SampledNumber& number : *numbers) names.push_back(number.label);
  return names;
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
  return said(explain_models(records[0], records[1]));
}

Comparison compare_trajectories(const CompareOptions& options) {
  const SampledTrajectory before = trajectory_in(options.before), after = trajectory_in(options.after);
  const TrajectoryDifference difference = difference_of(before, after);
  std::vector<std::string> words = difference.others;
  const std::vector<std::string> old_names = names_of(before), names = names_of(after);
  if (old_names != names && old_names.size() == names.size())  // compared in their order
    words.push_back("columns " + change_text(joined(old_names), joined(names)));
  if (const std::string parted = freedom_words(difference); !parted.empty())
    words.insert(words.begin(), parted);
  Comparison found = said(words);
  found.equal = before.t == after.t && before.q == after.q && before.qd == after.qd && words.empty();
  if (!found.equal && found.passes) found.words = {"no number differs by more than 1e-9 of its range"};
  found.report["instants"] = difference.instants;
  return found;
}

}  // namespace chainreel

#include "core/csv.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"

namespace chainreel {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t(256) << 20;  // bytes

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string::npos) return fields;
    begin = comma + 1;
  }
}

// "q1 [rad]" in two; nothing where it names no unit.
std::string take_unit(std::string& name) {
  const std::size_t begin = name.rfind(" [");
  if (begin == std::string::npos || begin == 0 || !name.ends_with(']')) return "";
  const std::string unit = name.substr(begin + 2, name.size() - begin - 3);
  name = trimmed(name.substr(0, begin));
  return unit;
}

// A column in the program's units.
std::vector<double> in_our_units(const Table& table, std::size_t column) {
  std::vector<double> values = table.columns[column];
  const std::optional<double> factor = factor_of_unit(table.units[column]);
  if (!factor)
    throw Error(ExitCode::bad_input,
                "'" + table.names[column] + " [" + table.units[column] +
                    "]' has a unit that is not known: s, rad, m, N, N m and their rates are, and ms, us, ns, deg, mm and cm",
                {table.file});
  if (*factor != 1)
    for (double& value : values) value *= *factor;
  return values;
}

}  // namespace

int Table::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : int(found - names.begin());
}

Table read_csv(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw Error(ExitCode::bad_input, "there is no such file", {path});
  if (std::filesystem::file_size(path, code) > kLargestFile)
    throw Error(ExitCode::limit, "is larger than 256 MiB", {path});
  note_input(path);
  std::ifstream stream(path, std::ios::binary);
  Table table{path, {}, {}, {}, {}};
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    const std::vector<std::string> fields = fields_of(line);
    if (table.names.empty()) {
      table.names = fields;
      for (std::string& name : table.names) table.units.push_back(take_unit(name));
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (table.find(table.names[i]) != int(i))
          throw Error(ExitCode::bad_input, "two columns are named '" + table.names[i] + "': rename or remove one", {path, number});
      table.columns.resize(fields.size());
      continue;
    }
    if (fields.size() != table.names.size())
      throw Error(ExitCode::bad_input,
                  "has " + std::to_string(fields.size()) + " values under " +
                      std::to_string(table.names.size()) +
                      " names: values are separated by commas, decimals take a point",
                  {path, number});
    table.lines.push_back(number);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::optional<double> value = parse_number(fields[i]);
      if (!value)
        throw Error(ExitCode::bad_input,
                    "'" + fields[i] + "' under '" + table.names[i] + "' is not a finite number",
                    {path, number});
      table.columns[i].push_back(*value);
    }
  }
  if (table.rows() == 0)
    throw Error(ExitCode::bad_input, "holds no row of numbers below a line of names", {path});
  return table;
}

std::optional<double> factor_of_unit(const std::string& unit) {
  static const std::map<std::string, double> base{{"s", 1},    {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9},
                                                  {"rad", 1},  {"deg", std::numbers::pi / 180}, {"m", 1}, {"cm", 1e-2},
                                                  {"mm", 1e-3}, {"N", 1},    {"N m", 1},   {"Nm", 1}, {"N*m", 1}};
  if (unit.empty()) return 1;
  const std::size_t slash = unit.find('/');
  const auto found = base.find(unit.substr(0, slash));
  if (found == base.end()) return std::nullopt;
  const std::string below = slash == std::string::npos ? "" : unit.substr(slash + 1);
  const bool is_known = below.empty() ? slash == std::string::npos : below == "s" || below == "s^2" || below == "s2";
  return is_known ? std::optional(found->second) : std::nullopt;
}

TimeTable read_time_table(const std::string& path, const std::vector<std::string>& wanted, int n) {
  const Table table = read_csv(path);
  TimeTable result;
  const int time = table.find("t");
  if (time < 0) throw Error(ExitCode::bad_input, "has no column 't'", {path});
  result.t = in_our_units(table, std::size_t(time));
  result.lines = table.lines;
  for (std::size_t k = 1; k < result.t.size(); ++k)
    if (result.t[k] <= result.t[k - 1])
      throw Error(ExitCode::bad_input,
                  "'t' does not rise: " + format_shortest(result.t[k]) + " stands below " +
                      format_shortest(result.t[k - 1]) + "; each instant takes one row, later ones below",
                  {path, table.lines[k]});
  for (const std::string& name : wanted) {
    std::vector<std::vector<double>> group;
    for (int i = 1; i <= n; ++i) {
      const int column = table.find(name + std::to_string(i));
      if (column >= 0) group.push_back(in_our_units(table, std::size_t(column)));
    }
    if (!group.empty() && group.size() != std::size_t(n))
      throw Error(ExitCode::bad_input,
                  "needs the columns " + name + "1 to " + name + std::to_string(n) + ", one a freedom",
                  {path});
    if (!group.empty() && table.find(name + std::to_string(n + 1)) >= 0)
      throw Error(ExitCode::bad_input,
                  "has a column " + name + std::to_string(n + 1) + ", but the mechanism has " + std::to_string(n) +
                      (n == 1 ? " freedom" : " freedoms") + ": is it a table of another one?",
                  {path});
    result.groups.push_back(std::move(group));
  }
  return result;
}

std::string csv_words(const std::string& words) {
  std::string text = "\"";
  for (const char c : words) text += c == '"' ? "\"\"" : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
  return text + "\"";
}

}  // namespace chainreel

#include "table/data_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/json.hpp"
#include "table/npz.hpp"

namespace chainreel {
namespace {

struct Ending {
  const char* ending;
  TableFormat format;
};
constexpr Ending kEndings[] = {{".csv", TableFormat::csv}, {".json", TableFormat::json}, {".npz", TableFormat::npz}};

// A name with a comma would be two.
std::string csv_name(const std::string& name) {
  return name.find_first_of(",\"\n\r") == std::string::npos ? name : csv_words(name);
}

// The names that numbers which are none have in NumPy and pandas.
std::string csv_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return format_shortest(value);
}

std::string csv_bytes(const DataTable& table) {
  std::string text;
  for (const WordArray& array : table.words) text += (text.empty() ? "" : ",") + csv_name(array.name);
  for (const DataArray& array : table.arrays)
    for (const std::string& column : array.columns) text += (text.empty() ? "" : ",") + csv_name(column);
  text += "\n";
  for (std::size_t row = 0; row < table.rows; ++row) {
    const char* between = "";
    for (const WordArray& array : table.words) text += between + csv_name(array.values[row]), between = ",";
    for (const DataArray& array : table.arrays)
      for (std::size_t i = 0; i < array.columns.size(); ++i, between = ",")
        text += between + csv_number(array.values[row * array.columns.size() + i]);
    text += "\n";
  }
  return text;
}

// Nested as the shape says, from its number `level` on; `at` goes through the values.
Json nested(const DataArray& array, std::size_t level, std::size_t& at) {
  if (level == array.shape.size()) return array.values[at++];
  Json list = Json::array();
  for (std::size_t i = 0; i < array.shape[level]; ++i) list.push_back(nested(array, level + 1, at));
  return list;
}

std::string json_bytes(const DataTable& table) {
  Json json{{"columns", Json::array()}};
  for (const WordArray& array : table.words) {
    json["columns"].push_back(array.name);
    json[array.name] = array.values;
  }
  for (const DataArray& array : table.arrays) {
    for (const std::string& column : array.columns) json["columns"].push_back(column);
    Json& list = json[array.name] = Json::array();
    std::size_t at = 0;
    for (std::size_t row = 0; row < table.rows; ++row) list.push_back(nested(array, 0, at));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<double> number_of(const std::string& cell) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
  if (cell.empty() || cell == "nan") return kNone;
  if (cell == "inf") return kInfinite;
  if (cell == "-inf") return -kInfinite;
  return parse_number(cell);
}

}  // namespace

DataTable table_of_csv(const std::string& csv) {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> columns;
  std::istringstream stream(csv);
  DataTable table;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells = csv_fields(line, {});
    if (names.empty()) {
      names = std::move(cells);
      columns.resize(names.size());
      continue;
    }
    cells.resize(names.size());
    for (std::size_t i = 0; i < cells.size(); ++i) columns[i].push_back(std::move(cells[i]));
    ++table.rows;
  }
  // Numbers by their name alone, unless that is another column's, as of an event called like one.
  std::set<std::string> used;
  const auto distinct = [&](const std::string& name, const std::string& head) {
    std::string own = name;
    for (int k = 1; !used.insert(own).second; ++k) own = head + (k == 1 ? "" : "_" + std::to_string(k));
    return own;
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<double> numbers;
    for (const std::string& cell : columns[i])
      if (const std::optional<double> number = number_of(cell)) numbers.push_back(*number);
    if (numbers.size() == table.rows)
      table.add(distinct(ColumnName(names[i]).name, names[i]), {names[i]}, {}, std::move(numbers));
    else
      table.words.push_back({distinct(names[i], names[i]), std::move(columns[i])});
  }
  return table;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

void DataTable::add(const std::string& name, const std::string& unit, std::vector<double> values) {
  add(name, {with_unit(name, unit)}, {}, std::move(values));
}

void DataTable::add(const std::string& name, std::vector<std::string> columns, std::vector<std::size_t> shape,
                    std::vector<double> values) {
  arrays.push_back({name, std::move(columns), std::move(shape), std::move(values)});
}

std::optional<TableFormat> find_table_format(const std::string& path) {
  const std::string ending = lower_case_ending(path);
  for (const Ending& one : kEndings)
    if (ending == one.ending) return one.format;
  return std::nullopt;
}

TableFormat table_format_of(const std::string& path) {
  if (path == "-") return TableFormat::csv;
  if (const std::optional<TableFormat> format = find_table_format(path)) return *format;
  std::vector<std::string> known;
  for (const Ending& one : kEndings) known.push_back(one.ending);
  throw Error(ExitCode::usage, "-o " + path + ": tables are written as " + joined(known) + ", by the file's ending, or as CSV to -");
}

std::string table_bytes(const DataTable& table, TableFormat format) {
  switch (format) {
    case TableFormat::json:
      return json_bytes(table);
    case TableFormat::npz:
      return npz_bytes(table);
    case TableFormat::csv:
      break;
  }
  return csv_bytes(table);
}

}  // namespace chainreel

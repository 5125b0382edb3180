#include "app/commands/dh_table.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kLargestTable = 1 << 20;  // bytes
const std::array<std::string, 5> kNames{"a", "alpha", "d", "theta", "mass"};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells = separated(line + ",", ',');  // an empty last cell is one, too
  for (std::string& cell : cells) {
    const std::size_t first = cell.find_first_not_of(" \t\r\""), last = cell.find_last_not_of(" \t\r\"");
    cell = first == std::string::npos ? "" : cell.substr(first, last - first + 1);
  }
  return cells;
}

std::size_t column_of(const std::vector<std::string>& header, const std::string& name) {
  return std::size_t(std::find(header.begin(), header.end(), name) - header.begin());
}

// The columns of kNames in the header; the last one is beyond it where there are no masses.
std::array<std::size_t, 5> columns_of(const std::vector<std::string>& header, const Place& place) {
  for (const std::string& name : header)
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end() || std::count(header.begin(), header.end(), name) > 1)
      throw Error(ExitCode::bad_input,
                  "'" + shortened(name, 40) + "' names no column, or two: the first line is a,alpha,d,theta, maybe with mass",
                  place);
  std::array<std::size_t, 5> columns{};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    columns[k] = column_of(header, kNames[k]);
    if (k < 4 && columns[k] == header.size())
      throw Error(ExitCode::bad_input, "there is no column '" + kNames[k] + "': the first line is a,alpha,d,theta", place);
  }
  return columns;
}

}  // namespace

DhTable read_dh_table(const std::string& path) {
  DhTable table;
  std::vector<std::string> header;
  std::array<std::size_t, 5> columns{};
  std::istringstream lines(read_plain_file(path, kLargestTable));
  Place place{path, 0, 0};
  for (std::string text; std::getline(lines, text);) {
    ++place.line;
    const std::vector<std::string> cells = cells_of(text);
    if (text.starts_with("#") || (cells.size() == 1 && cells[0].empty())) continue;
    if (header.empty()) {
      header = cells;
      columns = columns_of(header, place);
      continue;
    }
    if (cells.size() != header.size())
      throw Error(ExitCode::bad_input,
                  "has " + std::to_string(cells.size()) + " cells under " + std::to_string(header.size()) + " names", place);
    DhRow& row = table.rows.emplace_back();
    for (std::size_t k = 0; k < 4; ++k)
      row[k] = kDhAngle[k] ? parse_angle(cells[columns[k]], place) : parse_quantity(cells[columns[k]], place, "m");
    if (columns[4] < header.size()) table.masses.push_back(parse_quantity(cells[columns[4]], place, "kg"));
  }
  if (table.rows.empty())
    throw Error(ExitCode::bad_input, "holds no row: write a,alpha,d,theta and below it a row for each joint", {path});
  return table;
}

}  // namespace chainreel

// Tables of numbers with a line of names on top, as `simulate` writes them. Comma separated, C locale.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace chainreel {

struct Table {
  std::string file;
  std::vector<std::string> names;  // without their units: "q1" of "q1 [rad]"
  std::vector<std::string> units;  // "rad"; "" where none is told
  std::vector<std::vector<double>> columns;  // one a name, all of the same length
  std::vector<int> lines;                    // of the file, where each row stands

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  int find(const std::string& name) const;  // index of a column, or -1
};

// Throws Error with file and line for what is no table of finite numbers under names that differ.
Table read_csv(const std::string& path);

// How many of the program's units (s, rad, m, N and what is made of them) one of `unit` is: pi/180 of deg, 1e-3 of ms. None
// of those that it does not know; 1 of "".
std::optional<double> factor_of_unit(const std::string& unit);

// The same with columns `t` (rising) and `NAME1..NAMEn`, no more and no fewer, for each wanted name that the file has,
// in the program's units.
struct TimeTable {
  std::vector<double> t;
  std::vector<int> lines;  // of the file, where each row stands
  std::vector<std::vector<std::vector<double>>>
      groups;  // [wanted][1..n]; empty where the file has none of that name
};
TimeTable read_time_table(const std::string& path, const std::vector<std::string>& wanted, int n);

// A field of words: in quotes, on one line.
std::string csv_words(const std::string& words);

}  // namespace chainreel

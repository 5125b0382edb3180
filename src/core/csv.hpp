// Tables of numbers with a line of names on top, as `simulate` writes them. Comma separated, C locale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace chainreel {

struct Table {
  std::string file;
  std::vector<std::string> names;  // without their units: "q1" of "q1 [rad]"
  std::vector<std::string> units;  // "rad"; "" where none is told
  std::vector<std::vector<double>> columns;  // one a name, all of the same length
  std::vector<int> lines;                    // of the file, where each row stands
  double first = 0;                          // what the first row held of the column that is told from it on
  std::vector<double> told;                  // that column as it stands in the file

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  int find(const std::string& name) const;  // index of a column, or -1
};

// Throws Error with file and line for what is no table of finite numbers under names that differ. Of the column `since_first`
// the numbers are told from the first row's on, which is subtracted before they are rounded: seconds since 1970 keep
// their nanoseconds, and nanoseconds theirs.
Table read_csv(const std::string& path, const std::string& since_first = "");


// Of names, units and numbers.
std::string sha256_of(const Table& table);

// How many of the program's units (s, rad, m, N and what is made of them) one of `unit` is: pi/180 of deg, 1e-3 of ms. None
// of those that it does not know; 1 of "".
std::optional<double> factor_of_unit(const std::string& unit);

// The name of a column with its unit, as lines of names have it: "q1 [rad]", or "q1" where no unit is told.
struct ColumnName {
  std::string name, unit;
  explicit ColumnName(const std::string& text);
  std::string text() const { return unit.empty() ? name : name + " [" + unit + "]"; }
  friend bool operator==(const ColumnName&, const ColumnName&) = default;
};

// "qd" of "qd1".
std::string without_number(const std::string& name);

// Which columns are meant, where a table has names of its maker's own: of the time, and of a freedom's quantity; and their
// units, where it does not tell them itself.
struct ColumnNames {
  struct Column {
    std::string freedom, quantity;  // "elbow", "q"
    ColumnName column;              // "position_2 [deg]"
    friend bool operator==(const Column&, const Column&) = default;
  };
  ColumnName time{"t"};
  std::vector<Column> list;

  friend bool operator==(const ColumnNames&, const ColumnNames&) = default;
};

// A table whose time is told since its first row, with what `names` says of units as if it did. Throws Error (bad input) as
// read_csv, and where it tells other units.
Table read_log(const std::string& path, const ColumnNames& names);
// Its time as it stands there.
Table read_table(const std::string& path, const ColumnNames& names);

// A table's columns `t` (rising) and, for each wanted quantity that it has, one a freedom, no more and no fewer: `NAME2` of
// the second one, `NAME.elbow` of the one that is so called, or what `names` says. In the program's units.
struct TimeTable {
  std::vector<double> t;
  std::vector<int> lines;  // of the file, where each row stands
  std::vector<std::vector<std::vector<double>>>
      groups;  // [wanted][freedom]; empty where the file has none of that name
  std::vector<std::vector<std::size_t>> columns;  // of the file, where these numbers stand, likewise
};
TimeTable time_table_of(const Table& table, const std::vector<std::string>& wanted, const std::vector<std::string>& freedoms,
                        const ColumnNames& names = {});
TimeTable read_time_table(const std::string& path, const std::vector<std::string>& wanted, const std::vector<std::string>& freedoms,
                          const ColumnNames& names = {});

// The fields of a line, without blanks around them. One in quotes may hold commas, and quotes as two of them. Throws Error at
// `place` where they do not close.
std::vector<std::string> csv_fields(const std::string& line, const Place& place);

// A field of words: in quotes, on one line.
std::string csv_words(const std::string& words);

}  // namespace chainreel

// Numbers in columns that belong together, and the files that they become: CSV, JSON and NumPy's NPZ.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace chainreel {

// An array with an entry a row of the table: a number, or several, like q with one a coordinate.
struct DataArray {
  std::string name;                  // "q"
  std::vector<std::string> columns;  // "q1 [rad]": of its numbers in each row
  std::vector<std::size_t> shape;    // of an entry; empty: one number. Its product is the count of columns
  std::vector<double> values;        // row by row
};

// A word a row: "rk4".
struct WordArray {
  std::string name;
  std::vector<std::string> values;
};

struct DataTable {
  std::size_t rows = 0;
  std::vector<DataArray> arrays;
  std::vector<WordArray> words;  // in front of the numbers where there is an order

  // One number a row.
  void add(const std::string& name, const std::string& unit, std::vector<double> values);
  // An entry of that shape a row.
  void add(const std::string& name, std::vector<std::string> columns, std::vector<std::size_t> shape,
           std::vector<double> values);
};

std::string with_unit(const std::string& name, const std::string& unit);  // "q1 [rad]"; without a unit the name alone

enum class TableFormat {
  csv,   // a line of names with units on top, then a line a row: numbers by the fewest digits that read back as the same
  json,  // {"columns": names as in CSV, "t": [..], "q": [[..], ..]}; numbers that are not finite are null
  npz,   // an array each, of doubles or of texts, and `columns`: names as in CSV
};

// By the path's ending; none of others.
std::optional<TableFormat> find_table_format(const std::string& path);
// The same; "-" is standard output, which takes CSV. Throws Error (usage) naming the endings.
TableFormat table_format_of(const std::string& path);

// What a table says as CSV, lines that begin with # left out: a column is numbers where all its cells are (empty ones are nan), else words.
DataTable table_of_csv(const std::string& csv);

// The whole file. The same table gives the same bytes. Throws Error (limit) where the format cannot hold it.
std::string table_bytes(const DataTable& table, TableFormat format);

}  // namespace chainreel

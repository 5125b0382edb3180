#include "core/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <span>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"

namespace chainreel {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t(256) << 20;  // bytes

}  // namespace

std::vector<std::string> csv_fields(const std::string& line, const Place& place) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t first = line.find_first_not_of(" \t\r", begin);
    if (first != std::string::npos && line[first] == '"') {
      std::string& field = fields.emplace_back();
      std::size_t at = first + 1;
      for (; at < line.size() && (line[at] != '"' || line.compare(at, 2, "\"\"") == 0); ++at) {
        field += line[at];
        at += line[at] == '"';
      }
      const std::size_t behind = line.find_first_not_of(" \t\r", std::min(at + 1, line.size()));
      if (at >= line.size() || (behind != std::string::npos && line[behind] != ','))
        throw Error(ExitCode::bad_input, "a field begins with a quote that does not close before its comma", place);
      field = trimmed(field);
      if (behind == std::string::npos) return fields;
      begin = behind + 1;
      continue;
    }
    const std::size_t comma = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string::npos) return fields;
    begin = comma + 1;
  }
}

namespace {

// Of a line of names that holds but one: what separates its values instead.
void require_commas(const std::vector<std::string>& names, const Place& place) {
  if (names.size() > 1) return;
  for (const auto& [sign, words] : {std::pair{';', "semicolons"}, {'\t', "tabs"}})
    if (names.front().find(sign) != std::string::npos)
      throw Error(ExitCode::bad_input,
                  std::string("its values are separated by ") + words + ": chainreel reads tables separated by commas, with points in decimals",
                  place);
}

// What a column's numbers are above its first one. Decimals are told apart by their text, whole numbers and fractions each for
// themselves: of 1.7e9 s a double keeps but 0.2 us, of which a spline's second derivative is made wrong by per cents.
class FirstSubtracted {
 public:
  double operator()(const std::string& text, double value) {
    const Decimal decimal = decimal_of(text, value);
    if (!first_) first_ = decimal, first_value_ = value;
    if (first_value_ == 0) return value;
    if (!decimal.is_exact || !first_->is_exact) return value - first_value_;
    return double(decimal.whole - first_->whole) + (decimal.rest - first_->rest);
  }
  double first() const { return first_value_; }

 private:
  struct Decimal {
    std::int64_t whole = 0;
    double rest = 0;
    bool is_exact = false;  // else the text has an exponent, or too many digits
  };
  static Decimal decimal_of(const std::string& text, double value) {
    const std::size_t begin = text.find_first_not_of("+-"), point = std::min(text.find('.'), text.size());
    constexpr std::int64_t kLargest = std::int64_t(1) << 62;  // differences of such hold
    if (begin > 1 || text.find_first_not_of("0123456789.", begin) != std::string::npos || point < begin) return {};
    Decimal decimal{0, 0, true};
    if (point > begin && (std::from_chars(text.data() + begin, text.data() + point, decimal.whole).ec != std::errc() || decimal.whole >= kLargest))
      return {};
    if (point + 1 < text.size()) std::from_chars(text.data() + point, text.data() + text.size(), decimal.rest);
    if (std::signbit(value)) decimal.whole = -decimal.whole, decimal.rest = -decimal.rest;
    return decimal;
  }

  std::optional<Decimal> first_;
  double first_value_ = 0;
};

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

ColumnName::ColumnName(const std::string& text) : name(text) {
  const std::size_t begin = text.rfind(" [");
  if (begin == std::string::npos || begin == 0 || !text.ends_with(']')) return;
  unit = text.substr(begin + 2, text.size() - begin - 3);
  name = trimmed(text.substr(0, begin));
}

int Table::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : int(found - names.begin());
}

Table read_csv(const std::string& path, const std::string& since_first) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw Error(ExitCode::bad_input, "there is no such file", {path});
  if (std::filesystem::file_size(path, code) > kLargestFile)
    throw Error(ExitCode::limit, "is larger than 256 MiB", {path});
  note_input(path);
  std::ifstream stream(path, std::ios::binary);
  Table table{path, {}, {}, {}, {}, 0, {}};
  int number = 0;
  FirstSubtracted from_first;
  std::size_t relative = std::string::npos;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // the mark of UTF-8 that spreadsheets write
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    const std::vector<std::string> fields = csv_fields(line, {path, number});
    if (table.names.empty()) {
      require_commas(fields, {path, number});
      for (const std::string& field : fields) {
        const ColumnName column(field);
        table.names.push_back(column.name);
        table.units.push_back(column.unit);
      }
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (table.find(table.names[i]) != int(i))
          throw Error(ExitCode::bad_input, "two columns are named '" + table.names[i] + "': rename or remove one", {path, number});
      table.columns.resize(fields.size());
      if (const int column = since_first.empty() ? -1 : table.find(since_first); column >= 0) relative = std::size_t(column);
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
      if (i == relative) table.told.push_back(*value);
      table.columns[i].push_back(i == relative ? from_first(fields[i], *value) : *value);
    }
  }
  if (table.rows() == 0)
    throw Error(ExitCode::bad_input, "holds no row of numbers below a line of names", {path});
  table.first = from_first.first();
  return table;
}

namespace {

// What `names` says of units, as if the table did.
void tell_units(Table& table, const ColumnNames& names) {
  const auto tell = [&](const ColumnName& column) {
    const int index = table.find(column.name);
    if (column.unit.empty() || index < 0) return;
    std::string& unit = table.units[std::size_t(index)];
    if (!unit.empty() && unit != column.unit)
      throw Error(ExitCode::bad_input,
                  "tells '" + column.name + " [" + unit + "]' in its line of names, and `columns` '" + column.text() + "': remove one of the units",
                  {table.file});
    unit = column.unit;
  };
  tell(names.time);
  for (const ColumnNames::Column& one : names.list) tell(one.column);
}

}  // namespace

Table read_log(const std::string& path, const ColumnNames& names) {
  Table table = read_csv(path, names.time.name);
  tell_units(table, names);
  return table;
}

Table read_table(const std::string& path, const ColumnNames& names) {
  Table table = read_csv(path);
  tell_units(table, names);
  return table;
}

std::string sha256_of(const Table& table) {
  Sha256 hash;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::string head = table.names[i] + (table.units[i].empty() ? "" : " [" + table.units[i] + "]");
    hash.add(std::as_bytes(std::span(head)));
    hash.add(std::span<const double>(table.columns[i]));
  }
  return hash.finish();
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

namespace {

// Where the numbers of one quantity stand.
class Quantity {
 public:
  Quantity(const Table& table, std::string name, const std::vector<std::string>& freedoms, const ColumnNames& names)
      : table_(table), name_(std::move(name)), freedoms_(freedoms), names_(names) {}

  // A column a freedom; none where the table has not a single one.
  std::vector<std::size_t> columns() const {
    std::vector<std::size_t> found;
    std::string missing;
    for (std::size_t i = 0; i < freedoms_.size(); ++i) {
      const int column = column_of(i);
      if (column >= 0)
        found.push_back(std::size_t(column));
      else
        missing = freedoms_[i];
    }
    const std::string last = std::to_string(freedoms_.size()), next = name_ + std::to_string(freedoms_.size() + 1);
    if (!found.empty() && found.size() != freedoms_.size())
      throw Error(ExitCode::bad_input,
                  "needs the columns " + name_ + "1 to " + name_ + last + ", one a freedom, or " + name_ + "." +
                      freedoms_.front() + " and so on by their names; there is none of '" + missing + "'",
                  {table_.file});
    if (!found.empty() && table_.find(next) >= 0)
      throw Error(ExitCode::bad_input,
                  "has a column " + next + ", but the mechanism has " + last + (freedoms_.size() == 1 ? " freedom" : " freedoms") +
                      ": is it a table of another one?",
                  {table_.file});
    return found;
  }

 private:
  int column_of(std::size_t i) const {
    for (const ColumnNames::Column& one : names_.list) {
      if (one.freedom != freedoms_[i] || one.quantity != name_) continue;
      const std::string& name = one.column.name;
      const int column = table_.find(name);
      if (column < 0)
        throw Error(ExitCode::bad_input, "has no column '" + name + "', which is to be " + name_ + " of '" + one.freedom + "':" +
                                             did_you_mean(name, table_.names) + " its columns are " + joined(table_.names),
                    {table_.file});
      return column;
    }
    const std::string by_number = name_ + std::to_string(i + 1), by_name = name_ + "." + freedoms_[i];
    const int column = table_.find(by_number), named = table_.find(by_name);
    if (column >= 0 && named >= 0)
      throw Error(ExitCode::bad_input, "has both a column '" + by_number + "' and '" + by_name + "', which mean the same: remove one",
                  {table_.file});
    return std::max(column, named);
  }

  const Table& table_;
  std::string name_;
  const std::vector<std::string>& freedoms_;
  const ColumnNames& names_;
};

// What is named must be a freedom, and each column is one thing alone.
void check_names(const Table& table, const std::vector<std::string>& freedoms, const ColumnNames& names) {
  for (const ColumnNames::Column& one : names.list) {
    if (std::find(freedoms.begin(), freedoms.end(), one.freedom) == freedoms.end())
      throw Error(ExitCode::bad_input,
                  "`columns` names '" + one.freedom + "', but no joint of the mechanism is called so:" +
                      did_you_mean(one.freedom, freedoms) + " its joints are " + joined(freedoms),
                  {table.file});
    const std::string& name = one.column.name;
    const auto means_it = [&](const ColumnNames::Column& other) { return other.column.name == name; };
    if (name == names.time.name || std::count_if(names.list.begin(), names.list.end(), means_it) > 1)
      throw Error(ExitCode::bad_input, "`columns` takes the column '" + name + "' for two things", {table.file});
  }
}

}  // namespace

TimeTable time_table_of(const Table& table, const std::vector<std::string>& wanted, const std::vector<std::string>& freedoms,
                        const ColumnNames& names) {
  check_names(table, freedoms, names);
  TimeTable result;
  const int time = table.find(names.time.name);
  if (time < 0)
    throw Error(ExitCode::bad_input,
                "has no column '" + names.time.name + "' of the time: call one so, or in a scene beside `csv:` say `columns: {time: NAME}`; there are " +
                    joined(table.names),
                {table.file});
  const std::string& unit = table.units[std::size_t(time)];
  if (!unit.empty() && !unit.ends_with('s'))
    throw Error(ExitCode::bad_input, "'" + names.time.name + " [" + unit + "]' is to be the time: in s, ms, us or ns", {table.file});
  result.t = in_our_units(table, std::size_t(time));
  result.lines = table.lines;
  for (std::size_t k = 1; k < result.t.size(); ++k)
    if (result.t[k] <= result.t[k - 1])
      throw Error(ExitCode::bad_input,
                  "'" + names.time.name + "' does not rise: " + format_shortest(result.t[k]) + " stands below " +
                      format_shortest(result.t[k - 1]) + "; each instant takes one row, later ones below",
                  {table.file, table.lines[k]});
  for (const std::string& name : wanted) {
    result.columns.push_back(Quantity(table, name, freedoms, names).columns());
    auto& group = result.groups.emplace_back();
    for (const std::size_t column : result.columns.back()) group.push_back(in_our_units(table, column));
  }
  return result;
}

TimeTable read_time_table(const std::string& path, const std::vector<std::string>& wanted, const std::vector<std::string>& freedoms,
                          const ColumnNames& names) {
  return time_table_of(read_table(path, names), wanted, freedoms, names);
}

std::string without_number(const std::string& name) {
  return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

std::string csv_words(const std::string& words) {
  std::string text = "\"";
  for (const char c : words) text += c == '"' ? "\"\"" : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
  return text + "\"";
}

}  // namespace chainreel

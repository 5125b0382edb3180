// What tables of a command by itself cannot remember: beside x.csv the record x.csv.json says which command made it, of which files, and
// which bytes it has, under kMadeBy: {arguments, files, inputs, output}, paths as found from its folder, `output` the -o that made the table with those of other
// panels. `check` and `check --today` ask it.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"

namespace chainreel {

// Takes away the record of a table that is written without one: it told of another command.
void forget_record(const std::string& table);

class TableRecords {
 public:
  TableRecords(const Command& command, bool overwrite) : command_(command), overwrite_(overwrite) {}
  // For those of the paths that are files and no pictures, before they are computed; `outputs`: the -o of each. Reads the command's files, once. Throws Error (exit 6)
  // where a file that is not ours has a record's name.
  void open(const std::vector<std::string>& paths, const std::vector<std::string>& outputs);
  // Of a figure's memory those of its poses that have names beside its model.
  void remember_named_poses(const Json& figure);
  // Of those that were opened, when the tables are there. None is left of another command.
  void write();
  // Of none that were opened: they did not become whole.
  void drop() { tables_.clear(); }

 private:
  struct One {
    std::string path, output;
  };
  const Command& command_;
  bool overwrite_;
  std::vector<One> tables_;
  Json inputs_, named_poses_;
};

// The command's words with paths as found from here, and those that name files.
struct RecordedCommand {
  std::vector<std::string> words;
  std::vector<std::size_t> files;
  std::string output;
  Json named_poses;  // null where there are none
};
// Throws Error (bad input) of what is no record of this program.
RecordedCommand recorded_command(const Json& record, const std::string& folder, const std::string& path);

}  // namespace chainreel

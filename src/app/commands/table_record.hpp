// What tables of `simulate`, `inverse` and `sweep` cannot remember themselves: beside x.csv the record x.csv.json says which command made it, of which files, and
// which bytes it has, under kMadeBy: {arguments, files, inputs, output}, paths as found from its folder, `output` the -o that made the table with those of other
// panels. `check` and `check --today` ask it.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"

namespace chainreel {

class TableRecords {
 public:
  TableRecords(const Command& command, const CommonOptions& common) : command_(command), common_(common) {}
  // For those of the paths that are .csv or .npz, before they are computed; `outputs`: the -o of each. Reads the command's files, once. Throws Error (exit 6)
  // where a file that is not ours has a record's name.
  void open(const std::vector<std::string>& paths, const std::vector<std::string>& outputs);
  // Of those that were opened, when the tables are there. None is left of another command.
  void write();

 private:
  struct One {
    std::string path, output;
  };
  const Command& command_;
  const CommonOptions& common_;
  std::vector<One> tables_;
  Json inputs_;
};

// The command's words with paths as found from here, and those that name files.
struct RecordedCommand {
  std::vector<std::string> words;
  std::vector<std::size_t> files;
  std::string output;
};
// Throws Error (bad input) of what is no record of this program.
RecordedCommand recorded_command(const Json& record, const std::string& folder, const std::string& path);

}  // namespace chainreel

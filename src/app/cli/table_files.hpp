// One table as files: of each kind that -o asks for by its ending.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"
#include "core/output_file.hpp"
#include "table/data_table.hpp"

namespace chainreel {

// -o, which may be given several times; `usual` is told as the default.
void add_table_option(Command& command, std::vector<std::string>& outputs, const std::string& usual);

// All are opened before anything is computed. "-" is standard output, which takes CSV.
class TableFiles {
 public:
  // Throws Error (usage) for an ending that no table has, for a path that is named twice and for "-" beside --json, (file)
  // where one cannot be written.
  TableFiles(const std::vector<std::string>& paths, const CommonOptions& options);

  void write(const DataTable& table);
  void write_partial(const DataTable& table);  // of a run that failed, under .partial names

  std::vector<std::string> paths() const;
  // The files with their number of rows, or with --json their names and what else was `found`. Nothing in words of a
  // table that went to standard output, nor `words` about it then.
  void tell(const CommonOptions& options, std::size_t rows, const Json& found, const std::string& words = "") const;

 private:
  struct One {
    std::string path;
    TableFormat format;
    std::unique_ptr<OutputFile> file;  // null: standard output
  };
  void write_by(void (*write_file)(OutputFile&, std::string_view), const DataTable& table);

  std::vector<One> files_;
};

}  // namespace chainreel

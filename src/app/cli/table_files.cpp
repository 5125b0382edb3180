#include "app/cli/table_files.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "core/error.hpp"

namespace chainreel {

void add_table_option(Command& command, std::vector<std::string>& outputs, const std::string& usual) {
  command.add_repeatable("-o,--output", outputs,
                         "a .csv, .json or .npz file, or - for CSV on standard output (repeatable; default " + usual + ")");
}

TableFiles::TableFiles(const std::vector<std::string>& paths, const CommonOptions& options) {
  refuse_twice(paths);
  for (const std::string& path : paths) {
    require_room_on_output(options, path);
    files_.push_back({path, table_format_of(path), nullptr});
  }
  for (One& one : files_)
    if (one.path != "-") one.file = std::make_unique<OutputFile>(one.path, options.force);
}

void TableFiles::write_by(void (*write_file)(OutputFile&, std::string_view), const DataTable& table) {
  for (One& one : files_) {
    const std::string bytes = table_bytes(table, one.format);
    if (one.file)
      write_file(*one.file, bytes);
    else
      std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  }
}

void TableFiles::write(const DataTable& table) {
  write_by(write_whole, table);
}

void TableFiles::write_partial(const DataTable& table) {
  write_by([](OutputFile& file, std::string_view text) {
    write_temporary(file, text);
    keep_and_tell(file);
  }, table);
}

std::vector<std::string> TableFiles::paths() const {
  std::vector<std::string> paths;
  for (const One& one : files_) paths.push_back(one.path);
  return paths;
}

void TableFiles::tell(const CommonOptions& options, std::size_t rows, const Json& found, const std::string& words) const {
  const auto all = [&] {
    Json told = files_json(paths());
    told.update(found);
    return told;
  };
  tell_result(options, all, [&] {
    for (const One& one : files_)
      if (one.file) std::printf("%s  %zu rows\n", one.path.c_str(), rows);
    if (std::ranges::all_of(files_, [](const One& one) { return one.file != nullptr; })) std::fputs(words.c_str(), stdout);
  });
}

}  // namespace chainreel

#include "app/commands/table_record.hpp"

#include <filesystem>

#include "app/commands/command_inputs.hpp"
#include "app/report/sidecar.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"
#include "scene/text/scene_paths.hpp"
#include "table/data_table.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  return fs::path(path).parent_path().string();
}

std::string record_of(const std::string& table) {
  return table + ".json";
}

// --package NAME=FOLDER names its folder behind the =.
std::size_t begin_of_path(const std::vector<std::string>& words, std::size_t i) {
  return i > 0 && words[i - 1] == "--package" ? words[i].find('=') + 1 : 0;
}

}  // namespace

TableRecords::TableRecords(const Command& command, const std::vector<std::string>& paths, const std::vector<std::string>& outputs, const CommonOptions& common)
    : command_(command), inputs_(command_inputs(command.words(), command.files())) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i] == "-" || table_format_of(paths[i]) == TableFormat::json) continue;
    require_own_sidecar(record_of(paths[i]), common.force);
    tables_.push_back({paths[i], outputs[i]});
  }
}

void TableRecords::write() const {
  const std::vector<std::string> given = command_.words();
  for (const One& table : tables_) {
    const std::string folder = folder_of(table.path);
    std::error_code code;
    if (!are_known(inputs_)) {
      if (is_own_sidecar(record_of(table.path))) fs::remove(record_of(table.path), code);
      continue;
    }
    std::vector<std::string> words = given;
    for (const std::size_t i : command_.files()) {
      const std::size_t begin = begin_of_path(given, i);
      words[i].replace(begin, std::string::npos, path_from(folder, given[i].substr(begin)));
    }
    const Json record{{kMadeBy, {{"arguments", words}, {"files", command_.files()}, {kInputs, inputs_}, {"output", fs::path(table.output).filename().string()}}},
                      {kAuditedFiles, Json::array({audited_file(table.path)})}};
    write_text_file(record_of(table.path), record.dump(2) + "\n", true);
  }
}

RecordedCommand recorded_command(const Json& record, const std::string& folder, const std::string& path) try {
  const Json& made = record.at(kMadeBy);
  RecordedCommand command{made.at("arguments"), made.at("files"), (fs::path(path).parent_path() / fs::path(made.at("output").get<std::string>()).filename()).string()};
  for (const std::size_t i : command.files) {
    std::string& word = command.words.at(i);
    const std::size_t begin = begin_of_path(command.words, i);
    const fs::path file(word.substr(begin));
    word.replace(begin, std::string::npos, (file.is_absolute() ? file : fs::path(folder) / file).lexically_normal().string());
  }
  return command;
} catch (const std::exception&) {
  throw Error(ExitCode::bad_input, "has a record beside it that was changed by hand: it does not say what made it", {path});
}

}  // namespace chainreel

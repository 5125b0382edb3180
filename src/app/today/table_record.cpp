#include "app/today/table_record.hpp"

#include <filesystem>

#include "app/film/clip_origin.hpp"
#include "app/film/formats.hpp"
#include "app/report/sidecar.hpp"
#include "app/today/command_inputs.hpp"
#include "core/error.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  return fs::path(path).parent_path().string();
}

std::string record_of(const std::string& table) {
  return table + ".json";
}

}  // namespace

void forget_record(const std::string& table) {
  std::error_code code;
  if (is_own_sidecar(record_of(table))) fs::remove(record_of(table), code);
}

void TableRecords::open(const std::vector<std::string>& paths, const std::vector<std::string>& outputs) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i] == "-" || find_output_format(paths[i], Shows::still) != nullptr) continue;
    require_own_sidecar(record_of(paths[i]), overwrite_);
    tables_.push_back({paths[i], outputs[i]});
  }
  if (!tables_.empty() && inputs_.is_null()) inputs_ = command_inputs(command_.words(), command_.files());
}

void TableRecords::remember_named_poses(const Json& figure) {
  named_poses_ = figure.value("named_poses", Json());
}

void TableRecords::write() {
  for (const One& table : tables_) {
    const std::string folder = folder_of(table.path);
    if (!are_known(inputs_)) {
      forget_record(table.path);
      continue;
    }
    const Json written = audited_file(table.path);  // may throw, see command_inputs
    Json record{{kMadeBy, {{"arguments", words_from(command_, folder)}, {"files", command_.files()}, {kInputs, inputs_}, {"output", fs::path(table.output).filename().string()}}},
                      {kAuditedFiles, Json::array({written})}};
    if (!named_poses_.is_null()) record[kMadeBy]["named_poses"] = named_poses_;
    write_text_file(record_of(table.path), record.dump(2) + "\n", true);
  }
  tables_.clear();
}

RecordedCommand recorded_command(const Json& record, const std::string& folder, const std::string& path) try {
  const Json made = figure_from(record.at(kMadeBy), {folder, true, {}, {}});
  RecordedCommand command{made.at("arguments"), made.at("files"), (fs::path(path).parent_path() / fs::path(made.at("output").get<std::string>()).filename()).string(), made.value("named_poses", Json())};
  for (const std::size_t i : command.files) command.words.at(i);  // throws
  return command;
} catch (const std::exception&) {
  throw Error(ExitCode::bad_input, "has a record beside it that was changed by hand: it does not say what made it", {path});
}

}  // namespace chainreel

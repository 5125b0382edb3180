#include "app/commands/files_of_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/film/clip_memory.hpp"
#include "app/film/house_logo.hpp"
#include "app/film/prepared.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/report.hpp"
#include "app/report/sidecar.hpp"
#include "app/report/version.hpp"
#include "app/works/growing_table.hpp"
#include "app/works/render_film.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "encode/cut_off.hpp"
#include "scene/text/scene_paths.hpp"
#include "sim/audit.hpp"

namespace chainreel {

namespace fs = std::filesystem;

bool is_there(const std::string& path) {
  std::error_code code;
  return fs::exists(path, code);
}

bool has_sidecars(const Target& target) {
  const std::string audit = audit_path_of(target.path);
  return is_there(audit) && is_there(fs::path(audit).replace_extension(".txt").string());
}

FilesOfRun::FilesOfRun(const PreparedFilm& film, double at)
    : film_(film), runs_(film), scene_(placeless_scene_text(film.scene)), meshes_(meshes_hash(film)), style_(style_report(film)), at_(at) {
  for (std::size_t i = 0; i < runs_.size(); ++i)
    hashes_.push_back({film.panels[i].scene.model.sha256(), audit_of(film.panels[i].simulation, runs_[i]).sha256});
}

bool FilesOfRun::is(const Target& target) const {
  try {
    if (target.format->shows == Shows::table) return has_tables(target.path);
    if (is_cut_off(target.path)) return is_told_of(target);
    const ClipMemory memory = recall(target.path);
    if (memory.scene != scene_ || !is_same(memory.audit)) return false;
    return target.format->shows != Shows::still || std::abs(memory.audit.value("at", HUGE_VAL) - at_) <= same_instant(film_.panels.front().simulation);
  } catch (const Error&) {
    return false;
  } catch (const Json::exception&) {
    return false;  // what it says was not written by this program
  }
}

std::string FilesOfRun::audit_beside(const Target& target) {
  return audit_path_of(target.path);
}

// What was cut off says nothing any more; the audit beside it does.
bool FilesOfRun::is_told_of(const Target& target) const {
  const Json json = parse_json(read_plain_file(audit_beside(target), kLargestGrown));
  const Json files = audited_files_of(json);
  const std::string name = fs::path(target.path).filename().string();
  return is_same(json) && std::any_of(files.begin(), files.end(), [&](const Json& one) { return one.value("file", "") == name; });
}

// A table says nothing of its run, and is it.
bool FilesOfRun::has_tables(const std::string& path) const {
  for (std::size_t i = 0; i < runs_.size(); ++i)
    if (read_plain_file(panel_table_path(path, i, runs_.size() == 1), kLargestGrown) !=
        table_bytes(motion_table(film_.panels[i].simulation, runs_[i]), table_format_of(path)))
      return false;
  return true;
}

bool FilesOfRun::is_same(const Json& audit) const {
  const bool compares = audit.contains("panels") && !audit["panels"].empty();
  const Json panels = compares ? audit["panels"] : Json::array({audit});
  if (panels.size() != hashes_.size() || audit.at("versions").at("chainreel") != program_version()) return false;
  if (audit.value(kMeshesHash, Json()) != or_null(meshes_) || audit.value("style", Json()) != style_) return false;
  for (std::size_t i = 0; i < hashes_.size(); ++i)
    if (panels[i].value("model_sha256", "") != hashes_[i].first || panels[i].value("trajectory_sha256", "") != hashes_[i].second)
      return false;
  return true;
}

}  // namespace chainreel

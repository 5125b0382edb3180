#include "app/today/asked_films.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "app/cli/streams.hpp"
#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "app/film/formats.hpp"
#include "app/report/audit_check.hpp"
#include "app/report/sidecar.hpp"
#include "core/error.hpp"
#include "encode/cut_off.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// Which audits of a folder tell of a file that has none beside it. Each folder is read once.
class AuditsOfFolders {
 public:
  // Whether it is a further frame of a sequence that an audit of its folder tells of by its first.
  bool is_further_frame(const std::string& path) {
    const fs::path file(path);
    const auto [folder, is_new] = folders_.try_emplace(file.has_parent_path() ? file.parent_path().string() : ".");
    if (is_new) read(folder->first, folder->second);
    return folder->second.frames.contains(file.filename().string());
  }

  // What tells of a file: itself where an audit lies beside it, else the one audit of its folder that does; "" where none or several do.
  std::string telling_of(const std::string& path) {
    const fs::path file(path);
    std::error_code code;
    if (find_output_format(path, Shows::table) == nullptr && is_table(path)) return path + ".json";
    if (lower_case_ending(path) == ".json") return "";  // by itself it would be an audit
    if (fs::is_regular_file(audit_path_of(path), code)) return path;
    const auto [folder, is_new] = folders_.try_emplace(file.has_parent_path() ? file.parent_path().string() : ".");
    if (is_new) read(folder->first, folder->second);
    const std::vector<std::string>& audits = folder->second.tellers[file.filename().string()];
    return audits.size() == 1 ? audits.front() : "";
  }

 private:
  struct Folder {
    std::map<std::string, std::vector<std::string>> tellers;  // of each file's name the audits that tell of it
    std::set<std::string> frames;                             // names of those behind the first ones of sequences
  };

  static void read(const std::string& folder, Folder& found) {
    std::error_code code;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
      const std::string path = entry->path().string();
      if (lower_case_ending(path) != ".json") continue;
      for (const Json& one : audited_files_of(audit_beside(path))) {
        found.tellers[word_of(one, "file")].push_back(path);
        for (std::size_t k = 1; k < frames_told(one); ++k) found.frames.insert(name_of_frame(word_of(one, "file"), k));
      }
    }
  }

  std::map<std::string, Folder> folders_;
};

OwnAudit own_audit(const std::string& path, AuditsOfFolders& audits) {
  try {
    const std::string telling = audits.telling_of(path);
    if (telling.empty()) return {};
    const AuditCheck check = check_audit(telling);
    const auto own = std::find_if(check.files.begin(), check.files.end(), [&](const AuditCheck::File& file) {
      return fs::path(file.path).filename() == fs::path(path).filename();
    });
    if (own == check.files.end()) return {};
    OwnAudit audit{audit_beside(telling), own->state != AuditedState::as_written || !check.contradicted.empty(), fs::path(check.audit).parent_path().string()};
    for (const Json& one : audited_files_of(audit.json))
      if (word_of(one, "file") == fs::path(path).filename().string()) audit.at = one.value("at", Json());
    const bool is_record = audit.json.is_object() && audit.json.contains(kMadeBy);
    const bool is_sequence = std::ranges::any_of(audited_files_of(audit.json), [](const Json& one) { return one.is_object() && one.contains(kFrameHashes); });
    for (const AuditCheck::File& file : check.files) {
      if (is_record || file.state == AuditedState::as_written || file.path == own->path) continue;
      const bool is_frame = is_sequence && lower_case_ending(file.path) == ".png";
      if (file.state == AuditedState::missing && (is_frame || find_output_format(file.path) == nullptr))
        audit.beside.push_back(file.path + " is gone: the audit beside it tells of it");
      else if (is_frame)
        audit.beside.push_back(file.path + " is not as it was written");
    }
    return audit;
  } catch (const Error&) {
    return {};
  }
}

// What a film or picture remembers; nothing of tables, and of files that remember nothing.
std::optional<ClipMemory> memory_in(const std::string& path) {
  if (is_table(path)) return std::nullopt;
  try {
    return recall(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool tells_what_it_shows(const ClipMemory& memory) {
  return memory.figure.is_null() || !first_file_of(memory.figure).empty();
}

// What an audit tells of that lay beside it, and does not any more.
void add_gone(const std::string& audit, std::vector<AskedFilm>& list) {
  const Json json = audit_beside(audit);
  if (!json.is_object() || (word_of(json, kScenePath).empty() && !json.contains(kMadeBy))) return;
  const fs::path folder = fs::path(audit).parent_path();
  for (const Json& one : audited_files_of(json)) {
    const std::string file = (folder / fs::path(word_of(one, "file")).filename()).string();
    std::error_code code;
    if ((find_output_format(file) != nullptr || json.contains(kMadeBy)) && !fs::exists(fs::symlink_status(file, code)))
      list.push_back({file, {json, false, folder.string(), one.value("at", Json())}, true});
  }
}

// Scenes and models of the names that films and pictures remember, in folders that hold all that they need besides.
class ScenesRemembered {
 public:
  // "" where there is none.
  std::string of(const std::string& path, const ClipMemory& memory) {
    try {
      const std::string name = memory.figure.is_null() ? word_of(memory.audit, "scene") : fs::path(first_file_of(memory.figure)).filename().string();
      if (name.empty() || fs::path(name).filename() != fs::path(name)) return "";
      const Json& telling = memory.figure.is_null() ? memory.audit : memory.figure;
      return look_for(path, name, files_wanted_by(memory), telling.is_object() && telling.value(kShipped, Json()) == Json(true));
    } catch (const Error&) {
      return "";
    }
  }

 private:
  std::string look_for(const std::string& path, const std::string& name, const std::vector<WantedFile>& needed, bool shipped) {
    std::vector<std::string> key{fs::path(path).parent_path().string(), name, shipped ? "shipped" : ""};
    for (const WantedFile& file : needed) key.insert(key.end(), {file.path, file.sha256});
    const auto [known, is_new] = found_.try_emplace(key);
    if (!is_new) return known->second;
    std::vector<WantedFile> wanted = needed;
    if (std::ranges::none_of(wanted, [&](const WantedFile& file) { return file.path == name; })) wanted.push_back({name, ""});
    const ClipOrigin origin = find_nearest(path, name, wanted, shipped);
    if (origin.is_found) known->second = (fs::path(origin.folder) / name).lexically_normal().string();
    return known->second;
  }

  std::map<std::vector<std::string>, std::string> found_;  // a search may look into thousands of folders
};

}  // namespace

bool is_table(const std::string& path) {
  static const std::vector<std::string> kBesideRecords = {".json", ".tex", ".py", ".txt"};
  return find_output_format(path, Shows::table) != nullptr || (std::ranges::count(kBesideRecords, lower_case_ending(path)) > 0 && is_own_sidecar(path + ".json"));
}

AskedFilms asked_films(const std::vector<std::string>& paths) {
  AskedFilms all;
  AuditsOfFolders audits;
  ScenesRemembered scenes;
  const auto asked = [&](const std::string& file, const std::optional<ClipMemory>& memory) {
    AskedFilm film{file, own_audit(file, audits)};
    if (film.audit.json.is_object() || !memory) return film;
    film.scene = scenes.of(file, *memory);
    if (memory->audit.is_object()) film.set = memory->audit.value(kSet, Json());
    return film;
  };
  for (const std::string& path : paths) {
    std::error_code code;
    if (!fs::is_directory(path, code)) {
      all.list.push_back(asked(path, memory_in(path)));
      continue;
    }
    const std::size_t before = all.list.size();
    for (fs::recursive_directory_iterator entry(path, fs::directory_options::skip_permission_denied, code), end; !code && entry != end; entry.increment(code)) {
      throw_if_interrupted();
      const std::string file = entry->path().string();
      if (entry->is_regular_file(code) && lower_case_ending(file) == ".json") add_gone(file, all.list);
      const OutputFormat* format = find_output_format(file);
      if (!entry->is_regular_file(code) || !(is_table(file) || (format != nullptr && format->read_tags != nullptr))) continue;
      if (lower_case_ending(file) == ".png" && audits.is_further_frame(file)) continue;  // asked with the first
      const std::optional<ClipMemory> memory = memory_in(file);
      // What remembers nothing may be the half of a film that its audit tells of.
      AskedFilm film = is_table(file) || !memory || tells_what_it_shows(*memory) ? asked(file, memory) : AskedFilm{file};
      film.is_broken = !memory && !film.audit.json.is_object() && (is_cut_off(file) || entry->file_size(code) == 0);
      if (film.is_broken || film.audit.json.is_object() || !film.scene.empty())
        all.list.push_back(std::move(film));
      else
        all.passed_over.push_back(file);
    }
    if (code) throw Error(ExitCode::bad_input, "cannot be read as a folder: " + code.message(), {path});
    if (all.list.size() == before) throw Error(ExitCode::bad_input, "holds no film, picture or table with an audit that tells its scene", {path});
    std::sort(all.list.begin() + std::ptrdiff_t(before), all.list.end(), [](const AskedFilm& a, const AskedFilm& b) { return a.path < b.path; });
  }
  std::sort(all.passed_over.begin(), all.passed_over.end());
  return all;
}

std::string scene_behind(const AskedFilm& film) {
  if (film.is_broken) throw Error(ExitCode::bad_input, "is empty or cut off, and no audit beside it tells what it showed: make it again", {film.path});
  if (!film.scene.empty()) return film.scene;
  const auto refuse = [&](const std::string& why) { throw Error(ExitCode::bad_input, why + ": name it, --scene SCENE.yaml", {film.path}); };
  if (!film.audit.json.is_object())
    refuse("has no audit beside it, NAME.json, which tells where its scene lies and what --set changed, and no scene of the name that it remembers lies about");
  const std::string told = word_of(film.audit.json, kScenePath);
  if (told.empty()) refuse("does not tell which file its scene is");
  const std::string scene = (fs::path(film.audit.folder) / told).lexically_normal().string();
  std::error_code code;
  if (!fs::is_regular_file(scene, code)) refuse("its scene " + scene + " is not there any more");
  return scene;
}

}  // namespace chainreel

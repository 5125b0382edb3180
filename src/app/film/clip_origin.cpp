#include "app/film/clip_origin.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <optional>
#include <set>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "model/xml_text.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 4;                  // folders below one that is looked in
constexpr int kHighest = 3;                  // .. and above
constexpr int kBeside = 2;                   // scenes often lie beside the folder of their pictures
constexpr std::size_t kMostFolders = 3'000;  // a home may hold millions

// Folders in which the files may be, nearest first. One at a time: most searches end with the first.
class Candidates {
 public:
  // The starts, those around them, then those below them. `beside`: so many folders deep below the first one around a start it is looked, too,
  // one less below the next.
  explicit Candidates(const std::vector<fs::path>& starts, int beside = 0) {
    for (const fs::path& start : starts) add(start, 0);
    for (fs::path start : starts)
      for (int up = 0; up < kHighest && start.has_relative_path(); ++up)
        add(start = start.parent_path(), kDeepest - std::max(0, beside - up));
  }

  std::optional<fs::path> next() {
    if (waiting_.empty() || seen_.size() > kMostFolders) return std::nullopt;
    const auto [folder, depth] = waiting_.front();
    waiting_.pop_front();
    if (depth < kDeepest) add_folders_in(folder, depth + 1);
    return folder;
  }

 private:
  void add(const fs::path& folder, int depth) {
    if (seen_.insert(folder).second) waiting_.emplace_back(folder, depth);
  }

  // In an order that does not depend on the file system; neither hidden ones nor those behind links.
  void add_folders_in(const fs::path& folder, int depth) {
    std::error_code code;
    std::vector<fs::path> found;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
      std::error_code ignored;
      if (entry->path().filename().string().front() != '.' && !entry->is_symlink(ignored) &&
          entry->is_directory(ignored))
        found.push_back(entry->path());
      if (found.size() > kMostFolders) break;
    }
    std::sort(found.begin(), found.end());
    for (const fs::path& one : found) add(one, depth);
  }

  std::deque<std::pair<fs::path, int>> waiting_;  // with how far below a start
  std::set<fs::path> seen_;
};

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_changed(const fs::path& path, const std::string& before) {
  std::error_code ignored;
  if (before.empty() || !fs::is_regular_file(path, ignored)) return false;
  return fs::file_size(path, ignored) > kLargestXmlFile || sha256_of_file(path.string()) != before;
}

// As people write it who stand in the working folder.
std::string seen_from_here(const fs::path& path) {
  return path_from("", path.lexically_normal().string());
}

// `or_shipped`: what is not there may be what comes with the program under that name.
ClipOrigin look_in(const fs::path& folder, const std::vector<WantedFile>& wanted, bool or_shipped = false) {
  ClipOrigin origin{seen_from_here(folder), true, {}, {}};
  for (const WantedFile& file : wanted) {
    fs::path path = (folder / file.path).lexically_normal();
    if (const std::string shipped = or_shipped ? shipped_input(file.path) : ""; !shipped.empty() && !is_there(path)) path = shipped;
    if (!is_there(path))
      origin.missing.push_back(file.path);
    else if (is_changed(path, file.sha256))
      origin.changed.push_back(seen_from_here(path));
  }
  origin.is_found = origin.missing.empty();
  return origin;
}

// What comes with the program.
std::optional<ClipOrigin> shipped_origin(const fs::path& here, const std::vector<WantedFile>& wanted) {
  ClipOrigin shipped = look_in(here, wanted, true);
  if (shipped.is_found && shipped.changed.empty()) return shipped;
  if (const std::string data = data_folder(); !data.empty()) {
    ClipOrigin own = look_in(fs::path(data) / "assets/scenes", wanted);
    if (own.is_found && own.changed.empty()) return own;
  }
  return std::nullopt;
}

void add_hash(const Json& part, std::vector<WantedFile>& wanted) {
  const std::string model = word_of(part, "model"), hash = word_of(part, "model_sha256");
  for (WantedFile& file : wanted)
    if (file.path == model) file.sha256 = hash;
}

}  // namespace

std::string word_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

std::size_t begin_of_path(const std::string& word, const std::string& before) {
  return before == "--package" ? word.find('=') + 1 : 0;
}

std::string torque_function_in(const Json& audit) {
  if (!audit.is_object()) return "";
  std::string words = word_of(audit, "torque_function");
  const Json panels = audit.value("panels", Json());
  for (const Json& panel : panels.is_array() ? panels : Json::array())
    if (words.empty()) words = word_of(panel, "torque_function");
  return words;
}

ClipOrigin find_origin(const std::string& clip, const std::vector<WantedFile>& wanted,
                       const std::string& given) {
  std::error_code code;
  const fs::path here = fs::current_path(code);
  if (!given.empty()) return look_in(here / given, wanted);
  ClipOrigin first = look_in(here, wanted);
  if (first.is_found) return first;
  Candidates candidates({here, (here / clip).lexically_normal().parent_path()});
  std::optional<ClipOrigin> changed;
  while (const std::optional<fs::path> folder = candidates.next()) {
    ClipOrigin origin = look_in(*folder, wanted);
    if (!origin.is_found) continue;
    if (origin.changed.empty()) return origin;
    if (!changed) changed = std::move(origin);
  }
  if (std::optional<ClipOrigin> shipped = shipped_origin(here, wanted)) return *shipped;
  return changed.value_or(first);
}

ClipOrigin find_nearest(const std::string& clip, const std::string& first, const std::vector<WantedFile>& wanted, bool shipped) {
  std::error_code code;
  const fs::path here = fs::current_path(code);
  if (shipped) {
    const std::string own = shipped_file(fs::path(first).filename().string());
    return own.empty() ? ClipOrigin{"", false, {}, {first}} : look_in(fs::path(own).parent_path(), wanted, true);
  }
  for (const fs::path& start : {(here / clip).lexically_normal().parent_path(), here}) {
    Candidates candidates({start}, kBeside);
    while (const std::optional<fs::path> folder = candidates.next()) {
      if (!is_there(*folder / first)) continue;
      if (ClipOrigin origin = look_in(*folder, wanted, true); origin.is_found) return origin;
    }
  }
  return shipped_origin(here, wanted).value_or(look_in(here, wanted));
}

namespace {

// The words of a figure that are files, each with where its path begins: behind the = of --package
// NAME=FOLDER.
std::vector<std::pair<std::size_t, std::size_t>> file_words_of(const Json& figure) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  const Json files = figure.value("files", Json::array()), words = figure.value("arguments", Json::array());
  if (!files.is_array() || !words.is_array()) return found;
  for (const Json& file : files) {
    const std::size_t index = file.is_number_unsigned() ? file.get<std::size_t>() : 0;
    if (index == 0 || index >= words.size() || !words[index].is_string()) continue;
    found.emplace_back(index, begin_of_path(words[index], words[index - 1].is_string() ? words[index - 1].get<std::string>() : ""));
  }
  return found;
}

std::string moved_path(const std::string& path, const ClipOrigin& origin) {
  return fs::path(path).is_absolute() ? path : (fs::path(origin.folder) / path).lexically_normal().string();
}

}  // namespace

std::string first_file_of(const Json& figure) {
  if (!word_of(figure, "model_sha256").empty()) return word_of(figure, "model");
  if (!figure.contains(kInputs)) return "";
  for (const auto& [index, begin] : file_words_of(figure))
    if (begin == 0) return figure["arguments"][index].get<std::string>();
  return "";
}

std::vector<WantedFile> files_wanted_by(const ClipMemory& memory) {
  std::vector<WantedFile> wanted;
  if (memory.figure.is_null()) {
    for (const std::string& path : relative_paths_in(memory.scene)) wanted.push_back({path, ""});
    add_hash(memory.audit, wanted);
    if (memory.audit.contains("panels") && memory.audit["panels"].is_array())
      for (const Json& panel : memory.audit["panels"]) add_hash(panel, wanted);
    return wanted;
  }
  for (const auto& [index, begin] : file_words_of(memory.figure)) {
    const std::string path = memory.figure["arguments"][index].get<std::string>().substr(begin);
    if (!fs::path(path).is_absolute()) wanted.push_back({path, ""});
  }
  add_hash(memory.figure, wanted);
  return wanted;
}

Json figure_from(const Json& figure, const ClipOrigin& origin) {
  Json moved = figure;
  for (const auto& [index, begin] : file_words_of(figure)) {
    std::string word = figure["arguments"][index];
    moved["arguments"][index] =
        word.replace(begin, std::string::npos, moved_path(word.substr(begin), origin));
  }
  if (figure.contains("files") && !word_of(figure, "model").empty())
    moved["model"] = moved_path(figure["model"], origin);
  return moved;
}

}  // namespace chainreel

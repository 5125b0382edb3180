#include "app/report/sidecar.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "app/film/clip_memory.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// Null unless it is an audit of ours, or the record x.csv.json of a table that a command by itself made, see kMadeBy.
Json told_at(const fs::path& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return nullptr;
  const Json json = parse_json(read_plain_file(path.string(), kLargestSidecar));
  if (!json.is_object()) return nullptr;
  const bool is_audit = json.contains("film_seconds") && json.contains("versions"), is_record = json.contains(kMadeBy) && json.contains(kAuditedFiles);
  return is_audit || is_record ? json : Json();
}

// Null unless it is an audit.
Json audit_at(const fs::path& path) {
  Json told = told_at(path);
  return told.is_object() && told.contains(kMadeBy) ? Json() : told;
}

// Texts bear no mark that a reader would not see; older audits do not tell of them.
bool is_known_text(const fs::path& path, const char* words_of_older_versions) {
  const Json audit = audit_at(fs::path(path).replace_extension(".json"));
  if (audit.is_null()) return false;
  const std::string text = read_plain_file(path.string(), kLargestSidecar);
  const Json hashes = audit.value(kSidecarHashes, Json());
  if (!hashes.is_object()) return text.find(words_of_older_versions) != std::string::npos;
  return hashes.value(path.extension().string(), Json()) == Json(sha256_of(text));
}

bool is_own(const fs::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".json") return !told_at(path).is_null();
  if (ending == ".txt") return is_known_text(path, "times are those of the motion");
  if (ending == ".srt") return is_known_text(path, " --> ");
  if (ending == ".tex" || ending == ".csv") {
    const std::string text = read_plain_file(path.string(), kLargestSidecar).substr(0, 4096);
    return ending == ".tex" ? text.starts_with("% \\usepackage{animate}")
                            : text.starts_with("# ") && text.find("\n# revision: ") != std::string::npos;
  }
  const ClipMemory memory = recall(path.string());
  return !memory.scene.empty() || !memory.figure.is_null();
}

}  // namespace

Json audited_files_of(const Json& audit) {
  const Json files = audit.is_object() ? audit.value(kAuditedFiles, Json()) : Json();
  return files.is_array() ? files : Json::array();
}

Json audited_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const HashedBytes hashed = hash_of_stream(file, path);
  return {{"file", fs::path(path).filename().string()}, {"bytes", hashed.bytes}, {"sha256", hashed.sha256}};
}

std::string frame_hashes(const std::string& first, int frames) {
  std::string hashes;
  for (int k = 0; k < frames; ++k) {
    const std::string frame = name_of_frame(first, std::size_t(k));
    std::error_code code;
    if (!fs::is_regular_file(frame, code)) return "";
    hashes += sha256_of_file(frame).substr(0, kHashDigits);
  }
  return hashes;
}

std::size_t frames_told(const Json& entry) {
  const bool is_sequence = entry.is_object() && entry.contains(kFrameHashes) && entry.contains("frames") && entry["frames"].is_number_unsigned();
  constexpr std::size_t kMost = 10'000'000;  // an audit may be changed by hand
  return is_sequence ? std::min(kMost, entry["frames"].get<std::size_t>()) : 1;
}

std::string name_of_frame(const std::string& first, std::size_t k) {
  const std::size_t behind_stem = PngSequence::file_name("", 0).size();
  return PngSequence::file_name(first.substr(0, first.size() - std::min(first.size(), behind_stem)), int(k));
}

Json clip_facts(int width, int height, FrameRate fps, int frames) {
  const int common = std::gcd(fps.num, fps.den), num = fps.num / common, den = fps.den / common;
  return {{"frames", frames},
          {"fps", den == 1 ? Json(num) : Json(std::to_string(num) + "/" + std::to_string(den))},
          {"width", width},
          {"height", height},
          {"film_seconds", frame_time(frames, fps)}};
}

std::string audit_path_of(const std::string& file) {
  const std::string own = file + ".json";
  return is_own_sidecar(own) ? own : fs::path(file).replace_extension(".json").string();
}

Json audit_beside(const std::string& file) {
  try {
    const std::string path = audit_path_of(file);
    Json audit = parse_json(read_plain_file(path, kLargestSidecar));
    note_input(path);
    return audit.is_object() ? audit : Json();
  } catch (const Error&) {
    return Json();
  }
}

std::size_t frames_told_at(const std::string& path, const std::string& first) {
  try {
    for (const Json& one : audited_files_of(audit_at(path)))
      if (one.is_object() && one.value("file", "") == fs::path(first).filename().string()) return frames_told(one);
  } catch (const std::exception&) {
    // No audit that can be read.
  }
  return 0;
}

OtherFiles others_audited(const std::string& path, const std::vector<std::string>& files, const Json& audit) {
  OtherFiles others;
  try {
    const Json before = audit_at(path);
    if (before.is_null()) return others;
    const auto shown = [](Json json) {
      for (const char* own : {kAuditedFiles, kSidecarHashes, "seconds"}) json.erase(own);
      if (json.contains(kDrawnFrames) && json[kDrawnFrames].is_object()) json.update(Json(json[kDrawnFrames]));
      json.erase(kDrawnFrames);
      return json;
    };
    const bool is_same = shown(before) == shown(audit);
    for (const Json& one : audited_files_of(before)) {
      const fs::path file = fs::path(path).parent_path() / one.value("file", "");
      std::error_code code;
      if (std::find(files.begin(), files.end(), file.string()) != files.end() || !fs::is_regular_file(file, code)) continue;
      if (is_same)
        others.entries.push_back(one);
      else
        others.are_others.push_back(file.string());
    }
  } catch (const Error&) {
    return {};  // what cannot be read as ours
  } catch (const Json::exception&) {
    return {};
  }
  return others;
}

Json audit_without(const std::string& path, const std::vector<std::string>& files) {
  Json audit = audit_at(path), left = Json::array();
  const Json told = audited_files_of(audit);
  for (const Json& one : told) {
    const std::string file = (fs::path(path).parent_path() / one.value("file", "")).string();
    if (std::find(files.begin(), files.end(), file) == files.end()) left.push_back(one);
  }
  if (left.size() == told.size()) return nullptr;
  audit[kAuditedFiles] = left;
  return audit;
}

bool is_changed_since(const std::string& path) {
  try {
    const Json audit = told_at(audit_path_of(path));
    if (audit.is_null()) return false;
    const Json now = audited_file(path);
    for (const Json& one : audited_files_of(audit))
      if (one.value("file", "") == now.value("file", "")) return one.value("sha256", "") != now.value("sha256", "");
    return false;
  } catch (const Error&) {
    return true;
  } catch (const Json::exception&) {
    return true;
  }
}

bool is_own_sidecar(const std::string& path) {
  try {
    return is_own(path);
  } catch (const Error&) {
    return false;  // what cannot be read as ours
  }
}

void require_own_sidecar(const std::string& path, bool overwrite) {
  std::error_code code;
  if (overwrite || !fs::exists(path, code) || is_own_sidecar(path)) return;
  throw Error(ExitCode::file,
              "lies where a file of this output belongs, and this program did not write it, or it has been changed "
              "since: move it away, give another name with -o, or give --force to overwrite it",
              {path});
}

}  // namespace chainreel

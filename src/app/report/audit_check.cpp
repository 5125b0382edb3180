#include "app/report/audit_check.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/film/clip_memory.hpp"
#include "app/report/sidecar.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

const char* word_of(AuditedState state) {
  switch (state) {
    case AuditedState::as_written:
      return "as written";
    case AuditedState::changed:
      return "CHANGED";
    case AuditedState::missing:
      return "MISSING";
  }
  return "";
}

AuditCheck::File look_at(const fs::path& path, const std::string& expected) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return {path.string(), AuditedState::missing, "", expected};
  note_input(path.string());
  const std::string sha256 = audited_file(path.string())["sha256"];
  return {path.string(), sha256 == expected ? AuditedState::as_written : AuditedState::changed, sha256, expected};
}

// What a film or picture remembers of its run, but where its scene lay, and of frames, of which smaller clips have fewer.
std::vector<std::string> contradictions(const std::string& path, const Json& audit) {
  static const std::set<std::string> own{"scene", "model", "frames", "fps", "width", "height", "film_seconds"};
  std::vector<std::string> keys;
  try {
    const Json remembered = recall(path).audit;
    for (const auto& [key, value] : remembered.items())
      if (!own.contains(key) && (!audit.contains(key) || audit[key] != value)) keys.push_back(key);
    // Of the rest the audit has what says nothing, and what is known behind the last frame alone.
    static const std::set<std::string> later{"seconds", kAuditedFiles, kSidecarHashes, kDrawnFrames, "held_frames"};
    for (const auto& [key, value] : audit.items())
      if (!own.contains(key) && !later.contains(key) && !remembered.contains(key) && !value.empty()) keys.push_back(key);
  } catch (const Error&) {
    // One of a kind that remembers nothing, or that no longer can be read: its bytes say so.
  }
  return keys;
}

Json read_audit(const std::string& path, const std::string& asked) {
  std::error_code code;
  const std::string beside = "render and snapshot write one beside what they make, NAME.json";
  if (!fs::is_regular_file(path, code)) throw Error(ExitCode::bad_input, "there is no audit " + path + ": " + beside, {asked});
  note_input(path);
  const Json json = parse_json(read_plain_file(path, kLargestSidecar));
  if (!json.is_object() || !json.contains(kAuditedFiles) || !json[kAuditedFiles].is_array())
    throw Error(ExitCode::bad_input, "is no audit of a film or picture: " + beside, {path});
  return json;
}

}  // namespace

bool AuditCheck::passes() const {
  return contradicted.empty() &&
         std::all_of(files.begin(), files.end(), [](const File& file) { return file.state == AuditedState::as_written; });
}

AuditCheck check_audit(const std::string& path) {
  const fs::path asked(path), folder = asked.parent_path();
  AuditCheck check;
  check.audit = fs::path(asked).replace_extension(".json").string();
  const Json audit = read_audit(check.audit, path);
  bool is_told_of = lower_case_ending(path) == ".json";
  try {
    for (const Json& one : audit[kAuditedFiles]) {
      const std::string name = one.at("file");
      is_told_of = is_told_of || name == asked.filename();
      check.files.push_back(look_at(folder / name, one.at("sha256")));
      if (check.files.back().state == AuditedState::missing) continue;
      for (const std::string& key : contradictions(check.files.back().path, audit))
        if (std::find(check.contradicted.begin(), check.contradicted.end(), key) == check.contradicted.end()) check.contradicted.push_back(key);
    }
    if (audit.contains(kSidecarHashes) && audit[kSidecarHashes].is_object())
      for (const auto& [ending, hash] : audit[kSidecarHashes].items())
        check.files.push_back(look_at(fs::path(asked).replace_extension(ending), hash));
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "is an audit that was changed by hand: its files have no names or no hashes", {check.audit});
  }
  if (!is_told_of) throw Error(ExitCode::bad_input, "is nothing that " + check.audit + " tells of", {path});
  return check;
}

std::vector<std::string> words_of(const AuditCheck& check) {
  std::vector<std::string> lines;
  for (const AuditCheck::File& file : check.files)
    lines.push_back(std::string(word_of(file.state)) + "  " + file.path +
                    (file.state == AuditedState::changed ? ": its SHA-256 is " + file.sha256 + ", the audit says " + file.expected
                                                         : ", SHA-256 " + file.expected));
  if (!check.contradicted.empty())
    lines.push_back("CHANGED  " + check.audit + ": " + joined(check.contradicted) + (check.contradicted.size() == 1 ? " is" : " are") + " not what the film remembers");
  return lines;
}

Json to_json(const AuditCheck& check) {
  Json json{{"audit", check.audit}, {"passes", check.passes()}, {"audited", Json::array()}, {"contradicted", check.contradicted}};
  for (const AuditCheck::File& file : check.files)
    json["audited"].push_back({{"file", file.path},
                               {"state", file.state == AuditedState::as_written ? "as written"
                                         : file.state == AuditedState::changed ? "changed"
                                                                               : "missing"},
                               {"sha256", file.sha256.empty() ? Json(nullptr) : Json(file.sha256)},
                               {"expected", file.expected}});
  return json;
}

}  // namespace chainreel

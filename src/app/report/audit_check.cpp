#include "app/report/audit_check.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
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

Error changed_by_hand(const std::string& audit) {
  return Error(ExitCode::bad_input, "is an audit that was changed by hand: its files have no names or no hashes", {audit});
}

// As the audit tells of a file beside it.
struct Told {
  std::string name, sha256;
  std::optional<std::uintmax_t> bytes;
};

// Throws Error of what no program of ours wrote: names of other folders, hashes that are none.
void require_ours(const Told& told, const std::string& audit) {
  const bool is_name = !told.name.empty() && fs::path(told.name).filename() == told.name;
  const bool is_hash = told.sha256.size() == 64 && told.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!is_name || !is_hash) throw changed_by_hand(audit);
}

AuditCheck::File look_at(const fs::path& path, const std::string& expected, std::optional<std::uintmax_t> bytes = {}) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return {path.string(), AuditedState::missing, "", expected};
  note_input(path.string());
  const std::string sha256 = audited_file(path.string())["sha256"];
  const bool is_same = sha256 == expected && (!bytes || fs::file_size(path, code) == *bytes);
  return {path.string(), is_same ? AuditedState::as_written : AuditedState::changed, sha256, expected};
}

// Scene and model by the names of their files alone, since a film does not remember where they lay, and with the frames that a smaller clip was made of.
Json comparable(Json audit) {
  if (const Json drawn = audit.value(kDrawnFrames, Json()); drawn.is_object()) audit.update(drawn);
  const auto leave_places = [](Json& part) {
    for (const char* key : {"scene", "model"}) {
      const auto named = part.is_object() ? part.find(key) : part.end();
      if (named == part.end() || !named->is_string()) continue;
      const std::string words = *named;
      if (!words.starts_with('{')) *named = fs::path(words).filename().string();  // else the model's numbers themselves
    }
  };
  leave_places(audit);
  if (audit.contains("panels") && audit["panels"].is_array())
    for (Json& panel : audit["panels"]) leave_places(panel);
  return audit;
}

bool holds_no_frame(const Json& held) {
  return held.is_object() && held.value("first", Json()) == 0 && held.value("last", Json()) == 0;
}

// Keys of the audit that a film or picture remembers otherwise. Throws Error where it remembers nothing.
std::vector<std::string> contradictions(const std::string& path, const Json& written) {
  // What is known behind the last frame alone; of the rest an audit has besides what says nothing.
  static const std::set<std::string> later{"seconds", kMechanisms, kTables, kSet, kScenePath, kAuditedFiles, kSidecarHashes, kDrawnFrames};
  const Json audit = comparable(written), remembered = comparable(recall(path).audit);
  std::vector<std::string> keys;
  for (const auto& [key, value] : remembered.items())
    if (key != "at" && (!audit.contains(key) || audit[key] != value)) keys.push_back(key);  // a still's own instant
  for (const auto& [key, value] : audit.items())
    if (!later.contains(key) && !remembered.contains(key) && !value.empty() && !(key == "held_frames" && holds_no_frame(value)))
      keys.push_back(key);
  return keys;
}

Json read_audit(const std::string& path, const std::string& asked) {
  std::error_code code;
  const std::string beside = "render writes one beside its films and pictures, NAME.json";
  if (!fs::is_regular_file(path, code)) throw Error(ExitCode::bad_input, "there is no audit " + path + ": " + beside, {asked});
  note_input(path);
  const Json json = parse_json(read_plain_file(path, kLargestSidecar));
  if (!json.is_object() || !json.contains(kAuditedFiles) || !json[kAuditedFiles].is_array())
    throw Error(ExitCode::bad_input, "is no audit of a film or picture: " + beside, {path});
  return json;
}

void add_contradictions(AuditCheck& check, const Json& audit) {
  try {
    for (const std::string& key : contradictions(check.files.back().path, audit))
      if (std::find(check.contradicted.begin(), check.contradicted.end(), key) == check.contradicted.end()) check.contradicted.push_back(key);
    check.is_remembered = true;
  } catch (const Error&) {
    // A table, or another file that remembers nothing.
  }
}

// Of a sequence the frames behind the first that are not as they were written. Of one made in parts the audit has no hashes: whether
// they are there is seen.
void add_frames(AuditCheck& check, const fs::path& first, const Json& told) {
  const std::string hashes = told[kFrameHashes].is_string() ? told[kFrameHashes].get<std::string>() : "";
  for (std::size_t k = 1; k < frames_told(told); ++k) {
    const std::string expected = hashes.substr(std::min(hashes.size(), k * kHashDigits), kHashDigits);
    AuditCheck::File frame = look_at(name_of_frame(first.string(), k), expected);
    if (frame.state == AuditedState::changed && frame.sha256.starts_with(expected)) continue;
    check.files.push_back(std::move(frame));
  }
}

}  // namespace

std::span<const Name> names_of(AuditedState) {
  static constexpr Name names[] = {{"as written", "its bytes are those that the audit tells of"},
                                   {"changed", "it is there with other bytes"},
                                   {"missing", "it is not there"}};
  return names;
}

bool AuditCheck::passes() const {
  return contradicted.empty() &&
         std::all_of(files.begin(), files.end(), [](const File& file) { return file.state == AuditedState::as_written; });
}

AuditCheck check_audit(const std::string& path) {
  const fs::path asked(path), folder = asked.parent_path();
  AuditCheck check;
  std::vector<std::string> names;
  check.audit = lower_case_ending(path) == ".json" ? path : audit_path_of(path);
  const Json audit = read_audit(check.audit, path);
  bool is_told_of = lower_case_ending(path) == ".json";
  try {
    for (const Json& one : audit[kAuditedFiles]) {
      const Told told{one.at("file"), one.at("sha256"), one.contains("bytes") ? std::optional(one["bytes"].get<std::uintmax_t>()) : std::nullopt};
      require_ours(told, check.audit);
      names.push_back(told.name);
      is_told_of = is_told_of || told.name == asked.filename();
      check.files.push_back(look_at(folder / told.name, told.sha256, told.bytes));
      // What was changed says so by its bytes.
      if (check.files.back().state == AuditedState::as_written) add_contradictions(check, audit);
      if (one.contains(kFrameHashes)) add_frames(check, folder / told.name, one);
    }
    if (audit.contains(kSidecarHashes) && audit[kSidecarHashes].is_object())
      for (const auto& [ending, hash] : audit[kSidecarHashes].items()) {
        require_ours({"sidecar" + ending, hash, {}}, check.audit);
        check.files.push_back(look_at(fs::path(check.audit).replace_extension(ending), hash));
        is_told_of = is_told_of || asked.extension() == ending;
      }
  } catch (const Json::exception&) {
    throw changed_by_hand(check.audit);
  }
  if (names.empty())
    throw Error(ExitCode::bad_input, "tells of no film or picture by its hash: those of a sequence are not told of one by one", {check.audit});
  if (!is_told_of) throw Error(ExitCode::bad_input, "is nothing that " + check.audit + " tells of: it tells of " + printable(joined(names)), {path});
  return check;
}

namespace {

// What is wrong stands out of a list.
std::string loud_word_of(AuditedState state) {
  std::string word = to_string(state);
  if (state != AuditedState::as_written)
    for (char& c : word) c = char(std::toupper(c));
  return word;
}

}  // namespace

std::vector<std::string> words_of(const AuditCheck& check) {
  std::vector<std::string> lines;
  for (const AuditCheck::File& file : check.files)
    lines.push_back(loud_word_of(file.state) + "  " + printable(file.path) +
                    (file.state == AuditedState::changed ? ": its SHA-256 is " + file.sha256 + ", the audit says " + file.expected
                                                         : ", SHA-256 " + file.expected));
  if (!check.contradicted.empty())
    lines.push_back("CHANGED  " + check.audit + ": " + printable(joined(check.contradicted)) + (check.contradicted.size() == 1 ? " is" : " are") + " not what the film remembers");
  if (!check.is_remembered)
    lines.push_back("note: no film or picture among them remembers the run, so that the audit itself was held against nothing");
  return lines;
}

Json to_json(const AuditCheck& check) {
  Json json{{"audit", check.audit}, {"passes", check.passes()}, {"audited", Json::array()}, {"contradicted", check.contradicted}, {"remembered", check.is_remembered}};
  for (const AuditCheck::File& file : check.files)
    json["audited"].push_back({{"file", file.path},
                               {"state", to_string(file.state)},
                               {"sha256", file.sha256.empty() ? Json(nullptr) : Json(file.sha256)},
                               {"expected", file.expected}});
  return json;
}

}  // namespace chainreel

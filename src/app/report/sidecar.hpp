// Files that nobody named: those beside what -o names, and posters. Under such a name may lie something of the user's,
// so they replace only what this program wrote.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/frame_rate.hpp"
#include "core/json.hpp"

namespace chainreel {

// In audits and what pictures by themselves remember, but not films: a record of each panel's model, and what the command line changed.
inline constexpr const char* kMechanisms = "mechanisms";
inline constexpr const char* kTables = "tables";  // likewise, of what drives it
inline constexpr const char* kSet = "set";
inline constexpr const char* kScenePath = "scene_path";  // from the audit's folder; null of a scene that is no file

inline constexpr std::uintmax_t kLargestSidecar = std::uintmax_t(64) << 20;  // bytes of a text or an audit that is read

// NAME.json says of the texts beside it which they are, by their hashes, under this key: {".txt": .., ".srt": ..}.
inline constexpr const char* kSidecarHashes = "sidecars_sha256";

// In records of tables, see commands/table_record: what made them.
inline constexpr const char* kMadeBy = "made_by";

// The files that NAME.json tells of, under this key: [{file, bytes, sha256}], of clips with clip_facts; names alone, since
// they lie beside it. Throws Error (exit 3) where it cannot be read.
inline constexpr const char* kAuditedFiles = "outputs";
Json audited_file(const std::string& path);
// Of a sequence, whose first frame the audit names, the beginnings of the hashes of all its frames, kHashDigits each, under this key.
inline constexpr const char* kFrameHashes = "frames_sha256";
inline constexpr std::size_t kHashDigits = 16;
// Of all frames from the first on; "" where not all of them lie there, as of a part.
std::string frame_hashes(const std::string& first, int frames);
// How many frames such an entry tells of; 1 of what is no sequence.
std::size_t frames_told(const Json& entry);
// How many the audit at `path` tells of the sequence that begins with `first`; 0 where it tells nothing of it.
std::size_t frames_told_at(const std::string& path, const std::string& first);
// The name of frame k, where `first` is that of frame 0, NAME_000000.png.
std::string name_of_frame(const std::string& first, std::size_t k);
// What an audit says of its files; [] where it is none.
Json audited_files_of(const Json& audit);
// What an audit says of a clip's frames: frames, fps (15 or "30000/1001"), width, height, film_seconds.
Json clip_facts(int width, int height, FrameRate fps, int frames);
// The same of the frames that a smaller clip was made of, under this key, where the audit begins with such a clip's.
inline constexpr const char* kDrawnFrames = "drawn";
// Where the audit of a file lies: FILE.json, as x.gif.json, where that is one of ours, else NAME.json.
std::string audit_path_of(const std::string& file);
// What it says; null where there is none, or it is no JSON.
Json audit_beside(const std::string& file);
// What an audit at `path` tells of besides `files`, as far as it is still there.
struct OtherFiles {
  Json entries = Json::array();         // of those that show the same as `audit` says, to be told of on
  std::vector<std::string> are_others;  // names of those that show something else
};
OtherFiles others_audited(const std::string& path, const std::vector<std::string>& files, const Json& audit);
// The audit at `path` without what it says of these files; null where it says nothing of them.
Json audit_without(const std::string& path, const std::vector<std::string>& files);
// Whether the file at `path` has other bytes than the audit beside it says.
bool is_changed_since(const std::string& path);

// Whether this program wrote the file at `path`: a .json that is an audit; a .txt or .srt that NAME.json knows (or,
// where it knows none, one as older versions wrote); a .csv and .tex by their first lines; films and pictures that
// remember a scene or a command.
bool is_own_sidecar(const std::string& path);

// Throws Error (exit 6) where there is a file at `path` that this program did not write, unless `overwrite`.
void require_own_sidecar(const std::string& path, bool overwrite);

}  // namespace chainreel

// Files that nobody named: those beside what -o names, and posters. Under such a name may lie something of the user's,
// so they replace only what this program wrote.
#pragma once

#include <string>

#include "core/json.hpp"

namespace chainreel {

// NAME.json says of the texts beside it which they are, by their hashes, under this key: {".txt": .., ".srt": ..}.
inline constexpr const char* kSidecarHashes = "sidecars_sha256";

// Whether this program wrote the file at `path`: a .json that is an audit; a .txt or .srt that NAME.json knows (or,
// where it knows none, one as older versions wrote); a .csv and .tex by their first lines; films and pictures that
// remember a scene or a command.
bool is_own_sidecar(const std::string& path);

// Throws Error (exit 6) where there is a file at `path` that this program did not write, unless `overwrite`.
void require_own_sidecar(const std::string& path, bool overwrite);

}  // namespace chainreel

// Whether films and pictures are those that the audit beside them tells of.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/names.hpp"

namespace chainreel {

enum class AuditedState { as_written, changed, missing };
std::span<const Name> names_of(AuditedState);

struct AuditCheck {
  struct File {
    std::string path;
    AuditedState state;
    std::string sha256, expected;  // "": it is missing
  };
  std::string audit;                      // its path
  std::vector<File> files;                // all that it tells of, its texts among them
  std::vector<std::string> contradicted;  // keys of the audit that say something else than a film or picture remembers
  bool is_remembered = false;  // by a film or picture among them that is as it was written
  bool passes() const;
};

// `path`: a film, a picture, or the .json itself. Throws Error (exit 3) where there is no audit, or none that tells of it.
AuditCheck check_audit(const std::string& path);

// A line a file, and one for what is contradicted.
std::vector<std::string> words_of(const AuditCheck& check);
Json to_json(const AuditCheck& check);

}  // namespace chainreel

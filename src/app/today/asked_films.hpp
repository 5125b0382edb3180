// Films, pictures and tables that `check --today` is asked about, with where the scene of each lies.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"

namespace chainreel {

// What the audit beside a film tells of it.
struct OwnAudit {
  Json json;                // null where there is none that tells of it
  bool is_changed = false;  // the film has other bytes than it says
  std::string folder;       // of the audit
  Json at = nullptr;        // of a picture: its instant, s
  std::vector<std::string> beside{};  // what is wrong with captions, words and further frames that it tells of
};

struct AskedFilm {
  std::string path;
  OwnAudit audit{};
  bool is_gone = false;     // the audit tells of it, and it is not there
  bool is_broken = false;   // empty or cut off, and no audit tells of it: it is nobody's picture, and was one
  std::string scene{};      // where no audit tells of it, the one of the name that it remembers
  Json set = nullptr;       // likewise, what --set changed, as pictures of `snapshot` remember; null: nobody knows
};

// Of folders, and of those in them, what an audit tells of, or whose scene lies about under the name that they remember.
struct AskedFilms {
  std::vector<AskedFilm> list;
  std::vector<std::string> passed_over;  // nobody knows where their scenes lie
};

// Throws Error (exit 3) where a folder cannot be read or holds nothing to ask about.
AskedFilms asked_films(const std::vector<std::string>& paths);

// The scene file that it was made from, where the audit says that it lies; of a film without an audit that of the name which it remembers, which
// lies beside the files that it needs. Throws Error (exit 3) where there is none.
std::string scene_behind(const AskedFilm& film);

// Also equations and JSON, where the record of a command lies beside them.
bool is_table(const std::string& path);

}  // namespace chainreel

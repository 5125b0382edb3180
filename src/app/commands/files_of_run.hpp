// What a run of a sweep has become in a folder: whether its files are there and are of that very run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "core/json.hpp"

namespace chainreel {

bool is_there(const std::string& path);
bool has_sidecars(const Target& target);

// What a run's files say of themselves, to tell those that are there already.
class FilesOfRun {
 public:
  // `at`: instant that pictures show, s.
  FilesOfRun(const PreparedFilm& film, double at);

  // Whether the file shows this very scene, with the same models, meshes and motions, by the same version of the program.
  bool is(const Target& target) const;

  static std::string audit_beside(const Target& target);

 private:
  bool is_told_of(const Target& target) const;
  bool has_tables(const std::string& path) const;
  bool is_same(const Json& audit) const;

  const PreparedFilm& film_;
  Runs runs_;
  std::string scene_, meshes_;
  Json style_;
  double at_;
  std::vector<std::pair<std::string, std::string>> hashes_;  // of model and motion, a panel each
};

}  // namespace chainreel

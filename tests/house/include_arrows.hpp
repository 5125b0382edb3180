// The arrows of the house, read from the `#include` lines of src: which folder may include which, and which
// folder alone may include a library of others.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace chainreel {

struct House {
  std::map<std::string, std::set<std::string>> uses;  // folder -> folders directly below it
  std::map<std::string, std::set<std::string>>
      libraries;  // start of an include -> the folders that may have it
  // Rooms with shelves whose order is fixed: room -> shelf -> shelves directly below it. A file of such a room stands
  // on one of them.
  std::map<std::string, std::map<std::string, std::set<std::string>>> shelves;
};

// The house as src/README.md draws it.
const House& house();

// `folder` itself and all below it, directly or through another, in such a table.
std::set<std::string> reachable(const std::map<std::string, std::set<std::string>>& uses, const std::string& folder);

struct IncludeReport {
  int files = 0;
  int includes = 0;
  std::vector<std::string> faults;  // "sim/audit.cpp:7: ..."
};

IncludeReport check_includes(const House& house, const std::filesystem::path& src);

}  // namespace chainreel

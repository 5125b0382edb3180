// The scenes of assets/scenes, by name.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace chainreel::test {

inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(CHAINREEL_SOURCE_FOLDER) / "assets/scenes"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace chainreel::test

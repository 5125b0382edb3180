// Public robot models (Gepetto's example-robot-data), which are no part of this project: the environment
// variable CHAINREEL_ROBOTS names their folder. Tests that need them are skipped where it is not set
// (tests/skips.txt).
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace chainreel {

inline constexpr const char* kNoRobots = "CHAINREEL_ROBOTS names no folder of public robots";

// As the variable has it; "" where it is not set. Throws std::runtime_error where it names no folder: that is
// a mistake, not an absence.
inline std::string public_robots_folder() {
  const char* folder = std::getenv("CHAINREEL_ROBOTS");
  if (folder == nullptr || *folder == '\0') return "";
  if (!std::filesystem::is_directory(folder))
    throw std::runtime_error(std::string("CHAINREEL_ROBOTS is no folder: ") + folder);
  return folder;
}

}  // namespace chainreel

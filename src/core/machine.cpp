#include "core/machine.hpp"

#include <fstream>

namespace chainreel {

std::string value_in_file(const char* path, const std::string& key, char separator) {
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find_first_not_of(" \t\"", line.find(separator) + 1);
    return at == std::string::npos ? "" : line.substr(at, line.find_last_not_of('"') + 1 - at);
  }
  return "unknown";
}

std::string processor_name() {
  return value_in_file("/proc/cpuinfo", "model name", ':');
}

std::string system_name() {
  return value_in_file("/etc/os-release", "PRETTY_NAME", '=');
}

std::string compiler_name() {
  return "g++ " __VERSION__;
}

}  // namespace chainreel

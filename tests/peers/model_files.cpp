#include "peers/model_files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "model/read_chain.hpp"
#include "support/chains.hpp"
#include "support/public_robots.hpp"

namespace chainreel::peers {

std::vector<std::string> urdf_files_below(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".urdf") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> committed_models() {
  return urdf_files_below(CHAINREEL_SOURCE_FOLDER "/models");
}

std::vector<std::string> public_robots() {
  const std::string folder = public_robots_folder();
  if (folder.empty()) return {};
  std::vector<std::string> robots = urdf_files_below(folder);
  if (robots.empty()) throw std::runtime_error("no robots below " + folder);
  return robots;
}

Chain read_frictionless(const std::string& path, bool floating_base) {
  ModelOptions options;
  options.friction = false;
  options.meshes = false;
  options.floating_base = floating_base;
  return read_chain(path, options);
}

Chain with_independent_joints(Chain chain) {
  if (!chain.has_mimic) return chain;
  for (Body& body : chain.bodies) {
    body.joint.ratio = 1;
    body.joint.offset = 0;
  }
  test::finish(chain);
  return chain;
}

}  // namespace chainreel::peers

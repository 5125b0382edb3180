// What the materials of a model look like.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/package_path.hpp"
#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {

using MaterialRgba = std::array<std::uint8_t, 4>;  // red, green, blue, opacity

// A name is explained by the robot's <material>, else by the first link that says more than the name; a
// <visual> that says something itself means that.
class Materials {
 public:
  Materials(const UrdfFile& file, const ModelOptions& options);

  // Nothing where it says nothing; a name without a colour anywhere is a problem.
  std::optional<MaterialRgba> color_of(const UrdfMaterial& material, const std::string& link,
                                       UrdfProblems& problems);

  // The material that says what `material` looks like: itself, or the one that it names; null where there is
  // none.
  const UrdfMaterial* meaning_of(const UrdfMaterial& material) const;

 private:
  void remember(const UrdfMaterial& material);
  std::optional<MaterialRgba> look_of(const UrdfMaterial& material);

  FileFinder finder_;
  std::map<std::string, std::optional<std::array<std::uint8_t, 3>>> means_;  // of textures, by name
  std::unordered_map<std::string, UrdfMaterial> known_;
  std::vector<std::string> names_;      // in the file's order
  std::set<std::string> without_file_;  // names of materials that are a texture without a file
};

}  // namespace chainreel

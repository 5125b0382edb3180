// The one colour of a material.
#pragma once

#include <assimp/scene.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace chainreel {

using ColorBytes = std::array<std::uint8_t, 4>;  // red, green, blue, opacity

ColorBytes bytes_of(const aiColor4D& color);

struct MaterialColor {
  ColorBytes color{255, 255, 255, 255};
  bool is_given = false;  // the file says it, or colours for each vertex
};

// Diffuse colours with their opacity; in place of one with a texture the texture's mean, if that can be read.
class MaterialColors {
 public:
  MaterialColors(const aiScene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  MaterialColor of(const aiMesh& mesh);

 private:
  MaterialColor color_of(const aiMaterial& material) const;

  const aiScene& scene_;
  std::string path_;  // of the mesh file
  std::map<unsigned, MaterialColor> known_;
};

// The one colour that stands for a texture.

// Red, green, blue of a PNG's or a JPEG's mean, taken in linear light, where what is transparent counts less;
// nothing where the file is missing or cannot be read. For a child process with limits.
std::optional<std::array<std::uint8_t, 3>> mean_color(const std::string& path);

// The same, in such a child.
std::optional<std::array<std::uint8_t, 3>> read_mean_color(const std::string& path);

}  // namespace chainreel

// The colours of materials.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/texture.hpp"

namespace chainreel {

ColorBytes bytes_of(const aiColor4D& color);

struct MaterialColor {
  ColorBytes color{255, 255, 255, 255};
  bool is_given = false;  // the file says it, or colours for each vertex
};

// Diffuse colours with their opacity; in place of one with a texture its image, if that can be read, or of a mesh without
// coordinates on it the image's mean. What is transparent of an image shows the diffuse colour.
class MaterialColors {
 public:
  MaterialColors(const aiScene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  MaterialColor of(const aiMesh& mesh);

  // Where the mesh's vertices lie on its texture.
  struct Coordinates {
    std::uint32_t texture = 0;  // in textures()
    const aiVector3D* uv = nullptr;  // of each vertex
  };
  std::optional<Coordinates> coordinates(const aiMesh& mesh);

  // The images so far that meshes have coordinates on.
  const std::vector<Texture>& textures() const { return textures_; }

 private:
  struct Material {
    MaterialColor color;                     // without its texture
    std::optional<std::uint32_t> texture;    // in textures_
    unsigned channel = 0;                    // of coordinates on it
    std::optional<std::array<std::uint8_t, 3>> mean;  // of the image
  };
  const Material* material_of(const aiMesh& mesh);
  Material read(const aiMaterial& material);

  const aiScene& scene_;
  std::string path_;  // of the mesh file
  std::map<unsigned, Material> known_;
  std::vector<Texture> textures_;
};

}  // namespace chainreel

#include "mesh/material_color.hpp"

#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "mesh/image_color.hpp"
#include "mesh/mesh_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

std::uint8_t byte_of(float value) {
  if (!(value > 0)) return 0;  // also for what is no number
  return value >= 1 ? 255 : std::uint8_t(std::lround(255 * value));
}

// Where a texture lies: counted from the mesh, or beside it.
std::string texture_path(const std::string& mesh, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path folder = fs::path(mesh).parent_path();
  const fs::path path = folder / name;  // `name` alone where it is absolute
  std::error_code code;
  return fs::exists(path, code) ? path.string() : (folder / fs::path(name).filename()).string();
}

}  // namespace

ColorBytes bytes_of(const aiColor4D& color) {
  return {byte_of(color.r), byte_of(color.g), byte_of(color.b), byte_of(color.a)};
}

MaterialColor MaterialColors::of(const aiMesh& mesh) {
  if (mesh.HasVertexColors(0)) return {{255, 255, 255, 255}, true};
  if (is_stl(path_) || mesh.mMaterialIndex >= scene_.mNumMaterials) return {};
  const auto [known, is_new] = known_.emplace(mesh.mMaterialIndex, MaterialColor{});
  if (is_new) known->second = color_of(*scene_.mMaterials[mesh.mMaterialIndex]);
  return known->second;
}

MaterialColor MaterialColors::color_of(const aiMaterial& material) const {
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name == aiString(AI_DEFAULT_MATERIAL_NAME))
    return {};  // assimp's own, where a file has none
  aiColor4D diffuse(1, 1, 1, 1);
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != AI_SUCCESS) return {};
  float opacity = 1;
  material.Get(AI_MATKEY_OPACITY, opacity);
  // Nobody makes a mesh that cannot be seen: such files mean transparency.
  diffuse.a = opacity > 0 ? opacity : 1;
  MaterialColor result{bytes_of(diffuse), true};
  aiString texture;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == AI_SUCCESS)
    if (const auto mean = mean_color(texture_path(path_, texture.C_Str())))
      std::copy(mean->begin(), mean->end(), result.color.begin());
  return result;
}

}  // namespace chainreel

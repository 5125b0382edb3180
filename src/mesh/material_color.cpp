#include "mesh/material_color.hpp"

#include <assimp/material.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "mesh/mesh_file.hpp"
#include "mesh/painted_mesh.hpp"

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

TextureWrap wrap_of(aiTextureMapMode mode) {
  switch (mode) {
    case aiTextureMapMode_Mirror: return TextureWrap::mirror;
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal: return TextureWrap::clamp;
    default: return TextureWrap::repeat;
  }
}

}  // namespace

ColorBytes bytes_of(const aiColor4D& color) {
  return {byte_of(color.r), byte_of(color.g), byte_of(color.b), byte_of(color.a)};
}

const MaterialColors::Material* MaterialColors::material_of(const aiMesh& mesh) {
  if (is_stl(path_) || mesh.mMaterialIndex >= scene_.mNumMaterials) return nullptr;
  const auto [known, is_new] = known_.emplace(mesh.mMaterialIndex, Material{});
  if (is_new) known->second = read(*scene_.mMaterials[mesh.mMaterialIndex]);
  return &known->second;
}

MaterialColor MaterialColors::of(const aiMesh& mesh) {
  if (mesh.HasVertexColors(0)) return {{255, 255, 255, 255}, true};
  const Material* material = material_of(mesh);
  if (material == nullptr) return {};
  MaterialColor result = material->color;
  if (coordinates(mesh))
    std::fill_n(result.color.begin(), 3, std::uint8_t(255));
  else if (material->mean)
    std::copy(material->mean->begin(), material->mean->end(), result.color.begin());
  return result;
}

std::optional<MaterialColors::Coordinates> MaterialColors::coordinates(const aiMesh& mesh) {
  const Material* material = material_of(mesh);
  if (material == nullptr || !material->texture || !mesh.HasTextureCoords(material->channel)) return std::nullopt;
  const aiVector3D* uv = mesh.mTextureCoords[material->channel];
  const auto is_sound = [](float x) { return std::abs(x) <= kMostRepeats; };
  if (!std::all_of(uv, uv + mesh.mNumVertices, [&](const aiVector3D& at) { return is_sound(at.x) && is_sound(at.y); })) return std::nullopt;
  return Coordinates{*material->texture, uv};
}

MaterialColors::Material MaterialColors::read(const aiMaterial& material) {
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name == aiString(AI_DEFAULT_MATERIAL_NAME))
    return {};  // assimp's own, where a file has none
  aiColor4D diffuse(1, 1, 1, 1);
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != AI_SUCCESS) return {};
  float opacity = 1;
  material.Get(AI_MATKEY_OPACITY, opacity);
  // Nobody makes a mesh that cannot be seen: such files mean transparency.
  diffuse.a = opacity > 0 ? opacity : 1;
  Material result{{bytes_of(diffuse), true}, {}, 0, {}};
  aiString path;
  aiTextureMapMode wrap[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &path, nullptr, &result.channel, nullptr, nullptr, wrap) != AI_SUCCESS) return result;
  std::optional<Texture> texture = read_texture(texture_path(path_, path.C_Str()));
  if (!texture) return result;
  result.mean = mean_color(*texture);
  texture->put_over(result.color.color);
  for (std::size_t axis = 0; axis < 2; ++axis) texture->wrap[axis] = wrap_of(wrap[axis]);
  result.texture = std::uint32_t(textures_.size());
  textures_.push_back(std::move(*texture));
  return result;
}

}  // namespace chainreel

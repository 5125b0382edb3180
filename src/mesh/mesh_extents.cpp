#include "mesh/mesh_extents.hpp"

#include <assimp/config.h>

#include <cstring>

#include "core/error.hpp"
#include "mesh/mesh_file.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kCorner = 3 * sizeof(double);

// All vertices, placed by their nodes.
Box extents_of(const aiScene& scene) {
  Box box;
  for (const auto& [mesh, X] : placed_meshes(scene)) {
    for (unsigned v = 0; v < mesh->mNumVertices; ++v) {
      const aiVector3D p = X * mesh->mVertices[v];
      box.add({double(p.x), double(p.y), double(p.z)});
    }
  }
  return box;
}

MeshReply import_extents(const std::string& path) {
  Assimp::Importer importer;
  prepare(importer, path);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    return {MeshReply::wrong, std::string("is no mesh that can be read: ") + importer.GetErrorString()};
  const Box box = extents_of(*scene);
  if (box.is_empty()) return {MeshReply::wrong, "holds no triangle"};
  if (!box.lower.allFinite() || !box.upper.allFinite())
    return {MeshReply::wrong, "has vertices that are not finite"};
  MeshReply reply;
  reply.content.append(reinterpret_cast<const char*>(box.lower.data()), kCorner);
  reply.content.append(reinterpret_cast<const char*>(box.upper.data()), kCorner);
  return reply;
}

}  // namespace

Box mesh_extents(const std::string& path) {
  const std::string reply = read_mesh_file(path, [&] { return import_extents(path); });
  if (reply.size() != 2 * kCorner) throw Error(ExitCode::bad_input, "cannot be read as a mesh", {path});
  Box box;
  std::memcpy(box.lower.data(), reply.data(), kCorner);
  std::memcpy(box.upper.data(), reply.data() + kCorner, kCorner);
  return box;
}

}  // namespace chainreel

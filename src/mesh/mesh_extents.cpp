#include "mesh/mesh_extents.hpp"

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "mesh/limited_child.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// What the child sends back: six numbers, or a sentence about what is wrong.
constexpr char kExtents = 'E';
constexpr char kWrong = 'W';

std::string lower_case_ending(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return ending;
}

// Of the 48 readers only three are needed, and every other one is a way in for a hostile file.
void keep_three_readers(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string endings = importer.GetImporterInfo(i)->mFileExtensions;
    const bool is_wanted = endings == "stl" || endings == "obj" || endings.starts_with("dae");
    if (!is_wanted) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

// All vertices, placed by their nodes. A stack of nodes, since files may nest them deeply.
Box extents_of(const aiScene& scene) {
  Box box;
  std::vector<std::pair<const aiNode*, aiMatrix4x4>> open{{scene.mRootNode, aiMatrix4x4()}};
  while (!open.empty()) {
    const auto [node, X_parent] = open.back();
    open.pop_back();
    const aiMatrix4x4 X = X_parent * node->mTransformation;
    for (unsigned m = 0; m < node->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene.mMeshes[node->mMeshes[m]];
      for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const aiVector3D p = X * mesh.mVertices[v];
        box.add({double(p.x), double(p.y), double(p.z)});
      }
    }
    for (unsigned c = 0; c < node->mNumChildren; ++c) open.push_back({node->mChildren[c], X});
  }
  return box;
}

std::string import(const std::string& path) {
  Assimp::Importer importer;
  keep_three_readers(importer);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    return kWrong + std::string("is no mesh that can be read: ") + importer.GetErrorString();
  const Box box = extents_of(*scene);
  if (box.is_empty()) return kWrong + std::string("holds no triangle");
  if (!box.lower.allFinite() || !box.upper.allFinite())
    return kWrong + std::string("has vertices that are not finite");
  std::string reply(1, kExtents);
  reply.append(reinterpret_cast<const char*>(box.lower.data()), 3 * sizeof(double));
  reply.append(reinterpret_cast<const char*>(box.upper.data()), 3 * sizeof(double));
  return reply;
}

void check_file(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) throw Error(ExitCode::bad_input, "no such file", {path});
  if (!fs::is_regular_file(status)) throw Error(ExitCode::bad_input, "is not a mesh file", {path});
  const std::string ending = lower_case_ending(path);
  if (ending != ".stl" && ending != ".obj" && ending != ".dae")
    throw Error(ExitCode::bad_input, "has no ending of a mesh that is read: convert it to STL, OBJ or DAE",
                {path});
  if (fs::file_size(path, code) > kLargestMeshFile) {
    throw Error(
        ExitCode::limit,
        "is larger than " + std::to_string(kLargestMeshFile >> 20) + " MiB: reduce the number of triangles",
        {path});
  }
}

}  // namespace

Box mesh_extents(const std::string& path) {
  check_file(path);
  const ChildResult result = run_in_limited_child([&] { return import(path); });
  if (!result.finished)
    throw Error(ExitCode::bad_input, "cannot be read as a mesh: its reader " + result.trouble, {path});
  Box box;
  if (result.reply.size() == 1 + 6 * sizeof(double) && result.reply[0] == kExtents) {
    std::memcpy(box.lower.data(), result.reply.data() + 1, 3 * sizeof(double));
    std::memcpy(box.upper.data(), result.reply.data() + 1 + 3 * sizeof(double), 3 * sizeof(double));
    return box;
  }
  throw Error(ExitCode::bad_input, result.reply.empty() ? "cannot be read as a mesh" : result.reply.substr(1),
              {path});
}

}  // namespace chainreel

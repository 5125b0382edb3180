#include "mesh/mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "mesh/mesh_extents.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// A mesh may name further files; opening a pipe or a terminal, as assimp does also to see whether it is
// there, would wait for ever. Links count as what they lead to.
class PlainFilesBeside : public Assimp::DefaultIOSystem {
 public:
  explicit PlainFilesBeside(const std::string& mesh) : mesh_(mesh) {
    std::error_code code;
    folders_ = {fs::canonical(mesh, code).parent_path(), fs::weakly_canonical(fs::absolute(mesh, code).parent_path(), code)};
  }
  bool Exists(const char* path) const override {
    std::error_code code;
    return fs::is_regular_file(path, code) && (path == mesh_ || lies_beside(fs::canonical(path, code)));
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    return Exists(path) ? DefaultIOSystem::Open(path, mode) : nullptr;
  }

 private:
  bool lies_beside(const fs::path& path) const {
    return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
      return !folder.empty() && std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
    });
  }

  std::string mesh_;
  std::array<fs::path, 2> folders_;  // of the file itself, and of the link to it
};

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
  note_input(path);
}

}  // namespace

bool is_collada(const std::string& path) {
  return lower_case_ending(path) == ".dae";
}

bool is_stl(const std::string& path) {
  return lower_case_ending(path) == ".stl";
}

std::string read_mesh_file(const std::string& path, const std::function<MeshReply()>& work,
                           const ChildLimits& limits) {
  check_file(path);
  ChildResult result = run_in_limited_child(
      [&] {
        MeshReply reply = work();
        reply.content.insert(reply.content.begin(), reply.kind);
        return std::move(reply.content);
      },
      limits);
  if (!result.finished)
    throw Error(ExitCode::bad_input, "cannot be read as a mesh: its reader " + result.trouble, {path});
  const char kind = result.reply.empty() ? char(MeshReply::wrong) : result.reply[0];
  if (kind == MeshReply::good) return result.reply.erase(0, 1);
  throw Error(kind == MeshReply::too_much ? ExitCode::limit : ExitCode::bad_input,
              result.reply.size() < 2 ? "cannot be read as a mesh" : result.reply.substr(1), {path});
}

void prepare(Assimp::Importer& importer, const std::string& path) {
  // Only three of the 48 readers are needed, and every other one is a way in for a hostile file.
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string endings = importer.GetImporterInfo(i)->mFileExtensions;
    const bool is_wanted = endings == "stl" || endings == "obj" || endings.starts_with("dae");
    if (!is_wanted) importer.UnregisterLoader(importer.GetImporter(i));
  }
  importer.SetIOHandler(new PlainFilesBeside(path));  // the importer's own from now on
}

// A stack of nodes, since files may nest them deeply.
std::vector<PlacedMesh> placed_meshes(const aiScene& scene) {
  std::vector<PlacedMesh> placed;
  std::vector<std::pair<const aiNode*, aiMatrix4x4>> open{{scene.mRootNode, aiMatrix4x4()}};
  while (!open.empty()) {
    const auto [node, X_parent] = open.back();
    open.pop_back();
    const aiMatrix4x4 X = X_parent * node->mTransformation;
    for (unsigned m = 0; m < node->mNumMeshes; ++m) placed.push_back({scene.mMeshes[node->mMeshes[m]], X});
    for (unsigned c = node->mNumChildren; c-- > 0;) open.push_back({node->mChildren[c], X});
  }
  return placed;
}

}  // namespace chainreel

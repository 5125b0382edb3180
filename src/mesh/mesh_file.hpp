// What all readers of mesh files share: which files are taken, assimp held to three formats and to plain
// files, and the child process that it works in.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <functional>
#include <string>
#include <vector>

#include "mesh/limited_child.hpp"

namespace chainreel {

// What the child sends back: a good reply, or a sentence about what is wrong.
struct MeshReply {
  enum Kind : char { good = 'G', wrong = 'W', too_much = 'L' };
  Kind kind = good;
  std::string content;
};

// Checks the file and does `work` on it in a limited child. Gives the content of a good reply. Throws Error
// that names the file: exit 3 where it is missing, of another kind or broken, exit 7 where it is too large.
std::string read_mesh_file(const std::string& path, const std::function<MeshReply()>& work,
                           const ChildLimits& limits = {});

bool is_collada(const std::string& path);
bool is_stl(const std::string& path);

// For the child. ------------------------------------------------------------------------------------------

// Only STL, OBJ and DAE, and of the files that the mesh at `path` names only those beside it and below: no device, no
// pipe, nothing of which its reader's complaints would tell.
void prepare(Assimp::Importer& importer, const std::string& path);

struct PlacedMesh {
  const aiMesh* mesh = nullptr;
  aiMatrix4x4 X;  // from the mesh to the file
};

// Each mesh as often as nodes show it.
std::vector<PlacedMesh> placed_meshes(const aiScene& scene);

}  // namespace chainreel

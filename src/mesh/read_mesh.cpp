#include "mesh/read_mesh.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <cmath>
#include <cstring>

#include "core/error.hpp"
#include "mesh/collect_triangles.hpp"
#include "mesh/mesh_file.hpp"

namespace chainreel {
namespace {

using Vertex = TriangleMesh::Vertex;

const char* const kTooMany = "has more than 4 million triangles: reduce their number";

// What stands before the vertices and the indices in the child's reply.
struct ReplyHead {
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  std::uint32_t has_colors = 0;
};

std::size_t reply_size(const ReplyHead& head) {
  return sizeof(ReplyHead) + sizeof(Vertex) * std::size_t(head.vertices) +
         3 * sizeof(std::uint32_t) * std::size_t(head.triangles);
}

std::string reply_of(const TriangleMesh& mesh) {
  const ReplyHead head{std::uint32_t(mesh.vertices.size()), std::uint32_t(mesh.triangles.size() / 3),
                       mesh.has_colors ? 1U : 0U};
  std::string reply;
  reply.reserve(reply_size(head) + 1);  // with the kind of the reply
  reply.append(reinterpret_cast<const char*>(&head), sizeof(head));
  reply.append(reinterpret_cast<const char*>(mesh.vertices.data()), sizeof(Vertex) * mesh.vertices.size());
  reply.append(reinterpret_cast<const char*>(mesh.triangles.data()),
               sizeof(std::uint32_t) * mesh.triangles.size());
  return reply;
}

// The steps of assimp trust indices.
bool has_good_indices(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned i = 0; i < mesh.mFaces[f].mNumIndices; ++i)
        if (mesh.mFaces[f].mIndices[i] >= mesh.mNumVertices) return false;
  }
  return true;
}

bool has_too_many_faces(const std::vector<PlacedMesh>& placed) {
  std::size_t faces = 0;
  for (const PlacedMesh& mesh : placed) faces += mesh.mesh->mNumFaces;
  return faces > kMostTriangles;
}

bool is_finite(const Vertex& vertex) {
  for (const float x : vertex.position)
    if (!std::isfinite(x)) return false;
  for (const float x : vertex.normal)
    if (!std::isfinite(x)) return false;
  return true;
}

bool all_finite(const TriangleMesh& mesh) {
  for (const Vertex& vertex : mesh.vertices)
    if (!is_finite(vertex)) return false;
  return true;
}

// assimp turns a Collada file so that its up becomes y; this goes on to z.
void turn_y_to_z(std::vector<PlacedMesh>& placed) {
  const aiMatrix4x4 y_to_z(1, 0, 0, 0,   //
                           0, 0, -1, 0,  //
                           0, 1, 0, 0,   //
                           0, 0, 0, 1);
  for (PlacedMesh& mesh : placed) mesh.X = y_to_z * mesh.X;
}

MeshReply import_triangles(const std::string& path, MeshUp up) {
  Assimp::Importer importer;
  prepare(importer, path);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up == MeshUp::rviz);
  // The normals of an STL belong to faces and are often zero or stale.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS);
  const unsigned steps = aiProcess_Triangulate | (is_stl(path) ? unsigned(aiProcess_RemoveComponent) : 0U);

  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    return {MeshReply::wrong, std::string("is no mesh that can be read: ") + importer.GetErrorString()};
  if (!has_good_indices(*scene)) return {MeshReply::wrong, "names vertices that it does not have"};
  if (has_too_many_faces(placed_meshes(*scene))) return {MeshReply::too_much, kTooMany};
  scene = importer.ApplyPostProcessing(steps);
  if (scene == nullptr)
    return {MeshReply::wrong, std::string("is no mesh that can be read: ") + importer.GetErrorString()};

  std::vector<PlacedMesh> placed = placed_meshes(*scene);
  if (has_too_many_faces(placed)) return {MeshReply::too_much, kTooMany};
  if (up == MeshUp::file && is_collada(path)) turn_y_to_z(placed);
  MaterialColors colors(*scene, path);
  const TriangleMesh mesh = collect_triangles(placed, colors);
  if (mesh.triangles.empty()) return {MeshReply::wrong, "holds no triangle"};
  if (!all_finite(mesh)) return {MeshReply::wrong, "has vertices that are not finite"};
  return {MeshReply::good, reply_of(mesh)};
}

// Whatever the child's memory looked like: nothing but a sound mesh passes.
bool is_sound(const TriangleMesh& mesh) {
  for (const std::uint32_t index : mesh.triangles)
    if (index >= mesh.vertices.size()) return false;
  for (const Vertex& vertex : mesh.vertices) {
    const auto& n = vertex.normal;
    // Single precision keeps unit length to 1e-7.
    if (!is_finite(vertex) || !(std::fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-5F)) return false;
  }
  return true;
}

bool parse_reply(const std::string& reply, TriangleMesh& mesh) {
  ReplyHead head;
  if (reply.size() < sizeof(head)) return false;
  std::memcpy(&head, reply.data(), sizeof(head));
  if (head.triangles > kMostTriangles || head.vertices > 3 * kMostTriangles || head.has_colors > 1)
    return false;
  if (reply.size() != reply_size(head)) return false;
  mesh.has_colors = head.has_colors == 1;
  mesh.vertices.resize(head.vertices);
  mesh.triangles.resize(3 * std::size_t(head.triangles));
  const char* at = reply.data() + sizeof(head);
  std::memcpy(mesh.vertices.data(), at, sizeof(Vertex) * mesh.vertices.size());
  at += sizeof(Vertex) * mesh.vertices.size();
  std::memcpy(mesh.triangles.data(), at, sizeof(std::uint32_t) * mesh.triangles.size());
  return is_sound(mesh);
}

}  // namespace

std::span<const Name> names_of(MeshUp) {
  static constexpr Name names[] = {{"rviz", "nobody's: as their numbers stand"}, {"file", "Collada's own up becomes z"}};
  return names;
}

TriangleMesh read_mesh(const std::string& path, MeshUp up) {
  ChildLimits limits;
  limits.reply = 1 + reply_size({3 * kMostTriangles, kMostTriangles, 0});
  const std::string reply = read_mesh_file(
      path, [&] { return import_triangles(path, up); }, limits);
  TriangleMesh mesh;
  if (!parse_reply(reply, mesh))
    throw Error(ExitCode::bad_input, "cannot be read as a mesh: its reader sent no sound mesh back", {path});
  return mesh;
}

}  // namespace chainreel

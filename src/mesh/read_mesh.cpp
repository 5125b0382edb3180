#include "mesh/read_mesh.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/equal_items.hpp"
#include "core/error.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/painted_mesh.hpp"
#include "mesh/smooth_normals.hpp"

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

namespace {

using Vertex = TriangleMesh::Vertex;
static_assert(sizeof(Vertex) == 28, "vertices are compared and sent as bytes, so they must have no gaps");

Eigen::Vector3d vector_of(const aiVector3D& v) {
  return {double(v.x), double(v.y), double(v.z)};
}

Point3f floats_of(const Eigen::Vector3d& v) {
  // Adding zero makes a zero of -0, so that both are one vertex.
  return {float(v[0]) + 0.0F, float(v[1]) + 0.0F, float(v[2]) + 0.0F};
}

// Positions by X, normals by its inverse transpose, and what a mirror does to the order of corners.
class Placement {
 public:
  explicit Placement(const aiMatrix4x4& X) : X_(X) {
    Eigen::Matrix3d A;
    A << double(X.a1), double(X.a2), double(X.a3), double(X.b1), double(X.b2), double(X.b3), double(X.c1),
        double(X.c2), double(X.c3);
    mirrors_ = A.determinant() < 0;
    // The cofactors are the inverse transpose times the determinant; they also serve a mesh pressed flat.
    N_.col(0) = A.col(1).cross(A.col(2));
    N_.col(1) = A.col(2).cross(A.col(0));
    N_.col(2) = A.col(0).cross(A.col(1));
    if (mirrors_) N_ = -N_;
  }

  Point3f position(const aiVector3D& p) const { return floats_of(vector_of(X_ * p)); }

  // Unit, or zero where the file's is no direction.
  Eigen::Vector3d normal(const aiVector3D& n) const {
    const Eigen::Vector3d placed = N_ * vector_of(n).normalized();
    const double length = placed.norm();
    return std::isfinite(length) && length > 0 ? Eigen::Vector3d(placed / length) : Eigen::Vector3d(0, 0, 0);
  }

  unsigned corner(unsigned c) const { return mirrors_ ? 2 - c : c; }

 private:
  aiMatrix4x4 X_;
  Eigen::Matrix3d N_;
  bool mirrors_ = false;
};

// The corners of one placed mesh, three a triangle.
struct Corners {
  std::vector<unsigned> indices;  // of the mesh's vertices
  std::vector<Point3f> positions;
};

Corners corners_of(const aiMesh& mesh, const Placement& placement) {
  Corners corners;
  corners.indices.reserve(3 * std::size_t(mesh.mNumFaces));
  corners.positions.reserve(3 * std::size_t(mesh.mNumFaces));
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;  // a line or a point
    for (unsigned c = 0; c < 3; ++c) {
      corners.indices.push_back(face.mIndices[placement.corner(c)]);
      corners.positions.push_back(placement.position(mesh.mVertices[corners.indices.back()]));
    }
    const std::size_t first = corners.positions.size() - 3;
    const Point3f* p = &corners.positions[first];
    if (face_normal(p[0], p[1], p[2]).isZero(0)) {
      corners.indices.resize(first);
      corners.positions.resize(first);
    }
  }
  return corners;
}

// Many exporters write one normal a face, which says nothing about the surface that is meant. Normals against
// the order of the corners do: there the order is wrong.
bool are_of_faces(const std::vector<Eigen::Vector3f>& normals, const Corners& corners) {
  constexpr float kSame = 0.9999F;  // cosine of 0.8 degrees: files have some four digits
  for (std::size_t c = 0; c < normals.size(); c += 3) {
    const Point3f* p = &corners.positions[c];
    if (normals[c].isZero(0) && normals[c + 1].isZero(0) && normals[c + 2].isZero(0)) continue;
    if (normals[c].dot(normals[c + 1]) < kSame || normals[c].dot(normals[c + 2]) < kSame) return false;
    if (normals[c].dot(face_normal(p[0], p[1], p[2]).cast<float>()) < -0.5F) return false;
  }
  return true;
}

std::vector<Eigen::Vector3f> normals_of(const aiMesh& mesh, const Placement& placement,
                                        const Corners& corners) {
  if (!mesh.HasNormals()) return smooth_normals(corners.positions);
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(corners.indices.size());
  for (const unsigned index : corners.indices)
    normals.push_back(placement.normal(mesh.mNormals[index]).cast<float>());
  if (are_of_faces(normals, corners)) return smooth_normals(corners.positions);
  for (std::size_t c = 0; c < normals.size(); ++c) {
    if (!normals[c].isZero(0)) continue;
    const Point3f* p = &corners.positions[c - c % 3];
    normals[c] = face_normal(p[0], p[1], p[2]).cast<float>();
  }
  return normals;
}

}  // namespace

namespace {

// Vertices that are equal to the last bit are one; `item_of` makes one of a vertex and its index in its mesh.
template <class Item, class ItemOf>
std::vector<Item> collect(const std::vector<PlacedMesh>& placed, MaterialColors& colors, TriangleMesh& result, const ItemOf& item_of) {
  std::size_t given = 0;
  for (const PlacedMesh& mesh : placed) given += mesh.mesh->mNumVertices;
  EqualItems<Item> items(given / 2);  // files that give each triangle its own have six times too many
  for (const auto& [mesh, X] : placed) {
    const Placement placement(X);
    const Corners corners = corners_of(*mesh, placement);
    const std::vector<Eigen::Vector3f> normals = normals_of(*mesh, placement, corners);
    const MaterialColor material = colors.of(*mesh);
    const auto coordinates = colors.coordinates(*mesh);
    result.has_colors |= material.is_given && !corners.indices.empty();
    for (std::size_t c = 0; c < corners.indices.size(); ++c) {
      Vertex vertex;
      vertex.position = corners.positions[c];
      vertex.normal = floats_of(normals[c].cast<double>());
      vertex.color =
          mesh->HasVertexColors(0) ? bytes_of(mesh->mColors[0][corners.indices[c]]) : material.color;
      result.triangles.push_back(items.index_of(item_of(vertex, coordinates, corners.indices[c])));
    }
  }
  return std::move(items.items);
}

}  // namespace

TriangleMesh collect_triangles(const std::vector<PlacedMesh>& placed, MaterialColors& colors) {
  using Coordinates = std::optional<MaterialColors::Coordinates>;
  TriangleMesh result;
  if (std::none_of(placed.begin(), placed.end(), [&](const PlacedMesh& one) { return colors.coordinates(*one.mesh); })) {
    result.vertices = collect<Vertex>(placed, colors, result, [](const Vertex& vertex, const Coordinates&, unsigned) { return vertex; });
    return result;
  }
  PaintedMesh mesh;
  mesh.vertices = collect<PaintedVertex>(placed, colors, result, [](const Vertex& vertex, const Coordinates& on, unsigned index) {
    return on ? PaintedVertex{vertex, on->uv[index].x + 0.0F, on->uv[index].y + 0.0F, on->texture} : PaintedVertex{vertex};
  });
  mesh.triangles = std::move(result.triangles);
  mesh.textures = colors.textures();
  const bool has_colors = result.has_colors;
  result = painted(std::move(mesh));
  result.has_colors = has_colors;
  return result;
}

}  // namespace chainreel

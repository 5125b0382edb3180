#include "mesh/collect_triangles.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace chainreel {
namespace {

using Vertex = TriangleMesh::Vertex;
static_assert(sizeof(Vertex) == 28, "vertices are compared and sent as bytes, so they must have no gaps");

Eigen::Vector3d vector_of(const aiVector3D& v) {
  return {double(v.x), double(v.y), double(v.z)};
}

std::array<float, 3> floats_of(const Eigen::Vector3d& v) {
  // Adding zero makes a zero of -0, so that both are one vertex.
  return {float(v[0]) + 0.0F, float(v[1]) + 0.0F, float(v[2]) + 0.0F};
}

Eigen::Vector3d position_of(const Vertex& vertex) {
  return {double(vertex.position[0]), double(vertex.position[1]), double(vertex.position[2])};
}

// Vertices by their bytes: an open table of indices, half empty.
class VertexTable {
 public:
  explicit VertexTable(std::vector<Vertex>& vertices) : vertices_(vertices), table_(1024, kFree) {}

  std::uint32_t index_of(const Vertex& vertex) {
    if (2 * vertices_.size() >= table_.size()) grow();
    std::uint32_t& slot = slot_of(vertex);
    if (slot == kFree) {
      slot = std::uint32_t(vertices_.size());
      vertices_.push_back(vertex);
    }
    return slot;
  }

 private:
  static constexpr std::uint32_t kFree = ~std::uint32_t(0);

  static std::size_t hash_of(const Vertex& vertex) {
    std::array<std::uint32_t, 7> words;
    std::memcpy(words.data(), &vertex, sizeof(vertex));
    std::uint64_t hash = 0;
    for (const std::uint32_t word : words) hash = std::rotl((hash ^ word) * 0x9E3779B97F4A7C15U, 29);
    return std::size_t(hash);
  }

  std::uint32_t& slot_of(const Vertex& vertex) {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = hash_of(vertex) & mask;
    while (table_[at] != kFree && std::memcmp(&vertices_[table_[at]], &vertex, sizeof(vertex)) != 0)
      at = (at + 1) & mask;
    return table_[at];
  }

  void grow() {
    table_.assign(2 * table_.size(), kFree);
    for (std::size_t i = 0; i < vertices_.size(); ++i) slot_of(vertices_[i]) = std::uint32_t(i);
  }

  std::vector<Vertex>& vertices_;
  std::vector<std::uint32_t> table_;
};

// Positions by X, normals by its inverse transpose, and what a mirror does to the order of corners.
struct Placement {
  explicit Placement(const aiMatrix4x4& X) : X_(X) {
    Eigen::Matrix3d A;
    A << double(X.a1), double(X.a2), double(X.a3), double(X.b1), double(X.b2), double(X.b3), double(X.c1),
        double(X.c2), double(X.c3);
    const double determinant = A.determinant();
    mirrors = determinant < 0;
    // The cofactors are the inverse transpose times the determinant; they also serve a mesh pressed flat.
    N_.col(0) = A.col(1).cross(A.col(2));
    N_.col(1) = A.col(2).cross(A.col(0));
    N_.col(2) = A.col(0).cross(A.col(1));
    if (mirrors) N_ = -N_;
  }

  Eigen::Vector3d position(const aiVector3D& p) const { return vector_of(X_ * p); }
  Eigen::Vector3d normal(const aiVector3D& n) const { return N_ * vector_of(n); }

  bool mirrors = false;

 private:
  aiMatrix4x4 X_;
  Eigen::Matrix3d N_;
};

class Collector {
 public:
  explicit Collector(MaterialColors& colors) : colors_(colors), table_(mesh_.vertices) {}

  void add(const PlacedMesh& placed) {
    const aiMesh& from = *placed.mesh;
    const Placement placement(placed.X);
    const MaterialColor material = colors_.of(from);
    mesh_.has_colors |= material.is_given;
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
      if (from.mFaces[f].mNumIndices != 3) continue;  // a line or a point
      std::array<Vertex, 3> corners;
      for (unsigned c = 0; c < 3; ++c) {
        const unsigned index = from.mFaces[f].mIndices[placement.mirrors ? 2 - c : c];
        corners[c].position = floats_of(placement.position(from.mVertices[index]));
        corners[c].color = from.HasVertexColors(0) ? bytes_of(from.mColors[0][index]) : material.color;
      }
      const Eigen::Vector3d face = face_normal(corners);
      if (face.isZero(0)) continue;
      for (unsigned c = 0; c < 3; ++c) {
        const unsigned index = from.mFaces[f].mIndices[placement.mirrors ? 2 - c : c];
        Eigen::Vector3d normal = from.HasNormals() ? placement.normal(from.mNormals[index]) : face;
        // Some files have normals of length zero.
        if (!normal.allFinite() || !(normal.norm() > 1e-12)) normal = face;
        corners[c].normal = floats_of(normal.normalized());
        mesh_.triangles.push_back(table_.index_of(corners[c]));
      }
    }
  }

  TriangleMesh take() {
    if (!mesh_.has_colors)
      for (Vertex& vertex : mesh_.vertices) vertex.color = {255, 255, 255, 255};
    return std::move(mesh_);
  }

 private:
  // Unit, or zero where the triangle has no area.
  static Eigen::Vector3d face_normal(const std::array<Vertex, 3>& corners) {
    const Eigen::Vector3d a = position_of(corners[0]);
    const Eigen::Vector3d n = (position_of(corners[1]) - a).cross(position_of(corners[2]) - a);
    return n.isZero(0) ? n : Eigen::Vector3d(n.normalized());
  }

  MaterialColors& colors_;
  TriangleMesh mesh_;
  VertexTable table_;
};

}  // namespace

TriangleMesh collect_triangles(const std::vector<PlacedMesh>& placed, MaterialColors& colors) {
  Collector collector(colors);
  for (const PlacedMesh& mesh : placed) collector.add(mesh);
  return collector.take();
}

}  // namespace chainreel

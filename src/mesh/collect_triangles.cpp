#include "mesh/collect_triangles.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <cstdint>

#include "mesh/smooth_normals.hpp"

namespace chainreel {
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

TriangleMesh collect_triangles(const std::vector<PlacedMesh>& placed, MaterialColors& colors) {
  TriangleMesh result;
  EqualItems<Vertex> vertices;
  for (const auto& [mesh, X] : placed) {
    const Placement placement(X);
    const Corners corners = corners_of(*mesh, placement);
    const std::vector<Eigen::Vector3f> normals = normals_of(*mesh, placement, corners);
    const MaterialColor material = colors.of(*mesh);
    result.has_colors |= material.is_given && !corners.indices.empty();
    for (std::size_t c = 0; c < corners.indices.size(); ++c) {
      Vertex vertex;
      vertex.position = corners.positions[c];
      vertex.normal = floats_of(normals[c].cast<double>());
      vertex.color =
          mesh->HasVertexColors(0) ? bytes_of(mesh->mColors[0][corners.indices[c]]) : material.color;
      result.triangles.push_back(vertices.index_of(vertex));
    }
  }
  result.vertices = std::move(vertices.items);
  return result;
}

}  // namespace chainreel

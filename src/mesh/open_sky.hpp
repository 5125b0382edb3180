// How much of the sky the places of a body see past the body itself and its neighbours: ambient occlusion, reckoned once.
//
// From the nodes of a grid around a body its surroundings are looked at along some directions, as in maps of depth. What is
// seen at a node is kept as its integral over the sphere, V0 = int v dw, and V1 = int v d dw, v(d) = 1 where the sky is seen: the
// first two bands of its spherical harmonics (R. Ramamoorthi, P. Hanrahan, On the relationship between radiance and irradiance,
// 2001). A surface with normal n gets of an even sky, whose cosine-weighted whole is pi,
//
//   E(n) = V0 / 4 + n . V1 / 2,
//
// which is exact where the sky is whole (V0 = 4 pi) and where a plane hides half of it (V0 = 2 pi, V1 = pi n). Floats, in a fixed order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.hpp"

namespace chainreel {

// Rows of the 3x4 matrix of a pose.
using PoseRows = std::array<float, 12>;

struct PlacedTriangles {
  const TriangleMesh* mesh = nullptr;
  PoseRows pose{};  // of the mesh in the body
};

// Points that cover a body's surfaces, about `spacing` apart, in its frame.
struct SurfacePoints {
  std::vector<std::array<float, 3>> points, normals;  // a normal is its triangle's, counter-clockwise seen from outside
  std::array<float, 3> lower{}, upper{};  // of all its vertices
  float spacing = 0;                      // m

  explicit SurfacePoints(std::span<const PlacedTriangles> shapes);
};

class OpenSky {
 public:
  static constexpr std::size_t kPoses = 4;

  // A body's surroundings: others, each at some poses in the body's frame that stand for all its motion.
  struct Neighbor {
    const SurfacePoints* points = nullptr;
    std::array<PoseRows, kPoses> poses{};
  };

  OpenSky(const SurfacePoints& body, std::span<const Neighbor> neighbors);

  // At a place of the body's surface, in its frame, with a unit normal: 0, nothing of the sky above it, to 1, all.
  float openness(const std::array<float, 3>& place, const std::array<float, 3>& normal) const;
  // The same of a vertex of a mesh that stands so in the body, and of each of a mesh: 0 to 255.
  std::uint8_t openness_of(const TriangleMesh::Vertex& vertex, const PoseRows& pose) const;
  std::vector<std::uint8_t> openness_of(const PlacedTriangles& shape) const;
  // m; what is finer is not seen.
  float cell() const { return cell_; }

 private:
  // V1 and V0.
  using Node = std::array<float, 4>;
  // Points, their numbers apart.
  struct Points {
    std::array<std::vector<float>, 3> at;
    std::size_t size() const { return at[0].size(); }
    void add(const std::array<float, 3>& p) {
      for (std::size_t i = 0; i < 3; ++i) at[i].push_back(p[i]);
    }
  };
  // What may hide the sky at one pose of the neighbours, in the body's frame.
  struct Hiding {
    Points points;
    std::vector<int> width;  // of each, as far as it counts, texels
  };

  std::size_t index(int x, int y, int z) const { return (std::size_t(z) * std::size_t(count_[1]) + std::size_t(y)) * std::size_t(count_[0]) + std::size_t(x); }
  void mark_ahead(const SurfacePoints& body);
  Hiding hiding(const SurfacePoints& body, std::span<const Neighbor> neighbors, std::size_t pose) const;
  void look_along(const std::array<float, 3>& direction, const SurfacePoints& body, const Hiding& hiding);

  std::array<int, 3> count_{};      // of nodes
  std::array<float, 3> first_{};    // node's place
  float cell_ = 1;
  std::vector<std::int32_t> node_;  // of the grid's places, in nodes_, or -1: far from all surfaces
  std::vector<Node> nodes_;
  Points places_;  // of nodes_
  // Of the direction that is looked along: of each texel how far out what hides the sky stands, and of points their texels and depths.
  std::vector<float> map_, depth_;
  std::vector<int> texel_;
};

// A copy of a mesh, with its openness, of which long edges between places that differ are cut, so that what is between two
// vertices is not far from the mean of both.
struct RefinedMesh {
  TriangleMesh mesh;
  std::vector<std::uint8_t> openness;
  bool is_refined = false;  // otherwise `mesh` is empty: what there was will do
};
RefinedMesh refined(const PlacedTriangles& shape, const OpenSky& sky);

}  // namespace chainreel

// The sky that surfaces see: known parts of it, and meshes cut finer.
#include "mesh/open_sky.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>

#include "mesh/primitives.hpp"

namespace chainreel {
namespace {

constexpr PoseRows at(float x, float y, float z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}; }
constexpr PoseRows kHere = at(0, 0, 0);

// 48 directions tell a part of the sky to a tenth; what is finer than a cell is not seen.
constexpr float kRough = 0.1F;
// What comes back from other surfaces makes a half of the sky brighter: 0.5 / (1 - 0.4 * 0.5).
constexpr float kHalf = 0.625F;

OpenSky sky_of(const SurfacePoints& body) { return OpenSky(body, {}); }

TEST(OpenSky, IsWholeAboveWhatIsConvex) {
  for (const TriangleMesh& mesh : {box_mesh({1, 1, 1}), box_mesh({1, 0.3, 0.2}), cylinder_mesh(0.1, 1), sphere_mesh(2)}) {
    const PlacedTriangles shape{&mesh, kHere};
    const SurfacePoints points(std::span(&shape, 1));
    for (const std::uint8_t openness : sky_of(points).openness_of(shape)) EXPECT_GE(openness, 255 * (1 - kRough));
  }
}

TEST(OpenSky, AWallHidesHalfOfItAndLessFartherAway) {
  // A floor 2 m wide with a wall, as high as the floor is wide, in its middle.
  const TriangleMesh floor = box_mesh({2, 2, 0.2}), wall = box_mesh({0.2, 2, 2});
  const std::array<PlacedTriangles, 2> shapes{PlacedTriangles{&floor, at(0, 0, -0.1F)}, PlacedTriangles{&wall, at(0, 0, 1)}};
  const SurfacePoints points(shapes);
  const OpenSky sky = sky_of(points);
  const float near = sky.openness({0.2F, 0, 0}, {0, 0, 1}), far = sky.openness({0.9F, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(near, kHalf, kRough);
  EXPECT_GT(far, near + kRough);
  EXPECT_GT(sky.openness({-1, 0, -0.1F}, {-1, 0, 0}), 1 - kRough);
  // From below the floor the wall is not seen.
  EXPECT_GT(sky.openness({0, 0, -0.2F}, {0, 0, -1}), 1 - kRough);
}

TEST(OpenSky, NeighboursCountAtEachOfTheirPoses) {
  const TriangleMesh box = box_mesh({1, 1, 1}), lid = box_mesh({4, 4, 0.5});
  const PlacedTriangles body{&box, kHere}, other{&lid, kHere};
  const SurfacePoints points(std::span(&body, 1)), lids(std::span(&other, 1));
  const std::array<float, 3> top{0, 0, 0.5F}, up{0, 0, 1};
  const auto openness = [&](std::array<float, 4> heights) {
    OpenSky::Neighbor neighbor{&lids, {}};
    for (std::size_t k = 0; k < 4; ++k) neighbor.poses[k] = at(0, 0, heights[k]);
    return OpenSky(points, std::span(&neighbor, 1)).openness(top, up);
  };
  EXPECT_LT(openness({0.9F, 0.9F, 0.9F, 0.9F}), 0.25F);
  EXPECT_GT(openness({9, 9, 9, 9}), 1 - kRough);
  // Closed at half of the poses: half of the sky.
  EXPECT_NEAR(openness({0.9F, 9, 0.9F, 9}), kHalf, 1.5F * kRough);
}

TEST(OpenSky, WhatHasNoExtentOrIsVeryLargeIsNoTrouble) {
  const TriangleMesh flat = box_mesh({1, 1, 0}), point = box_mesh({0, 0, 0}), huge = box_mesh({1e38, 1e38, 1e38}), far = box_mesh({1, 1, 1});
  const TriangleMesh none;
  const PlacedTriangles shapes[] = {{&flat, kHere}, {&point, kHere}, {&huge, kHere}, {&far, at(1e30F, 0, 0)}, {&none, kHere}};
  for (const PlacedTriangles& shape : shapes) {
    const SurfacePoints points(std::span(&shape, 1));
    const OpenSky::Neighbor neighbor{&points, {kHere, at(1e30F, 1e30F, NAN), at(INFINITY, 0, 0), kHere}};
    const OpenSky sky(points, std::span(&neighbor, 1));
    EXPECT_EQ(sky.openness_of(shape).size(), shape.mesh->vertices.size());
    refined(shape, sky);
  }
}

// Every edge, told by the places of its ends, is gone through once in each direction.
bool is_closed(const TriangleMesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{mesh.vertices.at(mesh.triangles[t + k]).position, mesh.vertices.at(mesh.triangles[t + (k + 1) % 3]).position}];
  for (const auto& [edge, count] : edges)
    if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
  return true;
}

TEST(RefinedMesh, IsFinerWhereShadeBeginsAndStillClosed) {
  const TriangleMesh floor = box_mesh({2, 2, 0.2}), post = cylinder_mesh(0.3, 2);
  const std::array<PlacedTriangles, 2> shapes{PlacedTriangles{&floor, at(0, 0, -0.1F)}, PlacedTriangles{&post, at(0, 0, 1)}};
  const SurfacePoints points(shapes);
  const OpenSky sky = sky_of(points);
  for (const PlacedTriangles& shape : shapes) {
    const RefinedMesh mesh = refined(shape, sky);
    ASSERT_TRUE(mesh.is_refined);
    EXPECT_GT(mesh.mesh.triangles.size(), shape.mesh->triangles.size());
    EXPECT_TRUE(is_closed(mesh.mesh));
    EXPECT_EQ(mesh.openness.size(), mesh.mesh.vertices.size());
    EXPECT_EQ(mesh.openness, sky.openness_of({&mesh.mesh, shape.pose}));
  }
  // A box alone needs no finer ones.
  const PlacedTriangles alone{&floor, kHere};
  const SurfacePoints own(std::span(&alone, 1));
  const RefinedMesh same = refined(alone, sky_of(own));
  EXPECT_FALSE(same.is_refined);
  EXPECT_EQ(same.openness.size(), floor.vertices.size());
}

}  // namespace
}  // namespace chainreel

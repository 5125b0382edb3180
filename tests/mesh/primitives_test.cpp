#include "mesh/primitives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mesh_files.hpp"

namespace chainreel {
namespace {

constexpr double kSegments = 48;
// Vertices are in single precision, 6e-8 each; a volume has three factors.
constexpr double kSingle = 1e-6;

// Closed: every edge, told by the places of its ends, is gone through once in each direction.
void expect_closed(const TriangleMesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c)
      ++edges[{mesh.vertices.at(mesh.triangles[i + c]).position,
               mesh.vertices.at(mesh.triangles[i + (c + 1) % 3]).position}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(Primitives, ABoxHasFlatFacesAndItsVolume) {
  const TriangleMesh box = box_mesh({1, 2, 3});
  EXPECT_EQ(box.vertices.size(), 24U);
  EXPECT_EQ(box.triangles.size(), 36U);
  EXPECT_FALSE(box.has_colors);
  EXPECT_EQ(volume_of(box), 6);
  expect_closed(box);
  expect_sound_normals(box);
  EXPECT_EQ(box_of(box).lower, Eigen::Vector3d(-0.5, -1, -1.5));
  EXPECT_EQ(box_of(box).upper, Eigen::Vector3d(0.5, 1, 1.5));
  for (const auto& vertex : box.vertices) EXPECT_EQ(point_of(vertex.normal).cwiseAbs().maxCoeff(), 1);
}

TEST(Primitives, ACylinderIsThePrismOverItsPolygon) {
  const double r = 0.3, length = 2;
  const TriangleMesh cylinder = cylinder_mesh(r, length);
  expect_closed(cylinder);
  expect_sound_normals(cylinder);
  const double prism = 0.5 * kSegments * r * r * std::sin(2 * M_PI / kSegments) * length;
  EXPECT_NEAR(volume_of(cylinder), prism, kSingle * prism);
  // An inscribed polygon of n corners lacks (2 pi / n)^2 / 6 of the circle's area.
  const double round = M_PI * r * r * length;
  EXPECT_NEAR(volume_of(cylinder), round, 1.01 * std::pow(2 * M_PI / kSegments, 2) / 6 * round);
  EXPECT_NEAR(box_of(cylinder).size()[2], length, kSingle);
  // On the wall the normals are those of the true cylinder.
  for (const auto& vertex : cylinder.vertices) {
    const Eigen::Vector3d n = point_of(vertex.normal), p = point_of(vertex.position);
    if (n[2] != 0) continue;
    EXPECT_NEAR(n.dot(p), r, kSingle);
  }
}

TEST(Primitives, ASphereHasItsRadiusAndNearlyItsVolume) {
  const double r = 0.2;
  const TriangleMesh sphere = sphere_mesh(r);
  expect_closed(sphere);
  expect_sound_normals(sphere);
  for (const auto& vertex : sphere.vertices) {
    EXPECT_NEAR(point_of(vertex.position).norm(), r, kSingle);
    EXPECT_NEAR((point_of(vertex.position) / r - point_of(vertex.normal)).norm(), 0, kSingle);
  }
  // Each circle of latitude lacks (2 pi / n)^2 / 6 and the meridians, of the same fineness, about as much.
  const double round = 4 * M_PI / 3 * r * r * r;
  const double lack = std::pow(2 * M_PI / kSegments, 2) / 6;
  EXPECT_LT(volume_of(sphere), (1 - lack) * round);
  EXPECT_GT(volume_of(sphere), (1 - 2.5 * lack) * round);
}

TEST(Primitives, AnOpenMeshIsFoundOut) {
  TriangleMesh box = box_mesh({1, 1, 1});
  EXPECT_LT(vector_area_of(box).norm(), 1e-12);
  std::swap(box.triangles[0], box.triangles[1]);  // the negative control of the checks above
  EXPECT_GT(vector_area_of(box).norm(), 0.9);
  EXPECT_LT(volume_of(box), 0.9);
}

}  // namespace
}  // namespace chainreel

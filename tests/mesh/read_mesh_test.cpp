#include "mesh/read_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "mesh/primitives.hpp"
#include "mesh_files.hpp"
#include "support/public_robots.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;

// Files and placements are in single precision, 6e-8 a number; here numbers go up to some 10.
constexpr double kFloatRounding = 1e-5;

const Eigen::Vector3d kLower(1, 2, 3), kUpper(2, 4, 6);  // a box of 1 x 2 x 3, volume 6

using ReadMesh = MeshFolder;

void expect_box(const TriangleMesh& mesh, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  const Box box = box_of(mesh);
  EXPECT_LT((box.lower - lower).cwiseAbs().maxCoeff(), kFloatRounding) << box.lower.transpose();
  EXPECT_LT((box.upper - upper).cwiseAbs().maxCoeff(), kFloatRounding) << box.upper.transpose();
  EXPECT_NEAR(volume_of(mesh), (upper - lower).prod(), kFloatRounding * (upper - lower).prod());
  EXPECT_LT(vector_area_of(mesh).norm(), kFloatRounding);
  EXPECT_EQ(mesh.triangles.size(), 36U);
  EXPECT_EQ(mesh.vertices.size(), 24U);  // three normals at each corner of a box
  expect_sound_normals(mesh);
}

TEST_F(ReadMesh, EveryFormatGivesTheSameBox) {
  const std::vector<Triangle> box = box_triangles(kLower, kUpper);
  for (const std::string& path : {file("b.stl", binary_stl(box)), file("a.STL", ascii_stl(box)),
                                  file("o.obj", obj(box)), file("d.dae", collada(box))}) {
    SCOPED_TRACE(path);
    const TriangleMesh mesh = read_mesh(path);
    expect_box(mesh, kLower, kUpper);
    const Box extents = mesh_extents(path);
    EXPECT_EQ(box_of(mesh).lower, extents.lower);
    EXPECT_EQ(box_of(mesh).upper, extents.upper);
  }
}

TEST_F(ReadMesh, ColladasUnitAndNodesPlaceIt) {
  Collada with;
  with.meter = "0.01";
  with.open = "<node id=\"a\"><translate>100 0 0</translate><node id=\"b\"><scale>2 1 1</scale>";
  with.close = "</node></node>";
  const std::string path = file("n.dae", collada(box_triangles(kLower, kUpper), with));
  expect_box(read_mesh(path), {1.02, 0.02, 0.03}, {1.04, 0.04, 0.06});
  EXPECT_EQ(box_of(read_mesh(path)).upper, mesh_extents(path).upper);
}

TEST_F(ReadMesh, AMirrorKeepsTheOutsideOutside) {
  Collada with;
  with.open = "<node id=\"a\"><scale>-1 1 1</scale>";
  expect_box(read_mesh(file("m.dae", collada(box_triangles(kLower, kUpper), with))), {-2, 2, 3}, {-1, 4, 6});
}

// Stretched along x, a slope is less steep: its normal turns towards z, where a vector would turn towards x.
TEST_F(ReadMesh, NormalsOfTheFileGoByTheInverseTranspose) {
  const std::vector<Triangle> slope{{Eigen::Vector3d(0, 0, 0), {1, 0, -1}, {0, 1, 0}}};  // normal (1, 0, 1)
  Collada with;
  // Three normals that differ, so that they tell of a surface.
  with.normals = "0.6 0 0.8  0.8 0 0.6  0.7071068 0 0.7071068";
  with.open = "<node id=\"a\"><scale>3 1 1</scale>";
  const TriangleMesh mesh = read_mesh(file("s.dae", collada(slope, with)));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  const Eigen::Vector3d expected[3] = {{0.2, 0, 0.8}, {0.8 / 3, 0, 0.6}, {1.0 / 3, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((point_of(mesh.vertices[i].normal) - expected[i].normalized()).norm(), 1e-6) << i;
}

// Of a mirrored surface the outside stays outside: normals are mirrored with it, and never turned inwards.
TEST_F(ReadMesh, NormalsOfAMirroredFileAreMirrored) {
  const std::vector<Triangle> slope{{Eigen::Vector3d(0, 0, 0), {1, 0, -1}, {0, 1, 0}}};  // normal (1, 0, 1)
  Collada with;
  with.normals = "0.6 0 0.8  0.8 0 0.6  0.7071068 0 0.7071068";
  with.open = "<node id=\"a\"><scale>-1 1 1</scale>";
  const TriangleMesh mesh = read_mesh(file("s.dae", collada(slope, with)));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  const auto corner = [&](std::size_t i) { return point_of(mesh.vertices[mesh.triangles.at(i)].position); };
  const Eigen::Vector3d across = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  EXPECT_LT((across - Eigen::Vector3d(-1, 0, 1)).norm(), 1e-6);
  for (const auto& vertex : mesh.vertices) {
    const Eigen::Vector3d p = point_of(vertex.position), n = point_of(vertex.normal);
    const Eigen::Vector3d expected = p[0] < -0.5   ? Eigen::Vector3d(-0.8, 0, 0.6)
                                     : p[1] > 0.5 ? Eigen::Vector3d(-1, 0, 1).normalized()
                                                  : Eigen::Vector3d(-0.6, 0, 0.8);
    EXPECT_LT((n - expected).norm(), 1e-6) << p.transpose();
  }
}

TEST_F(ReadMesh, UpIsIgnoredAsInRvizOrBecomesZ) {
  const std::vector<Triangle> box = box_triangles(kLower, kUpper);
  Collada with;
  with.up = "Y_UP";
  const std::string y = file("y.dae", collada(box, with));
  expect_box(read_mesh(y), kLower, kUpper);
  // (x, y, z) becomes (x, -z, y).
  expect_box(read_mesh(y, MeshUp::file), {1, -6, 2}, {2, -3, 4});

  with.up = "Z_UP";
  with.open = "<node id=\"a\"><translate>0 0 10</translate>";
  with.meter = "0.1";
  const std::string z = file("z.dae", collada(box, with));
  expect_box(read_mesh(z), {0.1, 0.2, 1.3}, {0.2, 0.4, 1.6});
  expect_box(read_mesh(z, MeshUp::file), {0.1, 0.2, 1.3}, {0.2, 0.4, 1.6});

  // The standard's X_UP has right = -y and inward = z: up +x goes to +z.
  with = {};
  with.up = "X_UP";
  const Box turned = box_of(read_mesh(file("x.dae", collada(box, with)), MeshUp::file));
  EXPECT_NEAR(turned.lower[2], 1, kFloatRounding);
  EXPECT_NEAR(turned.upper[2], 2, kFloatRounding);

  const std::string o = file("o.obj", obj(box));
  expect_box(read_mesh(o, MeshUp::file), kLower, kUpper);
}

// A cylinder of facets, as CAD writes it: the wall becomes round, the rim stays sharp.
TEST_F(ReadMesh, FacetsAreSmoothedAndEdgesStaySharp) {
  const TriangleMesh round = cylinder_mesh(0.1, 0.5);
  std::vector<Triangle> facets;
  for (std::size_t i = 0; i < round.triangles.size(); i += 3) {
    const auto p = [&](std::size_t c) { return point_of(round.vertices[round.triangles[i + c]].position); };
    facets.push_back({p(0), p(1), p(2)});
  }
  const TriangleMesh mesh = read_mesh(file("c.stl", binary_stl(facets)));
  EXPECT_NEAR(volume_of(mesh), volume_of(round), 1e-6 * volume_of(round));
  EXPECT_EQ(mesh.vertices.size(), round.vertices.size());
  std::size_t on_wall = 0;
  for (const auto& vertex : mesh.vertices) {
    const Eigen::Vector3d n = point_of(vertex.normal), p = point_of(vertex.position);
    if (std::fabs(n[2]) > 0.5) {
      EXPECT_NEAR(std::fabs(n[2]), 1, 1e-6);
      continue;
    }
    ++on_wall;
    // Weights by angle: each facet beside an edge counts alike, however it was cut in two.
    EXPECT_LT((n - Eigen::Vector3d(p[0], p[1], 0).normalized()).norm(), 1e-4);
  }
  EXPECT_EQ(on_wall, 96U);

  // Normals that only repeat the faces' tell no more.
  Collada with;
  for (const Triangle& t : facets) {
    const Eigen::Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    for (int c = 0; c < 3; ++c) with.normals += numbers(n) + " ";
  }
  EXPECT_EQ(read_mesh(file("c.dae", collada(facets, with))).vertices.size(), round.vertices.size());
}

TEST_F(ReadMesh, TrianglesWithoutAreaLinesAndPointsAreLeftOut) {
  const std::string path =
      file("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 4\nl 1 2\np 3\n");
  const TriangleMesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.vertices.size(), 3U);
}

TEST_F(ReadMesh, PolygonsAreCutIntoTriangles) {
  // An L of area 3, which a fan from its first corner would not fill.
  const TriangleMesh mesh =
      read_mesh(file("l.obj", "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n"));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(vector_area_of(mesh)[2], 3, 1e-6);
}

TEST_F(ReadMesh, ColoursAreThoseOfMaterials) {
  const std::vector<Triangle> box = box_triangles(kLower, kUpper);
  file("m.mtl", "newmtl red\nKd 1 0 0\nd 0.5\n");
  const TriangleMesh red = read_mesh(file("r.obj", obj(box, "mtllib m.mtl\nusemtl red\n")));
  EXPECT_TRUE(red.has_colors);
  EXPECT_THAT(colors_of(red), ElementsAre(std::array<std::uint8_t, 4>{255, 0, 0, 128}));

  const TriangleMesh blue = read_mesh(file("b.dae", collada(box)));
  EXPECT_TRUE(blue.has_colors);
  EXPECT_THAT(colors_of(blue), ElementsAre(std::array<std::uint8_t, 4>{51, 102, 153, 255}));

  for (const std::string& path : {file("w.obj", obj(box)), file("w.stl", binary_stl(box))}) {
    const TriangleMesh white = read_mesh(path);
    EXPECT_FALSE(white.has_colors) << path;
    EXPECT_THAT(colors_of(white), ElementsAre(std::array<std::uint8_t, 4>{255, 255, 255, 255}));
  }
}

TEST_F(ReadMesh, ColoursOfVerticesAndOfBinaryStlWin) {
  const std::vector<Triangle> one{{Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}}};
  Collada with;
  with.vertex_colors = "1 0 0 1  0 1 0 1  0 0 1 0.2";
  const TriangleMesh mesh = read_mesh(file("v.dae", collada(one, with)));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  EXPECT_THAT(mesh.vertices[0].color, ElementsAre(255, 0, 0, 255));
  EXPECT_THAT(mesh.vertices[1].color, ElementsAre(0, 255, 0, 255));
  EXPECT_THAT(mesh.vertices[2].color, ElementsAre(0, 0, 255, 51));

  // Bit 15 says that there is a colour; five bits each, blue lowest.
  const TriangleMesh green = read_mesh(file("g.stl", binary_stl(one, "", 0x8000 | (31 << 5))));
  EXPECT_TRUE(green.has_colors);
  EXPECT_THAT(colors_of(green), ElementsAre(std::array<std::uint8_t, 4>{0, 255, 0, 255}));
}

TEST_F(ReadMesh, PublicRobotsHaveTheirMeasures) {
  const std::string robots = public_robots_folder();
  if (robots.empty()) GTEST_SKIP() << kNoRobots;
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(robots)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".dae" && ending != ".stl" && ending != ".obj") continue;
    SCOPED_TRACE(entry.path().string());
    const TriangleMesh mesh = read_mesh(entry.path().string());
    const Box extents = mesh_extents(entry.path().string());
    EXPECT_LT((box_of(mesh).lower - extents.lower).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((box_of(mesh).upper - extents.upper).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_GT(volume_of(mesh), 0);  // outside is outside
    EXPECT_EQ(mesh.has_colors, ending == ".dae");
    ++count;
  }
  EXPECT_GT(count, 40);
  // The Panda's base is 0.226 m long and 0.14 m high.
  const Box base = box_of(read_mesh(std::string(robots) + "/panda_description/meshes/visual/link0.dae"));
  EXPECT_NEAR(base.size()[0], 0.226, 0.001);
  EXPECT_NEAR(base.size()[2], 0.14, 0.001);
}

}  // namespace
}  // namespace chainreel

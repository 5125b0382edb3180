#include "mesh/mesh_extents.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "support/public_robots.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A file in a folder of its own, gone with the test.
class MeshExtents : public ::testing::Test {
 protected:
  MeshExtents() { fs::create_directories(folder_); }
  ~MeshExtents() override { fs::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& content) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  // Exit code and message of a file that must be refused.
  static std::pair<ExitCode, std::string> refusal(const std::string& path) {
    try {
      mesh_extents(path);
    } catch (const Error& error) {
      return {error.code(), error.what()};
    }
    return {ExitCode::good, "it was read"};
  }

  fs::path folder_ = fs::temp_directory_path() / ("chainreel_mesh_test_" + std::to_string(getpid()));
};

void expect_box(const Box& box, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  // Meshes are stored and placed in single precision: 24 bits of the largest coordinate.
  const double tolerance = 1e-6 * std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
  EXPECT_LE((box.lower - lower).cwiseAbs().maxCoeff(), tolerance) << box.lower.transpose();
  EXPECT_LE((box.upper - upper).cwiseAbs().maxCoeff(), tolerance) << box.upper.transpose();
}

constexpr const char* kTriangleStl =
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 2 0 1\nvertex 0 3 "
    "-4\nendloop\nendfacet\nendsolid t\n";

std::string collada_scene(const std::string& unit, const std::string& placement, const std::string& up = "Z_UP") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         unit + R"("/><up_axis>)" + up + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 1  2 0 1  0 3 -4</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n">)" +
         placement + R"(<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(MeshExtents, StlAndObjGiveTheBoxOfTheirVertices) {
  expect_box(mesh_extents(file("t.stl", kTriangleStl)), {0, 0, -4}, {2, 3, 1});
  expect_box(mesh_extents(file("T.STL", kTriangleStl)), {0, 0, -4}, {2, 3, 1});
  expect_box(mesh_extents(file("t.obj", "v 0 0 1\nv 2 0 1\nv 0 3 -4\nf 1 2 3\n")), {0, 0, -4}, {2, 3, 1});
}

TEST_F(MeshExtents, ColladaUnitsAreHonoured) {
  expect_box(mesh_extents(file("m.dae", collada_scene("1", ""))), {0, 0, -4}, {2, 3, 1});
  expect_box(mesh_extents(file("mm.dae", collada_scene("0.001", ""))), {0, 0, -0.004}, {0.002, 0.003, 0.001});
}

TEST_F(MeshExtents, NodesPlaceTheirMeshes) {
  const std::string shifted = collada_scene("1", "<translate>10 20 30</translate><scale>2 1 1</scale>");
  expect_box(mesh_extents(file("n.dae", shifted)), {10, 20, 26}, {14, 23, 31});
}

TEST_F(MeshExtents, ColladasUpDoesNotTurnTheMesh) {
  expect_box(mesh_extents(file("y.dae", collada_scene("1", "", "Y_UP"))), {0, 0, -4}, {2, 3, 1});
}

TEST_F(MeshExtents, FilesThatAreNoMeshAreRefusedWithAReason) {
  EXPECT_EQ(refusal((folder_ / "none.stl").string()).first, ExitCode::bad_input);
  EXPECT_THAT(refusal((folder_ / "none.stl").string()).second, HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_.string()).second, HasSubstr("is not a mesh file"));
  EXPECT_THAT(refusal(file("t.step", kTriangleStl)).second, HasSubstr("convert it to STL, OBJ or DAE"));
  EXPECT_THAT(refusal(file("empty.stl", "")).second, HasSubstr("is no mesh"));
  EXPECT_THAT(refusal(file("text.dae", "hello")).second, HasSubstr("text.dae"));
  EXPECT_THAT(refusal(file("nothing.obj", "v 0 0 0\n")).second, HasSubstr("nothing.obj"));
}

TEST_F(MeshExtents, ABrokenFileNeverEndsTheProgram) {
  // A binary STL that claims four thousand million triangles and has none.
  std::string claim(84, '\0');
  claim[80] = claim[81] = claim[82] = claim[83] = '\xff';
  EXPECT_EQ(refusal(file("claim.stl", claim)).first, ExitCode::bad_input);
  EXPECT_EQ(refusal(file("indices.obj", "v 0 0 0\nf 1 2 999999999\n")).first, ExitCode::bad_input);
  const std::string endless = "<COLLADA version=\"1.4.1\">" + std::string(100'000, '<');
  EXPECT_EQ(refusal(file("endless.dae", endless)).first, ExitCode::bad_input);
  // Every cut of a good file is either read or refused.
  const std::string whole = collada_scene("1", "");
  for (std::size_t size = 0; size < whole.size(); size += 97) refusal(file("cut.dae", whole.substr(0, size)));
}

TEST_F(MeshExtents, AFileBeyondTheLimitIsRefusedUnread) {
  const std::string path = file("large.stl", "");
  fs::resize_file(path, kLargestMeshFile + 1);  // a hole, no data
  EXPECT_EQ(refusal(path).first, ExitCode::limit);
  fs::resize_file(path, 100);
  EXPECT_EQ(refusal(path).first, ExitCode::bad_input);
}

TEST_F(MeshExtents, PublicRobotsAreReadInMetres) {
  const std::string folder = public_robots_folder();
  if (folder.empty()) GTEST_SKIP() << kNoRobots;
  // A Panda's hand is some 20 cm wide; its visual mesh is Collada, its collision mesh STL.
  const Box visual = mesh_extents(folder + "/panda_description/meshes/visual/hand.dae");
  const Box collision = mesh_extents(folder + "/panda_description/meshes/collision/hand.stl");
  EXPECT_NEAR(visual.size()[1], 0.2, 0.02);
  EXPECT_NEAR(collision.size()[1], 0.2, 0.02);
}

}  // namespace
}  // namespace chainreel

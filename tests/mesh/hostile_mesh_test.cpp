// Files that nobody means well with: each is read or refused with one sentence, and the program lives on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>
#include <random>

#include "core/error.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh_files.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

const std::vector<Triangle> kBox = box_triangles({0, 0, 0}, {1, 1, 1});

struct Refusal {
  ExitCode code = ExitCode::good;
  std::string text;
};

class HostileMesh : public MeshFolder {
 protected:
  Refusal refusal(const std::string& name, const std::string& content) const {
    const std::string path = file(name, content);
    try {
      read_mesh(path);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
      return {error.code(), error.what()};
    }
    return {ExitCode::good, "it was read"};
  }
};

TEST_F(HostileMesh, FilesThatAreNoMeshAreRefused) {
  EXPECT_EQ(refusal("empty.stl", "").code, ExitCode::bad_input);
  EXPECT_EQ(refusal("text.dae", "hello").code, ExitCode::bad_input);
  EXPECT_EQ(refusal("points.obj", "v 0 0 0\n").code, ExitCode::bad_input);
  EXPECT_THAT(refusal("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").text, HasSubstr("holds no triangle"));
  EXPECT_THAT(refusal("t.step", binary_stl(kBox)).text, HasSubstr("convert it to STL, OBJ or DAE"));
  EXPECT_THROW(read_mesh((folder_ / "none.stl").string()), Error);
}

// A material file elsewhere is not opened, whatever leads to it: complaints about one quote its lines.
TEST_F(HostileMesh, MaterialsAreReadBesideTheMeshAlone) {
  const std::string red = "newmtl red\nKd 1 0 0\n";
  std::filesystem::create_directories(folder_ / "robot/meshes/sub");
  file("robot/secret.mtl", red);
  file("robot/meshes/paint.mtl", red);  // not m.mtl, which is tried where another one is missing
  file("robot/meshes/sub/paint.mtl", red);
  std::filesystem::create_symlink("../secret.mtl", folder_ / "robot/meshes/link.mtl");
  const auto is_red = [&](const std::string& library) {
    const TriangleMesh mesh = read_mesh(file("robot/meshes/m.obj", "mtllib " + library + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"));
    return mesh.has_colors && mesh.vertices.at(0).color[1] == 0;
  };
  for (const char* library : {"paint.mtl", "sub/paint.mtl"}) EXPECT_TRUE(is_red(library)) << library;
  for (const std::string& library : {std::string("../secret.mtl"), std::string("link.mtl"), (folder_ / "robot/secret.mtl").string()})
    EXPECT_FALSE(is_red(library)) << library;
}

TEST_F(HostileMesh, BeyondTheLimitNothingIsRead) {
  const std::string path = file("large.dae", "");
  std::filesystem::resize_file(path, kLargestMeshFile + 1);
  try {
    read_mesh(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::limit);
  }
}

TEST_F(HostileMesh, MoreTrianglesThanAllowedAreALimit) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (std::size_t i = 0; i <= kMostTriangles; ++i) text += "f 1 2 3\n";
  const Refusal many = refusal("many.obj", text);
  EXPECT_EQ(many.code, ExitCode::limit) << many.text;
  EXPECT_THAT(many.text, HasSubstr("more than 4 million triangles"));
}

// A box that nodes show ten times each, `levels` deep.
std::string multiplied(int levels) {
  Collada with;
  with.images = "<library_nodes>";
  for (int level = 0; level < levels; ++level) {
    with.images += "<node id=\"l" + std::to_string(level) + "\">";
    for (int i = 0; i < 10; ++i)
      with.images += level == 0 ? std::string("<instance_geometry url=\"#g\"/>")
                                : "<instance_node url=\"#l" + std::to_string(level - 1) + "\"/>";
    with.images += "</node>";
  }
  with.images += "</library_nodes>";
  with.open = "<node id=\"n\"><instance_node url=\"#l" + std::to_string(levels - 1) + "\"/>";
  return collada(kBox, with);
}

TEST_F(HostileMesh, NodesThatMultiplyAreBounded) {
  const std::string path = file("many.dae", multiplied(3));
  EXPECT_EQ(read_mesh(path).triangles.size(), 36U * 1001);
  EXPECT_EQ(refusal("many.dae", multiplied(6)).code, ExitCode::limit);  // twelve million triangles
  // The nodes alone are beyond the child's memory; less of it is full sooner.
#ifndef __SANITIZE_ADDRESS__
  const LessMemory less(std::size_t(128) << 20);
#endif
  EXPECT_EQ(refusal("many.dae", multiplied(9)).code, ExitCode::bad_input);
}

TEST_F(HostileMesh, DeepNodesAndLoopsOfNodes) {
  Collada deep;
  for (int i = 0; i < 200'000; ++i) {
    deep.open += "<node>";
    deep.close += "</node>";
  }
  EXPECT_EQ(refusal("deep.dae", collada(kBox, deep)).code, ExitCode::bad_input);
  Collada loop;
  loop.images = "<library_nodes><node id=\"a\"><instance_node url=\"#a\"/></node></library_nodes>";
  loop.open = "<node id=\"n\"><instance_node url=\"#a\"/>";
  const Refusal round = refusal("loop.dae", collada(kBox, loop));
  EXPECT_EQ(round.code, ExitCode::bad_input) << round.text;
}

TEST_F(HostileMesh, CountsThatAreNotThere) {
  std::string claim = binary_stl(kBox);
  const std::uint32_t thousand_million = 1'000'000'000;
  std::memcpy(claim.data() + 80, &thousand_million, 4);
  EXPECT_EQ(refusal("claim.stl", claim).code, ExitCode::bad_input);
  Collada with;
  for (const int more : {-1, 1, 1'000'000'000}) {
    with.count_more = more;
    EXPECT_EQ(refusal("count.dae", collada(kBox, with)).code, ExitCode::bad_input) << more;
  }
}

TEST_F(HostileMesh, IndicesOutOfRange) {
  EXPECT_EQ(refusal("i.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 999999999\n").code, ExitCode::bad_input);
  EXPECT_EQ(refusal("n.obj", "v 0 0 0\nf -1 -2 -3\n").code, ExitCode::bad_input);
  Collada with;
  with.instead_of_p = "0 1 4000000";
  with.count_more = 1 - int(kBox.size());
  EXPECT_EQ(refusal("i.dae", collada(kBox, with)).code, ExitCode::bad_input);
}

TEST_F(HostileMesh, NumbersThatAreNone) {
  std::string nan = binary_stl(kBox);
  const float value = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 84 + 12, &value, 4);
  EXPECT_THAT(refusal("nan.stl", nan).text, HasSubstr("not finite"));
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(nan.data() + 84 + 12, &infinite, 4);
  EXPECT_THAT(refusal("inf.stl", nan).text, HasSubstr("not finite"));
  EXPECT_EQ(refusal("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").code, ExitCode::bad_input);
  Collada with;
  with.open = "<node id=\"n\"><scale>1e30 1e30 1e30</scale><scale>1e30 1 1</scale>";
  EXPECT_EQ(refusal("inf.dae", collada(kBox, with)).code, ExitCode::bad_input);
}

// assimp would wait for a pipe's other end for ever.
TEST_F(HostileMesh, NamedPipesAreNotOpened) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.mtl").c_str(), 0600), 0);
  EXPECT_EQ(refusal("p.obj", obj(kBox, "mtllib pipe.mtl\nusemtl a\n")).code, ExitCode::good);
  ASSERT_EQ(mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  file("t.mtl", "newmtl a\nmap_Kd pipe.png\n");
  EXPECT_EQ(refusal("t.obj", obj(kBox, "mtllib t.mtl\nusemtl a\n")).code, ExitCode::good);
}

// Good files cut off and with bytes changed; seeded, so that a failure comes back.
TEST_F(HostileMesh, DamagedFilesNeverEndTheProgram) {
  const std::vector<std::pair<std::string, std::string>> good{{"b.stl", binary_stl(kBox)},
                                                              {"a.stl", ascii_stl(kBox)},
                                                              {"o.obj", obj(kBox)},
                                                              {"d.dae", collada(kBox)}};
  std::mt19937 random(1);
  int read = 0, refused = 0;
  for (const auto& [name, whole] : good) {
    EXPECT_EQ(refusal(name, whole).code, ExitCode::good);
    for (int i = 0; i < 60; ++i) {
      std::string text = whole.substr(0, i % 3 == 0 ? random() % whole.size() : whole.size());
      const int changes = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 20;
      for (int k = 0; k < changes && !text.empty(); ++k) text[random() % text.size()] = char(random());
      const Refusal result = refusal(name, text);
      ++(result.code == ExitCode::good ? read : refused);
      EXPECT_TRUE(result.code == ExitCode::good || result.code == ExitCode::bad_input ||
                  result.code == ExitCode::limit)
          << result.text;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace chainreel

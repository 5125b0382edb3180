#include "mesh/triangle_sketch.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace chainreel {
namespace {

// A sheet of n x n squares, two triangles each, waved so that no two are alike.
TriangleMesh sheet(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      TriangleMesh::Vertex vertex;
      vertex.position = {float(i) / float(n), float(k) / float(n),
                         float(0.1 * std::sin(0.7 * i) * std::cos(0.3 * k))};
      vertex.normal = {float(std::sin(i)), float(std::cos(k)), float(0.1 * i)};
      vertex.color = {255, 255, 255, 255};
      mesh.vertices.push_back(vertex);
    }
  for (std::uint32_t i = 0; i < std::uint32_t(n); ++i)
    for (std::uint32_t k = 0; k < std::uint32_t(n); ++k) {
      const std::uint32_t a = i * std::uint32_t(n + 1) + k, b = a + std::uint32_t(n + 1);
      for (const std::uint32_t corner : {a, b, a + 1, a + 1, b, b + 1}) mesh.triangles.push_back(corner);
    }
  return mesh;
}

// The same surface, written in another order: triangles, the corner each begins with, and vertices, each of
// which now belongs to one triangle alone.
TriangleMesh shuffled(const TriangleMesh& mesh, std::mt19937& lot) {
  std::vector<std::size_t> order(mesh.triangles.size() / 3);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), lot);
  TriangleMesh other;
  for (const std::size_t i : order)
    for (std::size_t k = 0, first = lot() % 3; k < 3; ++k) {
      other.triangles.push_back(std::uint32_t(other.vertices.size()));
      other.vertices.push_back(mesh.vertices[mesh.triangles[3 * i + (first + k) % 3]]);
    }
  return other;
}

TriangleMesh without_first(TriangleMesh mesh, std::size_t triangles) {
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + std::ptrdiff_t(3 * triangles));
  return mesh;
}

TriangleMesh moved_first(TriangleMesh mesh, std::size_t triangles) {
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    mesh.vertices.push_back(mesh.vertices[mesh.triangles[i]]);
    mesh.vertices.back().position[2] += 1;
    mesh.triangles[i] = std::uint32_t(mesh.vertices.size() - 1);
  }
  return mesh;
}

TEST(TriangleSketch, KnowsNoOrderOfTrianglesAndVertices) {
  std::mt19937 lot(1);
  for (const int n : {1, 5, 40}) {
    const TriangleMesh mesh = sheet(n);
    EXPECT_EQ(sketch_of(mesh), sketch_of(shuffled(mesh, lot))) << n;
  }
}

TEST(TriangleSketch, TellsATriangleThatIsTurnedOver) {
  TriangleMesh mesh = sheet(5);
  const TriangleSketch before = sketch_of(mesh);
  std::swap(mesh.triangles[0], mesh.triangles[1]);
  const TriangleDifference difference = difference_of(before, sketch_of(mesh));
  EXPECT_EQ(difference.gone, 1);
  EXPECT_EQ(difference.come, 1);
}

TEST(TriangleSketch, CountsFewTrianglesExactlyInMeshesOfAnySize) {
  for (const int n : {3, 11, 12, 60, 200}) {
    SCOPED_TRACE(n);
    const TriangleMesh mesh = sheet(n);
    const TriangleSketch before = sketch_of(mesh);
    const TriangleDifference one = difference_of(before, sketch_of(without_first(mesh, 1)));
    EXPECT_EQ(one.gone, 1);
    EXPECT_EQ(one.come, 0);
    EXPECT_TRUE(one.is_counted);
    const TriangleDifference moved = difference_of(before, sketch_of(moved_first(mesh, 1)));
    EXPECT_EQ(moved.gone, 1);
    EXPECT_EQ(moved.come, 1);
    const TriangleDifference back = difference_of(sketch_of(without_first(mesh, 1)), before);
    EXPECT_EQ(back.come, 1);
    EXPECT_EQ(difference_of(before, before).share, 0);
  }
}

// Buckets count what is gone and come up to some 350; the spread of an estimate by samples of some 128 is 10
// %, three of which a lot of this size may show.
TEST(TriangleSketch, EstimatesShares) {
  const TriangleMesh mesh = sheet(100);  // 20,000 triangles
  const TriangleSketch before = sketch_of(mesh);
  for (const double share : {0.0005, 0.002, 0.005, 0.02, 0.1, 0.5, 0.9}) {
    SCOPED_TRACE(share);
    const auto count = std::size_t(std::lround(share * 20000));
    EXPECT_NEAR(difference_of(before, sketch_of(moved_first(mesh, count))).share, share,
                0.3 * share + 0.02 * (share > 0.008));
    EXPECT_NEAR(difference_of(before, sketch_of(without_first(mesh, count))).gone, double(count),
                0.3 * double(count) + 1);
  }
  EXPECT_NEAR(difference_of(before, sketch_of(moved_first(mesh, 20000))).share, 1, 1e-12);
}

TEST(TriangleSketch, KeepsColoursApartFromShape) {
  TriangleMesh mesh = sheet(20);
  const TriangleSketch before = sketch_of(mesh);
  mesh.vertices[7].color[1] = 251;
  const TriangleSketch after = sketch_of(mesh);
  EXPECT_EQ(before.shape, after.shape);
  EXPECT_NE(before.colors, after.colors);
}

TEST(TriangleSketch, TellsOtherNormalsFromTheirRoundOff) {
  for (const int n : {2, 20, 100}) {
    TriangleMesh mesh = sheet(n);
    const TriangleSketch before = sketch_of(mesh);
    for (TriangleMesh::Vertex& vertex : mesh.vertices) vertex.normal[0] *= 1 + 1e-7F;
    EXPECT_EQ(before, sketch_of(mesh)) << n;
    mesh.vertices[4].normal[1] += 0.01F;
    EXPECT_FALSE(before == sketch_of(mesh)) << n;
    EXPECT_EQ(before.shape, sketch_of(mesh).shape);
  }
}

TEST(TriangleSketch, IsReadBackFromASmallJson) {
  for (const int n : {0, 2, 80}) {
    const TriangleSketch sketch = n == 0 ? sketch_of({}) : sketch_of(sheet(n));
    const std::string text = to_json(sketch).dump();
    EXPECT_LT(text.size(), 5000U);
    EXPECT_EQ(triangle_sketch_of(parse_json(text)), sketch);
  }
  Json json = to_json(sketch_of(sheet(80)));
  for (const auto& [key, value] : std::vector<std::pair<const char*, Json>>{{"sample", "0123"},
                                                                            {"sample", "0123456g"},
                                                                            {"shape", ""},
                                                                            {"thinning", 99},
                                                                            {"buckets", 3},
                                                                            {"lower", {1, 2}}}) {
    Json bad = json;
    bad[key] = value;
    // A cut list of buckets, too, counts by the sample.
    try {
      (void)difference_of(sketch_of(sheet(80)), triangle_sketch_of(bad));
      EXPECT_STREQ(key, "sample") << value.dump();
    } catch (const Json::exception&) {
    } catch (const std::invalid_argument&) {
    }
  }
}

}  // namespace
}  // namespace chainreel

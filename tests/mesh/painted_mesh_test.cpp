// Images on meshes: what vertices' colours say, held against the image itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <set>

// clang-format off: libjpeg's header needs <cstdio> before it
#include <jpeglib.h>
// clang-format on

#include "core/error.hpp"
#include "mesh/painted_mesh.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/texture.hpp"
#include "mesh_files.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;

class Textures : public MeshFolder {
 protected:
  // Red, green, blue, opacity of each pixel, row by row from above.
  void png(const std::string& name, int width, const std::vector<std::uint8_t>& rgba) const {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = png_uint_32(width);
    png.height = png_uint_32(int(rgba.size()) / 4 / width);
    png.format = PNG_FORMAT_RGBA;
    ASSERT_NE(png_image_write_to_file(&png, (folder_ / name).c_str(), 0, rgba.data(), 0, nullptr), 0);
  }
  void png(const std::string& name, const Texture& texture) const {
    std::vector<std::uint8_t> rgba;
    for (const ColorBytes& texel : texture.texels) rgba.insert(rgba.end(), texel.begin(), texel.end());
    png(name, texture.width, rgba);
  }

  // A square of 1 m with its lower left corner at the origin, on which the image lies `repeats` times each way.
  TriangleMesh square(const std::string& map, double repeats = 1, const std::string& kd = "1 1 1") const {
    file("square.mtl", "newmtl m\nKd " + kd + "\nmap_Kd " + map + "\n");
    const std::string r = std::to_string(repeats);
    return read_mesh(file("square.obj", "mtllib square.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt " + r + " 0\nvt " + r +
                                            " " + r + "\nvt 0 " + r + "\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"));
  }
};

Texture image(int width, int height, const std::function<ColorBytes(int, int)>& color) {
  Texture texture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) texture.texels.push_back(color(x, y));
  return texture;
}

Texture noise(int side) {
  std::mt19937 random(7);
  return image(side, side, [&](int, int) { return ColorBytes{std::uint8_t(random()), std::uint8_t(random()), std::uint8_t(random()), 255}; });
}

// The square's colours at the middles of texels of an image that lies on it once: as far as they are from the image's, 0 to 255.
double worst_on_square(const TriangleMesh& mesh, const Texture& texture) {
  double worst = 0;
  int seen = 0;
  for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    std::array<const TriangleMesh::Vertex*, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) v[k] = &mesh.vertices[mesh.triangles[t + k]];
    const auto x = [&](std::size_t k) { return double(v[k]->position[0]) * texture.width - 0.5; };
    const auto y = [&](std::size_t k) { return (1 - double(v[k]->position[1])) * texture.height - 0.5; };
    const double twice = (x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0));
    const auto [left, right] = std::minmax({x(0), x(1), x(2)});
    const auto [top, bottom] = std::minmax({y(0), y(1), y(2)});
    for (int j = int(std::ceil(top)); j <= std::min(texture.height - 1, int(bottom)); ++j)
      for (int i = int(std::ceil(left)); i <= std::min(texture.width - 1, int(right)); ++i) {
        if (i < 0 || j < 0) continue;
        const double b = ((i - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (j - y(0))) / twice;
        const double c = ((x(1) - x(0)) * (j - y(0)) - (i - x(0)) * (y(1) - y(0))) / twice;
        if (b < 0 || c < 0 || b + c > 1) continue;
        ++seen;
        for (std::size_t k = 0; k < 3; ++k)
          worst = std::max(worst, std::abs((1 - b - c) * v[0]->color[k] + b * v[1]->color[k] + c * v[2]->color[k] - texture.texel(i, j)[k]));
      }
  }
  EXPECT_GE(seen, texture.width * texture.height);  // each texel's middle lies in a triangle
  return worst;
}

// Edges by their places that are not two triangles' in opposite directions.
int open_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
  for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &a = mesh.vertices[mesh.triangles[t + k]].position, &b = mesh.vertices[mesh.triangles[t + (k + 1) % 3]].position;
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  return int(std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second != 0; }));
}

// Colours lie within 20 of 255 by the promise of mesh/painted_mesh, and a vertex's is rounded by half of one.
constexpr double kPainted = 21;
// Where an image changes more sharply than triangles as small as texels follow, each texel is nearer to its own colour than to
// its neighbour's: off by less than half of the step between both.

TEST_F(Textures, AreSeenTexelByTexel) {
  const Texture checks = image(16, 8, [](int x, int y) { return (x + y) % 2 ? ColorBytes{250, 240, 10, 255} : ColorBytes{10, 0, 90, 255}; });
  png("checks.png", checks);
  const TriangleMesh mesh = square("checks.png");
  EXPECT_LT(worst_on_square(mesh, checks), 240 / 2.0);
  EXPECT_GT(worst_on_square(square("none.png"), checks), 200);  // what this would say of a square without an image
  EXPECT_TRUE(mesh.has_colors);
}

TEST_F(Textures, AreFoundHoweverSmallWhatTheyShowIs) {
  const Texture dot = image(300, 200, [](int x, int y) { return x == 211 && y == 47 ? ColorBytes{255, 0, 0, 255} : ColorBytes{200, 200, 200, 255}; });
  png("dot.png", dot);
  const TriangleMesh mesh = square("dot.png");
  EXPECT_LT(worst_on_square(mesh, dot), 200 / 2.0);
  EXPECT_LT(mesh.triangles.size() / 3, 500U);  // cut where it is needed
}

TEST_F(Textures, ThatChangeGentlyAreSeenWithinTheirPromise) {
  const Texture waves = image(96, 80, [](int x, int y) {
    return ColorBytes{std::uint8_t(std::lround(128 + 120 * std::sin(0.3 * x))), std::uint8_t(2 * x), std::uint8_t(std::lround(128 + 100 * std::cos(0.2 * x + 0.1 * y))), 255};
  });
  png("waves.png", waves);
  const TriangleMesh mesh = square("-clamp on waves.png");
  EXPECT_LT(worst_on_square(mesh, waves), kPainted);
  EXPECT_LT(mesh.triangles.size() / 3, 2U * 96 * 80);  // fewer than two a texel
}

TEST_F(Textures, OfOneColorCutNothing) {
  png("even.png", image(512, 512, [](int, int) { return ColorBytes{12, 34, 56, 255}; }));
  const TriangleMesh mesh = square("even.png", 3);
  EXPECT_EQ(mesh.triangles.size(), 6U);
  EXPECT_THAT(colors_of(mesh), ElementsAre(ColorBytes{12, 34, 56, 255}));
}

TEST_F(Textures, TooFineForTheTrianglesThatThereMayBeAreHalved) {
  const Texture fine = noise(1024);
  png("noise.png", fine);
  const TriangleMesh mesh = square("noise.png");
  EXPECT_LE(mesh.triangles.size() / 3, kMostPaintTriangles + 2);
  EXPECT_LT(std::min(worst_on_square(mesh, fine.halved()), worst_on_square(mesh, fine.halved().halved())), kPainted);
}

TEST_F(Textures, RepeatMirrorOrEndAsTheirFileSays) {
  // The left half is black, the right one white.
  png("half.png", image(2, 1, [](int x, int) { return x == 0 ? ColorBytes{0, 0, 0, 255} : ColorBytes{255, 255, 255, 255}; }));
  const auto at = [](const TriangleMesh& mesh, float x) {
    const auto nearest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                                          [&](const auto& a, const auto& b) { return std::abs(a.position[0] - x) < std::abs(b.position[0] - x); });
    return int(nearest->color[0]);
  };
  const TriangleMesh repeated = square("half.png", 2), ends = square("-clamp on half.png", 2);
  EXPECT_LT(at(repeated, 0.125F), 70);
  EXPECT_GT(at(repeated, 0.375F), 185);
  EXPECT_LT(at(repeated, 0.625F), 70);
  EXPECT_EQ(at(ends, 0), 0);
  EXPECT_EQ(at(ends, 1), 255);
  EXPECT_GT(at(ends, 0.5F), 185);
}

TEST_F(Textures, BeyondTheirEdges) {
  Texture steps = image(3, 1, [](int x, int) { return ColorBytes{std::uint8_t(x), 0, 0, 255}; });
  const auto row = [&](TextureWrap wrap) {
    steps.wrap = {wrap, wrap};
    std::vector<int> values;
    for (int x = -4; x < 7; ++x) values.push_back(steps.beyond(x, -5)[0]);
    return values;
  };
  EXPECT_THAT(row(TextureWrap::repeat), ElementsAre(2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0));
  EXPECT_THAT(row(TextureWrap::mirror), ElementsAre(2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0));
  EXPECT_THAT(row(TextureWrap::clamp), ElementsAre(0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2));
}

TEST_F(Textures, ShowTheirMaterialWhereTheyAreClear) {
  png("clear.png", image(1, 1, [](int, int) { return ColorBytes{255, 255, 255, 0}; }));
  EXPECT_THAT(colors_of(square("clear.png", 1, "0 1 0")), ElementsAre(ColorBytes{0, 255, 0, 255}));
}

TEST_F(Textures, LeaveAClosedBodyClosed) {
  // Each side of a box has the whole image, so that coordinates on both sides of an edge are others.
  png("noise.png", noise(24));
  file("box.mtl", "newmtl m\nmap_Kd noise.png\n");
  std::string text = "mtllib box.mtl\nusemtl m\nvt 0 0\nvt 1 0.2\nvt 0.7 1\n";
  const Eigen::Vector3d lower(1, 2, 3), upper(2, 4, 6);
  for (const Triangle& t : box_triangles(lower, upper))
    text += "v " + numbers(t[0]) + "\nv " + numbers(t[1]) + "\nv " + numbers(t[2]) + "\nf -3/1 -2/2 -1/3\n";
  const TriangleMesh mesh = read_mesh(file("box.obj", text));
  EXPECT_GT(mesh.triangles.size() / 3, 1000U);
  EXPECT_EQ(open_edges(mesh), 0);
  EXPECT_NEAR(volume_of(mesh), 6, 1e-4);  // places are in single precision
  expect_sound_normals(mesh);

  TriangleMesh torn = mesh;
  torn.triangles.resize(torn.triangles.size() - 3);
  EXPECT_GT(open_edges(torn), 0);
}

TEST_F(Textures, WithCoordinatesThatAreNoneCountAsTheirMean) {
  png("half.png", 2, {255, 0, 0, 255, 0, 0, 0, 255});
  for (const double repeats : {1001.0, -5e8})
    EXPECT_THAT(colors_of(square("half.png", repeats)), ElementsAre(ColorBytes{188, 0, 0, 255})) << repeats;
  file("nan.mtl", "newmtl m\nmap_Kd half.png\n");
  const TriangleMesh mesh = read_mesh(file("nan.obj", "mtllib nan.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt nan nan\nvt inf 0\nvt 1 1\nf 1/1 2/2 3/3\n"));
  EXPECT_EQ(mesh.triangles.size(), 3U);
}

TEST_F(Textures, ThatRepeatAsOftenAsTheyMayEndInTime) {
  png("noise.png", noise(256));
  const TriangleMesh mesh = square("noise.png", kMostRepeats);
  EXPECT_LE(mesh.triangles.size() / 3, kMostPaintTriangles + 2);
}

TEST_F(Textures, CountAsTheirMeanWhereAMeshHasNoCoordinates) {
  const std::vector<Triangle> box = box_triangles({1, 2, 3}, {2, 4, 6});
  std::filesystem::create_directories(folder_ / "textures");
  // Half of the light of white is 188 in sRGB: ((0.5 ^ (1 / 2.4)) * 1.055 - 0.055) * 255.
  png("textures/half.png", 2, {255, 0, 0, 255, 0, 0, 0, 255});
  png("clear.png", 2, {0, 200, 0, 255, 255, 255, 255, 0});
  file("bad.png", "\x89PNG and nothing more");
  file("t.mtl",
       "newmtl a\nKd 0 0 1\nmap_Kd textures/half.png\nnewmtl b\nKd 0 0 1\nmap_Kd clear.png\n"
       "newmtl c\nKd 0 0 1\nmap_Kd none.png\nnewmtl d\nKd 0 0 1\nmap_Kd bad.png\n");
  const auto color = [&](const std::string& name) {
    return *colors_of(read_mesh(file(name + ".obj", obj(box, "mtllib t.mtl\nusemtl " + name + "\n"))))
                .begin();
  };
  EXPECT_THAT(color("a"), ElementsAre(188, 0, 0, 255));
  EXPECT_THAT(color("b"), ElementsAre(0, 200, 0, 255));
  EXPECT_THAT(color("c"), ElementsAre(0, 0, 255, 255));
  EXPECT_THAT(color("d"), ElementsAre(0, 0, 255, 255));

  Collada with;
  with.images =
      "<library_images><image id=\"i\"><init_from>textures/half.png</init_from></image></library_images>";
  with.params =
      "<newparam sid=\"s1\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam>"
      "<newparam sid=\"s2\"><sampler2D><source>s1</source></sampler2D></newparam>";
  with.effect = "<diffuse><texture texture=\"s2\" texcoord=\"UV\"/></diffuse>";
  EXPECT_THAT(colors_of(read_mesh(file("t.dae", collada(box, with)))),
              ElementsAre(std::array<std::uint8_t, 4>{188, 0, 0, 255}));
}

TEST_F(Textures, OfJpegAreReadToo) {
  // 16 x 16 pixels of one colour; what remains of it after compression is within 3 of 255.
  const std::vector<std::uint8_t> row = [] {
    std::vector<std::uint8_t> pixels;
    for (int x = 0; x < 16; ++x) pixels.insert(pixels.end(), {200, 100, 50});
    return pixels;
  }();
  std::FILE* out = std::fopen((folder_ / "t.jpg").c_str(), "wb");
  ASSERT_NE(out, nullptr);
  jpeg_compress_struct jpeg;
  jpeg_error_mgr trouble;
  jpeg.err = jpeg_std_error(&trouble);
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, out);
  jpeg.image_width = jpeg.image_height = 16;
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < 16; ++y) {
    JSAMPROW pixels = const_cast<JSAMPROW>(row.data());
    jpeg_write_scanlines(&jpeg, &pixels, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::fclose(out);

  const auto mean = read_mean_color((folder_ / "t.jpg").string());
  ASSERT_TRUE(mean);
  EXPECT_NEAR((*mean)[0], 200, 3);
  EXPECT_NEAR((*mean)[1], 100, 3);
  EXPECT_NEAR((*mean)[2], 50, 3);
  EXPECT_FALSE(read_mean_color(file("cut.jpg", "\xff\xd8\xff\xe0")));
  EXPECT_FALSE(read_mean_color((folder_ / "none.png").string()));
  EXPECT_FALSE(read_mean_color(folder_.string()));
}

}  // namespace
}  // namespace chainreel

// Triangles as samples of a tile: which of them they colour.
#include "render/tile_samples.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace chainreel {
namespace {

constexpr std::uint32_t kHalf = 0x80402010;

struct Resolved {
  std::vector<std::uint32_t> pixels = std::vector<std::uint32_t>(kTileCells * kTileCells);
  std::vector<std::uint64_t> bits = std::vector<std::uint64_t>(2 * kTileCells);

  explicit Resolved(const TileSamples& samples) { samples.resolve(1, pixels.data(), kTileCells, bits.data(), 1); }
};

void draw_clockwise(TileSamples& samples, const PageVertex& a, const PageVertex& b, const PageVertex& c, int left, int top, Fill fill) {
  const std::int64_t area = std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(c.x - a.x) * (b.y - a.y);
  if (area > 0) samples.draw(a, b, c, left, top, fill);
  if (area < 0) samples.draw(a, c, b, left, top, fill);
}

// Vertices of a lattice that reaches out of the tile, moved by less than what would fold it, also onto samples.
std::vector<PageVertex> lattice(int count, int apart, int first, std::mt19937& random) {
  std::uniform_int_distribution<int> move(-apart / 4, apart / 4);
  std::vector<PageVertex> vertices;
  for (int row = 0; row < count; ++row)
    for (int column = 0; column < count; ++column)
      vertices.push_back({first + column * apart + move(random), first + row * apart + move(random), 0, kHalf});
  return vertices;
}

// Where two triangles would both colour a sample it would be darker, where none does it would be empty.
TEST(TileSamples, TrianglesThatShareEdgesColourEachSampleOnce) {
  std::mt19937 random(7);
  for (const int apart : {20, 37, 64, 300, 5000, 60000}) {
    const int count = 2 * kTileUnits / apart + 6, left = 3 * kTileUnits, first = left - 2 * apart;
    const std::vector<PageVertex> at = lattice(count, apart, first, random);
    TileSamples samples;
    samples.clear();
    for (int row = 0; row + 1 < count; ++row)
      for (int column = 0; column + 1 < count; ++column) {
        const std::size_t i = std::size_t(row * count + column), below = i + std::size_t(count);
        draw_clockwise(samples, at[i], at[i + 1], at[below + 1], left, left, Fill::translucent);
        draw_clockwise(samples, at[i], at[below + 1], at[below], left, left, Fill::translucent);
      }
    const Resolved resolved(samples);
    for (const std::uint32_t pixel : resolved.pixels) ASSERT_EQ(pixel, kHalf) << "triangles of " << apart;
    for (const std::uint64_t word : resolved.bits) ASSERT_EQ(word, ~std::uint64_t(0)) << "triangles of " << apart;
  }
}

// Two planes that cross at the middle of the tile, in either order.
TEST(TileSamples, NearerTrianglesHideOthersSampleBySample) {
  constexpr int far = 4 * kTileUnits;
  constexpr std::uint32_t kOne = 0xff0000ff, kOther = 0xffff0000;
  const auto plane = [&](float slope, std::uint32_t color) {
    const float middle = kTileUnits / 2.0F;
    return std::array<PageVertex, 3>{PageVertex{-far, -far, slope * (-far - middle), color}, {3 * far, -far, slope * (3 * far - middle), color},
                                     {-far, 3 * far, slope * (-far - middle), color}};
  };
  for (const bool is_first : {false, true}) {
    TileSamples samples;
    samples.clear();
    for (const bool rises : {is_first, !is_first}) {
      const auto p = plane(rises ? 1e-3F : -1e-3F, rises ? kOne : kOther);
      samples.draw(p[0], p[1], p[2], 0, 0, Fill::nearest);
    }
    const Resolved resolved(samples);
    for (int y = 0; y < kTileCells; ++y)
      for (int x = 0; x < kTileCells; ++x)
        ASSERT_EQ(resolved.pixels[std::size_t(y * kTileCells + x)], x < kTileCells / 2 ? kOther : kOne) << x << " " << y;
  }
}

}  // namespace
}  // namespace chainreel

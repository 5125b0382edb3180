// Triangles as samples of a tile: which of them they colour.
#include "render/tile_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

// Small and large ones, slivers, before and behind one another, of one colour and of several, at tiles' edges, too.
TEST(TileSamples, AllWidthsOfVectorsGiveTheSameBytes) {
  std::mt19937 random(11);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::vector<TileSamples> tiles;
  for (const TileFiller filler : tile_fillers()) tiles.emplace_back(filler).clear();
  std::vector<std::uint32_t> colors;
  for (int k = 0; k < 4000; ++k) {
    const int size = std::array{20, 60, 130, 500, 3000, 40000}[std::size_t(number(0, 5))];
    const int x = number(-40, kTileUnits + 40), y = number(-40, kTileUnits + 40);
    const int wide = number(0, 3) == 0 ? size / 20 + 1 : size;
    std::array<PageVertex, 3> at;
    for (PageVertex& v : at) {
      const unsigned opacity = k % 3 == 2 ? unsigned(number(0, 255)) : 255;
      v = {kTileUnits + x + number(-wide, wide), 2 * kTileUnits + y + number(-size, size), float(number(-1000, 1000)) / 1000, opacity << 24};
      for (int shift = 0; shift < 24; shift += 8) v.color |= unsigned(number(0, int(opacity))) << shift;
    }
    if (number(0, 1) == 0) at[1].color = at[2].color = at[0].color;
    const Fill fill = std::array{Fill::nearest, Fill::nearest, Fill::translucent, Fill::flat}[std::size_t(k % 3 + (k % 50 == 0 && k % 3 == 2))];
    for (TileSamples& tile : tiles) draw_clockwise(tile, at[0], at[1], at[2], kTileUnits, 2 * kTileUnits, fill);
    if (k % 100 != 99) continue;
    const Resolved first(tiles.front());
    colors.insert(colors.end(), first.pixels.begin(), first.pixels.end());
    for (TileSamples& tile : tiles) {
      const Resolved resolved(tile);
      ASSERT_EQ(resolved.pixels, first.pixels) << k;
      ASSERT_EQ(resolved.bits, first.bits) << k;
      tile.clear();
    }
  }
  std::sort(colors.begin(), colors.end());
  EXPECT_GT(std::unique(colors.begin(), colors.end()) - colors.begin(), 1000);  // something was drawn
}

}  // namespace
}  // namespace chainreel

#include "render/tile_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "render/lanes.hpp"

namespace chainreel {
namespace {

// Of the four samples of a cell, in units.
constexpr int kNear = kCellUnits / 4, kFar = 3 * kCellUnits / 4;

// A side of a triangle: value(x, y) = start + dx x + dy y is not negative at samples that belong to the triangle's side of it. A
// sample on the line belongs to one of the two triangles that share it.
struct Edge {
  std::int64_t start = 0;
  std::int32_t dx = 0, dy = 0;

  Edge() = default;
  Edge(const PageVertex& from, const PageVertex& to, int left, int top) : dx(from.y - to.y), dy(to.x - from.x) {
    start = std::int64_t(dx) * (left - from.x) + std::int64_t(dy) * (top - from.y);
    if (!(dx > 0 || (dx == 0 && dy > 0))) --start;
  }
  // Whether no sample of the tile is inside; where all are the edge is forgotten.
  bool leaves_tile_out() {
    constexpr int first = kNear, last = kTileUnits - kNear;
    const std::int64_t low_x = std::int64_t(dx) * (dx < 0 ? last : first), low_y = std::int64_t(dy) * (dy < 0 ? last : first);
    const std::int64_t high_x = std::int64_t(dx) * (dx < 0 ? first : last), high_y = std::int64_t(dy) * (dy < 0 ? first : last);
    if (start + high_x + high_y < 0) return true;
    if (start + low_x + low_y >= 0) *this = {};
    return false;
  }
};

// A number that is linear on the page, at the tile's corner and per unit.
struct Plane {
  float start = 0, dx = 0, dy = 0;
};
struct Plane4 {
  Float4 start{}, dx{}, dy{};
};

// What a triangle colours in a tile: between which cells, and how.
struct TileTriangle {
  int first_column, last_column, first_row, last_row;  // cells that have samples in the triangle's range
  Plane depth;
  float nearest = 0, farthest = 0;
  Plane4 color;
  Float4 darkest{}, brightest{};
  std::uint32_t even = 0;

  TileTriangle(const PlaceRange& range, int left, int top)
      : first_column(first_cell(range.left - left)),
        last_column(last_cell(range.right - left)),
        first_row(first_cell(range.top - top)),
        last_row(last_cell(range.bottom - top)) {}

  // Whether all of it gets one colour.
  bool shade(const PageVertex& a, const PageVertex& b, const PageVertex& c, int left, int top, Fill fill, std::int32_t longest) {
    even = a.color;
    if (fill == Fill::flat) return true;
    const float abx = float(b.x - a.x), aby = float(b.y - a.y), acx = float(c.x - a.x), acy = float(c.y - a.y);
    const float inverse = 1 / float(std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(c.x - a.x) * (b.y - a.y));
    const float ab = b.depth - a.depth, ac = c.depth - a.depth;
    const float to_left = float(left - a.x), to_top = float(top - a.y);
    depth.dx = (ab * acy - ac * aby) * inverse;
    depth.dy = (ac * abx - ab * acx) * inverse;
    depth.start = a.depth + (depth.dx * to_left + depth.dy * to_top);
    nearest = std::max({a.depth, b.depth, c.depth});
    farthest = std::min({a.depth, b.depth, c.depth});
    if (a.color == b.color && a.color == c.color) return true;
    const Float4 at_a = unpacked(a.color), at_b = unpacked(b.color), at_c = unpacked(c.color);
    if (longest <= kCellUnits) {
      even = packed((at_a + at_b + at_c) * (1 / 3.0F) + 0.5F);
      return true;
    }
    color.dx = ((at_b - at_a) * acy - (at_c - at_a) * aby) * inverse;
    color.dy = ((at_c - at_a) * abx - (at_b - at_a) * acx) * inverse;
    // At the middle of a cell, which may lie outside of the triangle, but its colours are bounded by those of the corners.
    constexpr float kMiddle = kCellUnits / 2.0F;
    color.start = at_a + (color.dx * (to_left + kMiddle) + color.dy * (to_top + kMiddle));
    darkest = least(at_a, least(at_b, at_c));
    brightest = most(at_a, most(at_b, at_c));
    return false;
  }

 private:
  static int first_cell(int place) { return std::max(0, (place - kFar + kCellUnits - 1) >> 5); }
  static int last_cell(int place) { return std::min(kTileCells - 1, (place - kNear) >> 5); }
  static_assert(kCellUnits == 1 << 5);
};

// Where an edge crosses rows of cells, in columns: what lies beyond has no sample inside. It is widened by more than rounding takes.
class Crossing {
 public:
  Crossing() = default;
  explicit Crossing(const Edge& edge) : is_first_(edge.dx > 0) {
    if (edge.dx == 0) return;
    const float inverse = 1 / float(edge.dx);
    const std::int64_t at = edge.start + std::int64_t(edge.dy) * (edge.dy > 0 ? kFar : kNear) + std::int64_t(edge.dx) * (is_first_ ? kFar : kNear);
    slope_ = -float(edge.dy) * inverse;
    const float slack = 1e-3F + 1e-5F * std::abs(slope_);
    start_ = -float(at) * inverse / kCellUnits + (is_first_ ? 1 - slack : slack);
    is_there_ = true;
  }
  void narrow(int row, int& first, int& last) const {
    if (!is_there_) return;
    const int column = int(std::min(std::max(start_ + slope_ * float(row), -1.0F), float(kTileCells)));
    if (is_first_)
      first = std::max(first, column);
    else
      last = std::min(last, column);
  }

 private:
  float start_ = 0, slope_ = 0;
  bool is_there_ = false, is_first_ = false;
};

// What shines through `above`, each of the four bytes rounded.
std::uint32_t blended(std::uint32_t above, std::uint32_t below) {
  const std::uint32_t through = 255 - (above >> 24);
  std::uint32_t result = 0;
  for (int shift = 0; shift < 32; shift += 8) {
    const std::uint32_t level = (above >> shift & 255) + ((below >> shift & 255) * through + 127) / 255;
    result |= std::min(level, 255U) << shift;
  }
  return result;
}

}  // namespace

namespace tiles4 {
using Floats = Float4;
using Ints = Int4;
constexpr int kCells = 1;
constexpr Ints kSampleX = {kNear, kFar, kNear, kFar}, kSampleY = {kNear, kNear, kFar, kFar};
constexpr Ints kCellX = {};
inline Floats in_each_cell(Float4 four) { return four; }
inline unsigned any_of(Ints lanes) { return bits_of(lanes); }
inline Ints packed_in_each_cell(Floats colors) { return all4(std::int32_t(packed(colors))); }
#include "render/tile_fill.hpp"
}  // namespace tiles4

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx2")
namespace tiles8 {
using Floats [[gnu::vector_size(32)]] = float;
using Ints [[gnu::vector_size(32)]] = std::int32_t;
constexpr int kCells = 2;
constexpr Ints kSampleX = {kNear, kFar, kNear, kFar, kNear, kFar, kNear, kFar}, kSampleY = {kNear, kNear, kFar, kFar, kNear, kNear, kFar, kFar};
constexpr Ints kCellX = {0, 0, 0, 0, kCellUnits, kCellUnits, kCellUnits, kCellUnits};
inline Floats in_each_cell(Float4 four) { return Floats(_mm256_broadcast_ps(reinterpret_cast<const __m128*>(&four))); }
inline unsigned any_of(Ints lanes) { return unsigned(_mm256_movemask_ps(__m256(lanes))); }
inline Ints packed_in_each_cell(Floats colors) {
  const __m256i whole = _mm256_cvttps_epi32(__m256(colors));
  const __m256i words = _mm256_packs_epi32(whole, whole);
  return Ints(_mm256_shuffle_epi32(_mm256_packus_epi16(words, words), 0));
}
#include "render/tile_fill.hpp"
}  // namespace tiles8
#pragma GCC pop_options
#endif

std::span<const TileFiller> tile_fillers() {
#if defined(__x86_64__)
  static constexpr std::array<TileFiller, 2> kAll = {tiles8::draw_triangle, tiles4::draw_triangle};
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return std::span(kAll).subspan(has_avx2 ? 0 : 1);
#else
  static constexpr std::array<TileFiller, 1> kAll = {tiles4::draw_triangle};
  return kAll;
#endif
}

void TileSamples::clear() {
  samples_.depth.fill(std::numeric_limits<float>::lowest());
  samples_.color.fill(0);
}

namespace {

// The mean of samples, each byte rounded; `count` is 4 or 16.
template <int count>
std::uint32_t mean_of(const std::array<std::uint32_t, count>& samples) {
  // Two bytes apart, so that sums do not meet.
  std::uint64_t sum = 0;
  for (const std::uint32_t sample : samples) sum += (std::uint64_t(sample & 0xff00ff00U) << 24) | (sample & 0x00ff00ffU);
  const auto level = [sum](int shift) { return std::uint32_t((sum >> shift & 0xffff) + count / 2) / count; };
  return level(0) | level(32) << 8 | level(16) << 16 | level(48) << 24;
}

}  // namespace

void TileSamples::resolve(int per_pixel, std::uint32_t* pixels, std::ptrdiff_t pixel_stride, std::uint64_t* bits,
                          std::ptrdiff_t bit_stride) const {
  for (int row = 0; row < kTileCells; ++row) {
    std::uint64_t upper = 0, lower = 0;
    for (int column = 0; column < kTileCells; ++column) {
      const std::uint32_t* const samples = &samples_.color[std::size_t(4) * std::size_t(row * kTileCells + column)];
      const Int4 cell = load4<Int4>(samples);
      if (bits != nullptr) {
        const unsigned is_body = bits_of((cell & std::int32_t(0xff000000U)) != 0);
        upper |= std::uint64_t(is_body & 3) << (2 * column);
        lower |= std::uint64_t(is_body >> 2) << (2 * column);
      }
      if (per_pixel > 1) continue;
      const bool is_even = bits_of(cell == all4(cell[0])) == 15;
      pixels[row * pixel_stride + column] = is_even ? samples[0] : mean_of<4>({samples[0], samples[1], samples[2], samples[3]});
    }
    if (bits == nullptr) continue;
    bits[2 * row * bit_stride] = upper;
    bits[(2 * row + 1) * bit_stride] = lower;
  }
  if (per_pixel == 1) return;
  for (int y = 0; y < kTileCells / 2; ++y)
    for (int x = 0; x < kTileCells / 2; ++x) {
      std::array<std::uint32_t, 16> samples;
      for (std::size_t row = 0; row < 2; ++row)
        std::copy_n(&samples_.color[4 * (std::size_t(2 * y) + row) * kTileCells + std::size_t(8 * x)], 8, &samples[8 * row]);
      pixels[y * pixel_stride + x] = mean_of<16>(samples);
    }
}

}  // namespace chainreel

#include "render/tile_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/lanes.hpp"

namespace chainreel {
namespace {

// Of the four samples of a cell, in units.
constexpr int kNear = kCellUnits / 4, kFar = 3 * kCellUnits / 4;
constexpr Int4 kSampleX = {kNear, kFar, kNear, kFar}, kSampleY = {kNear, kNear, kFar, kFar};

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

}  // namespace

struct TileSamples::Triangle {
  int first_column, last_column, first_row, last_row;  // cells
  std::array<Edge, 3> edges;
  Plane depth;
  float nearest, farthest;
  Plane4 color;
  Float4 darkest, brightest;
  std::uint32_t even;
};

void TileSamples::clear() {
  depth_.fill(std::numeric_limits<float>::lowest());
  color_.fill(0);
}

namespace {

// The columns of a row of cells that an edge leaves, widened by what rounding may take.
void narrow(const Edge& edge, int row, float& first, float& last) {
  constexpr float kRounding = 1e-3F;
  if (edge.dx == 0) return;
  const float at = float(edge.start + std::int64_t(edge.dy) * (row * kCellUnits + (edge.dy > 0 ? kFar : kNear)) +
                         std::int64_t(edge.dx) * (edge.dx > 0 ? kFar : kNear));
  const float crossing = -at / (float(edge.dx) * kCellUnits);
  if (edge.dx > 0)
    first = std::max(first, crossing - kRounding);
  else
    last = std::min(last, crossing + kRounding);
}

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

template <Fill fill, bool is_even>
void TileSamples::fill_cells(const Triangle& t) {
  constexpr int kNarrowing = 4;  // columns: what finding out more of a row costs
  std::array<Int4, 3> offset, step;
  for (std::size_t i = 0; i < 3; ++i) {
    offset[i] = all4(t.edges[i].dx) * kSampleX + all4(t.edges[i].dy) * kSampleY;
    step[i] = all4(t.edges[i].dx * kCellUnits);
  }
  const Float4 depth_offset = all4(t.depth.dx) * __builtin_convertvector(kSampleX, Float4) +
                              all4(t.depth.dy) * __builtin_convertvector(kSampleY, Float4);
  const bool narrows = t.last_column - t.first_column >= kNarrowing;
  for (int row = t.first_row; row <= t.last_row; ++row) {
    int first = t.first_column, last = t.last_column;
    if (narrows) {
      float from = float(first), to = float(last);
      for (const Edge& edge : t.edges) narrow(edge, row, from, to);
      if (!(from <= to)) continue;
      first = int(std::ceil(from));
      last = int(std::floor(to));
    }
    const int y = row * kCellUnits;
    std::array<Int4, 3> value;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = t.edges[i];
      value[i] = offset[i] + all4(std::int32_t(edge.start + std::int64_t(edge.dx) * first * kCellUnits + std::int64_t(edge.dy) * y));
    }
    const Float4 row_depth = depth_offset + all4(t.depth.start + t.depth.dy * float(y));
    const Float4 row_color = t.color.start + t.color.dy * float(y);
    for (int column = first; column <= last; ++column) {
      const std::size_t cell = std::size_t(4) * std::size_t(row * kTileCells + column);
      Int4 wins = (value[0] | value[1] | value[2]) >= 0;
      for (std::size_t i = 0; i < 3; ++i) value[i] += step[i];
      std::uint32_t color = t.even;
      const float x = float(column * kCellUnits);
      if constexpr (fill == Fill::flat) {
        if (bits_of(wins) == 0) continue;
      } else {
        const Float4 depth = least(most(row_depth + all4(t.depth.dx * x), all4(t.farthest)), all4(t.nearest));
        const Float4 before = load4<Float4>(&depth_[cell]);
        wins &= depth > before;
        if (bits_of(wins) == 0) continue;
        if constexpr (fill == Fill::nearest) store4(&depth_[cell], wins ? depth : before);
        if constexpr (!is_even) color = packed(least(most(row_color + t.color.dx * x, t.darkest), t.brightest) + 0.5F);
      }
      if constexpr (fill == Fill::translucent) {
        const unsigned bits = bits_of(wins);
        for (std::size_t k = 0; k < 4; ++k)
          if (bits >> k & 1) color_[cell + k] = blended(color, color_[cell + k]);
      } else {
        store4(&color_[cell], wins ? all4(std::int32_t(color)) : load4<Int4>(&color_[cell]));
      }
    }
  }
}

void TileSamples::draw(const PageVertex& a, const PageVertex& b, const PageVertex& c, int left, int top, Fill fill) {
  // The cells that have samples between the first and the last place.
  const auto first_cell = [](int place) { return std::max(0, (place - kFar + kCellUnits - 1) >> 5); };
  const auto last_cell = [](int place) { return std::min(kTileCells - 1, (place - kNear) >> 5); };
  static_assert(kCellUnits == 1 << 5);
  const PlaceRange range(a, b, c);
  const int first_column = first_cell(range.left - left), last_column = last_cell(range.right - left);
  const int first_row = first_cell(range.top - top), last_row = last_cell(range.bottom - top);
  if (first_column > last_column || first_row > last_row) return;
  Triangle t;
  t.first_column = first_column, t.last_column = last_column, t.first_row = first_row, t.last_row = last_row;
  t.edges = {Edge(a, b, left, top), Edge(b, c, left, top), Edge(c, a, left, top)};
  t.even = a.color;
  if (range.longest() > kTileUnits)
    for (Edge& edge : t.edges)
      if (edge.leaves_tile_out()) return;
  if (fill == Fill::flat) return fill_cells<Fill::flat, true>(t);

  const float abx = float(b.x - a.x), aby = float(b.y - a.y), acx = float(c.x - a.x), acy = float(c.y - a.y);
  const float inverse = 1 / float(std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(c.x - a.x) * (b.y - a.y));
  const float ab = b.depth - a.depth, ac = c.depth - a.depth;
  const float to_left = float(left - a.x), to_top = float(top - a.y);
  t.depth.dx = (ab * acy - ac * aby) * inverse;
  t.depth.dy = (ac * abx - ab * acx) * inverse;
  t.depth.start = a.depth + (t.depth.dx * to_left + t.depth.dy * to_top);
  t.nearest = std::max({a.depth, b.depth, c.depth});
  t.farthest = std::min({a.depth, b.depth, c.depth});
  bool is_even = a.color == b.color && a.color == c.color;
  if (!is_even) {
    const Float4 at_a = unpacked(a.color), at_b = unpacked(b.color), at_c = unpacked(c.color);
    if (range.longest() <= kCellUnits) {
      t.even = packed((at_a + at_b + at_c) * (1 / 3.0F) + 0.5F);
      is_even = true;
    } else {
      t.color.dx = ((at_b - at_a) * acy - (at_c - at_a) * aby) * inverse;
      t.color.dy = ((at_c - at_a) * abx - (at_b - at_a) * acx) * inverse;
      // At the middle of a cell, which may lie outside of the triangle, but its colours are bounded by those of the corners.
      constexpr float kMiddle = kCellUnits / 2.0F;
      t.color.start = at_a + (t.color.dx * (to_left + kMiddle) + t.color.dy * (to_top + kMiddle));
      t.darkest = least(at_a, least(at_b, at_c));
      t.brightest = most(at_a, most(at_b, at_c));
    }
  }
  if (fill == Fill::nearest)
    is_even ? fill_cells<Fill::nearest, true>(t) : fill_cells<Fill::nearest, false>(t);
  else
    is_even ? fill_cells<Fill::translucent, true>(t) : fill_cells<Fill::translucent, false>(t);
}

void TileSamples::resolve(int per_pixel, std::uint32_t* pixels, std::ptrdiff_t pixel_stride, std::uint64_t* bits,
                          std::ptrdiff_t bit_stride) const {
  const std::uint32_t count = 4 * std::uint32_t(per_pixel * per_pixel);
  const int side = kTileCells / per_pixel;
  for (int row = 0; row < kTileCells; ++row) {
    std::uint64_t upper = 0, lower = 0;
    for (int column = 0; column < kTileCells; ++column) {
      const Int4 cell = load4<Int4>(&color_[std::size_t(4) * std::size_t(row * kTileCells + column)]);
      const unsigned is_body = bits_of((cell & std::int32_t(0xff000000U)) != 0);
      upper |= std::uint64_t(is_body & 3) << (2 * column);
      lower |= std::uint64_t(is_body >> 2) << (2 * column);
    }
    bits[2 * row * bit_stride] = upper;
    bits[(2 * row + 1) * bit_stride] = lower;
  }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      // Two bytes apart, so that sums of 16 samples do not meet.
      std::uint64_t sum = 0;
      std::uint32_t one = 0;
      bool is_even = true;
      for (int row = per_pixel * y; row < per_pixel * (y + 1); ++row)
        for (int k = 0; k < 4 * per_pixel; ++k) {
          const std::uint32_t sample = color_[std::size_t(4) * std::size_t(row * kTileCells + per_pixel * x) + std::size_t(k)];
          if (k == 0 && row == per_pixel * y) one = sample;
          is_even = is_even && sample == one;
          sum += (std::uint64_t(sample & 0xff00ff00U) << 24) | (sample & 0x00ff00ffU);
        }
      std::uint32_t mean = one;
      if (!is_even) {
        mean = 0;
        const auto level = [&](int shift) { return std::uint32_t((sum >> shift & 0xffff) + count / 2) / count; };
        mean = level(0) | level(32) << 8 | level(16) << 16 | level(48) << 24;
      }
      pixels[y * pixel_stride + x] = mean;
    }
}

}  // namespace chainreel

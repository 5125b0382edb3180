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
  const Float4 depth_dx = all4(t.depth.dx);
  const bool narrows = t.last_column - t.first_column >= kNarrowing;
  std::array<Crossing, 3> crossings;
  if (narrows)
    for (std::size_t i = 0; i < 3; ++i) crossings[i] = Crossing(t.edges[i]);
  for (int row = t.first_row; row <= t.last_row; ++row) {
    int first = t.first_column, last = t.last_column;
    if (narrows) {
      for (const Crossing& crossing : crossings) crossing.narrow(row, first, last);
      if (first > last) continue;
    }
    const int y = row * kCellUnits;
    std::array<Int4, 3> value;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = t.edges[i];
      value[i] = offset[i] + all4(std::int32_t(edge.start + std::int64_t(edge.dx) * first * kCellUnits + std::int64_t(edge.dy) * y));
    }
    const Float4 row_depth = depth_offset + all4(t.depth.start + t.depth.dy * float(y));
    const Float4 row_color = t.color.start + t.color.dy * float(y);
    Float4 x = all4(float(first * kCellUnits));
    for (int column = first; column <= last; ++column, x += float(kCellUnits)) {
      const std::size_t cell = std::size_t(4) * std::size_t(row * kTileCells + column);
      Int4 wins = (value[0] | value[1] | value[2]) >= 0;
      for (std::size_t i = 0; i < 3; ++i) value[i] += step[i];
      std::uint32_t color = t.even;
      if constexpr (fill == Fill::flat) {
        if (bits_of(wins) == 0) continue;
      } else {
        const Float4 depth = least(most(row_depth + depth_dx * x, all4(t.farthest)), all4(t.nearest));
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
      const std::uint32_t* const samples = &color_[std::size_t(4) * std::size_t(row * kTileCells + column)];
      const Int4 cell = load4<Int4>(samples);
      const unsigned is_body = bits_of((cell & std::int32_t(0xff000000U)) != 0);
      upper |= std::uint64_t(is_body & 3) << (2 * column);
      lower |= std::uint64_t(is_body >> 2) << (2 * column);
      if (per_pixel > 1) continue;
      const bool is_even = bits_of(cell == all4(cell[0])) == 15;
      pixels[row * pixel_stride + column] = is_even ? samples[0] : mean_of<4>({samples[0], samples[1], samples[2], samples[3]});
    }
    bits[2 * row * bit_stride] = upper;
    bits[(2 * row + 1) * bit_stride] = lower;
  }
  if (per_pixel == 1) return;
  for (int y = 0; y < kTileCells / 2; ++y)
    for (int x = 0; x < kTileCells / 2; ++x) {
      std::array<std::uint32_t, 16> samples;
      for (std::size_t row = 0; row < 2; ++row)
        std::copy_n(&color_[4 * (std::size_t(2 * y) + row) * kTileCells + std::size_t(8 * x)], 8, &samples[8 * row]);
      pixels[y * pixel_stride + x] = mean_of<16>(samples);
    }
}

}  // namespace chainreel

// Triangles to samples: a tile of the page at a time, small enough to stay in the processor's nearest memory. Places are whole
// numbers, so that triangles which share an edge leave no gap and no sample between them to both, and what is drawn in a tile
// depends on nothing but the triangles that meet it. Needs no OpenGL.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace chainreel {

// Samples lie in fours: a cell has them at a quarter and three quarters of its sides.
inline constexpr int kCellUnits = 32;  // of places along a cell's side
inline constexpr int kTileCells = 32;  // along a tile's side, so that a row of its samples is one word of 64 bits
inline constexpr int kTileUnits = kTileCells * kCellUnits;
// Places lie from -kGuardCells to kLongestPage + kGuardCells, so that what they say of a tile fits 32 bits.
inline constexpr int kLongestPage = 1 << 14, kGuardCells = 1 << 12;  // cells

struct alignas(16) PageVertex {
  std::int32_t x = 0, y = 0;  // from the page's upper left corner, in units of a cell; y down
  float depth = 0;            // towards the viewer; planes on the page
  std::uint32_t color = 0;    // blue, green, red, opacity from the lowest byte on, premultiplied
};

// What a triangle spans, in units of a cell, both ends included.
struct PlaceRange {
  std::int32_t left, top, right, bottom;

  PlaceRange(const PageVertex& a, const PageVertex& b, const PageVertex& c)
      : left(std::min(std::min(a.x, b.x), c.x)),
        top(std::min(std::min(a.y, b.y), c.y)),
        right(std::max(std::max(a.x, b.x), c.x)),
        bottom(std::max(std::max(a.y, b.y), c.y)) {}
  std::int32_t longest() const { return std::max(right - left, bottom - top); }
  // Whether there are samples between both ends, which need not be inside of the triangle.
  bool has_samples() const { return next_sample(left) <= right && next_sample(top) <= bottom; }

 private:
  static std::int32_t next_sample(std::int32_t place) {
    constexpr std::int32_t apart = kCellUnits / 2;
    return ((place + apart / 2 - 1) & -apart) + apart / 2;
  }
};

// How triangles are put down.
enum class Fill {
  nearest,      // hides what lies behind
  translucent,  // lets what lies behind shine through
  flat          // one colour, without depth
};

// A tile's samples: four a cell, cell by cell and row by row.
struct TileArrays {
  static constexpr std::size_t kCount = 4 * kTileCells * kTileCells;
  alignas(32) std::array<float, kCount> depth;
  alignas(32) std::array<std::uint32_t, kCount> color;
};

// Draws a triangle that runs clockwise, as one sees it. `left`, `top`: the tile's corner, in units of a cell.
using TileFiller = void (*)(const PageVertex& a, const PageVertex& b, const PageVertex& c, int left, int top, Fill fill, TileArrays& samples);

// Those that this processor has, with the same bytes, the fastest first.
std::span<const TileFiller> tile_fillers();

class TileSamples {
 public:
  explicit TileSamples(TileFiller filler = tile_fillers().front()) : filler_(filler) {}

  void clear();

  // As a TileFiller does.
  void draw(const PageVertex& a, const PageVertex& b, const PageVertex& c, int left, int top, Fill fill) {
    filler_(a, b, c, left, top, fill, samples_);
  }

  // The means of each `per_pixel` x `per_pixel` cells, which is 1 or 2, into rows of pixels, and of each row of samples a word with a bit for each
  // that shows a body, if `bits` is not null.
  void resolve(int per_pixel, std::uint32_t* pixels, std::ptrdiff_t pixel_stride, std::uint64_t* bits,
               std::ptrdiff_t bit_stride) const;

 private:
  TileFiller filler_;
  TileArrays samples_;
};

}  // namespace chainreel

// A set of tiles of the page: where something is drawn, and where a frame differs from the one before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/pixel_box.hpp"

namespace chainreel {

// Which tiles a box of pixels meets: columns and rows, the last ones outside.
struct TileRange {
  int left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const TileRange&, const TileRange&) = default;
};

class TileMask {
 public:
  static constexpr int kSide = 32;  // px

  TileMask(int width, int height);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool at(int column, int row) const { return marked_[place(column, row)] != 0; }
  void mark(int column, int row) { marked_[place(column, row)] = 1; }
  void unmark(int column, int row) { marked_[place(column, row)] = 0; }

  void clear();
  void fill();
  void add(const TileMask& other);   // of the same page
  void keep(const TileMask& other);  // those that the other has, too

  // The tiles that meet the box, which may reach out of the page.
  TileRange tiles_of(const PixelBox& box) const;

  // The pixels of a tile; at the page's right and lower side they may reach out of it.
  static PixelBox pixels_of(int column, int row) { return {column * kSide, row * kSide, kSide, kSide}; }

  // The marked tiles inside `clip` as boxes that do not overlap: neighbours in a row are one box, and so are rows
  // that are alike.
  void boxes(const PixelBox& clip, std::vector<PixelBox>& result) const;

 private:
  std::size_t place(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }

  int columns_, rows_;
  std::vector<std::uint8_t> marked_;
};

// Boxes that come row by row: one that continues a box of the row above is joined with it.
class BoxJoiner {
 public:
  explicit BoxJoiner(std::vector<PixelBox>& boxes) : boxes_(boxes) {}
  void add(const PixelBox& box);

 private:
  std::vector<PixelBox>& boxes_;
  int row_ = 0;                            // where the boxes that come now begin
  std::vector<std::size_t> above_, here_;  // which boxes end there, and which are of this row
};

}  // namespace chainreel

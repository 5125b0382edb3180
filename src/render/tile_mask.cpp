#include "render/tile_mask.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chainreel {

TileMask::TileMask(int width, int height)
    : columns_((width + kSide - 1) / kSide),
      rows_((height + kSide - 1) / kSide),
      marked_(std::size_t(columns_) * std::size_t(rows_)) {}

void TileMask::clear() {
  std::fill(marked_.begin(), marked_.end(), std::uint8_t(0));
}

void TileMask::mark_segment(double ax, double ay, double bx, double by, double reach) {
  const auto tile = [](double px, int count) {
    return int(std::clamp(std::floor(px / kSide), 0.0, double(count - 1)));
  };
  const int first_column = tile(std::min(ax, bx) - reach, columns_),
            last_column = tile(std::max(ax, bx) + reach, columns_);
  const int first_row = tile(std::min(ay, by) - reach, rows_),
            last_row = tile(std::max(ay, by) + reach, rows_);

  const double along_x = bx - ax, along_y = by - ay;
  const double square = along_x * along_x + along_y * along_y;
  const double farthest = reach + kSide * std::numbers::sqrt2 / 2;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const double x = (column + 0.5) * kSide - ax, y = (row + 0.5) * kSide - ay;
      const double t = square > 0 ? std::clamp((x * along_x + y * along_y) / square, 0.0, 1.0) : 0;
      const double beside_x = x - t * along_x, beside_y = y - t * along_y;
      if (beside_x * beside_x + beside_y * beside_y <= farthest * farthest)
        marked_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)] = 1;
    }
  }
}

void TileMask::mark_box(double left, double top, double right, double bottom) {
  if (!(right > 0 && bottom > 0 && left < kSide * columns_ && top < kSide * rows_)) return;
  const auto tile = [](double px, int count) {
    return std::size_t(std::clamp(std::floor(px / kSide), 0.0, double(count - 1)));
  };
  const std::size_t first = tile(left, columns_), last = tile(right, columns_);
  for (std::size_t row = tile(top, rows_); row <= tile(bottom, rows_); ++row)
    for (std::size_t column = first; column <= last; ++column) marked_[row * std::size_t(columns_) + column] = 1;
}

void TileMask::boxes(const PixelBox& clip, std::vector<PixelBox>& result) const {
  result.clear();
  for (int row = clip.top / kSide; row < rows_ && row * kSide < clip.bottom; ++row) {
    const std::uint8_t* tiles = marked_.data() + std::size_t(row) * std::size_t(columns_);
    for (int column = 0; column < columns_; ++column) {
      if (tiles[column] == 0) continue;
      int end = column + 1;
      while (end < columns_ && tiles[end] != 0) ++end;
      const PixelBox box = {std::max(column * kSide, clip.left), std::max(row * kSide, clip.top),
                            std::min(end * kSide, clip.right), std::min((row + 1) * kSide, clip.bottom)};
      if (!box.empty()) result.push_back(box);
      column = end;
    }
  }
}

}  // namespace chainreel

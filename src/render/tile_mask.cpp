#include "render/tile_mask.hpp"

#include <algorithm>

namespace chainreel {

TileMask::TileMask(int width, int height)
    : columns_((width + kSide - 1) / kSide),
      rows_((height + kSide - 1) / kSide),
      marked_(std::size_t(columns_) * std::size_t(rows_)) {}

void TileMask::clear() {
  std::fill(marked_.begin(), marked_.end(), std::uint8_t(0));
}

void TileMask::fill() {
  std::fill(marked_.begin(), marked_.end(), std::uint8_t(1));
}

void TileMask::add(const TileMask& other) {
  for (std::size_t i = 0; i < marked_.size(); ++i) marked_[i] |= other.marked_[i];
}

void TileMask::keep(const TileMask& other) {
  for (std::size_t i = 0; i < marked_.size(); ++i) marked_[i] &= other.marked_[i];
}

TileRange TileMask::tiles_of(const PixelBox& box) const {
  if (box.empty()) return {};
  const auto first = [](int pixel, int count) { return pixel <= 0 ? 0 : std::min(pixel / kSide, count); };
  const auto last = [](int pixel, int count) { return pixel <= 0 ? 0 : std::min((pixel - 1) / kSide + 1, count); };
  return {first(box.x, columns_), first(box.y, rows_), last(box.right(), columns_), last(box.bottom(), rows_)};
}

void TileMask::boxes(const PixelBox& clip, std::vector<PixelBox>& result) const {
  result.clear();
  BoxJoiner joiner(result);
  const TileRange tiles = tiles_of(clip);
  for (int row = tiles.top; row < tiles.bottom; ++row)
    for (int column = tiles.left; column < tiles.right; ++column) {
      if (!at(column, row)) continue;
      int end = column + 1;
      while (end < tiles.right && at(end, row)) ++end;
      joiner.add(common_part(clip, {column * kSide, row * kSide, (end - column) * kSide, kSide}));
      column = end;
    }
}

void BoxJoiner::add(const PixelBox& box) {
  if (box.empty()) return;
  if (box.y != row_ || here_.empty()) {
    std::swap(above_, here_);
    here_.clear();
    row_ = box.y;
  }
  for (const std::size_t i : above_) {
    PixelBox& other = boxes_[i];
    if (other.x != box.x || other.width != box.width || other.bottom() != box.y) continue;
    other.height += box.height;
    here_.push_back(i);
    return;
  }
  here_.push_back(boxes_.size());
  boxes_.push_back(box);
}

}  // namespace chainreel

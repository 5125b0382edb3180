// Where two pictures of one page differ, told by their pieces without drawing them.
#pragma once

#include <algorithm>
#include <functional>

#include "render/batch.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

// Calls visit(column, row, whether all of it is inside of the shape) for the tiles that a shape may colour.
template <class Visit>
void for_each_tile(const Piece& piece, const float* numbers, const TileMask& page, const Visit& visit) {
  constexpr int kTile = TileMask::kSide;
  const PixelBox& box = piece.outline.box;
  for (int row = box.y / kTile; row * kTile < box.bottom(); ++row) {
    const int top = std::max(box.y, row * kTile), bottom = std::min(box.bottom(), (row + 1) * kTile);
    const Spans spans = piece.outline.spans(top, bottom, numbers);
    if (spans.empty()) continue;
    for (int column = spans.left / kTile; column * kTile < spans.right && column < page.columns(); ++column)
      visit(column, row,
            bottom - top == kTile && spans.inner_left <= column * kTile && spans.inner_right >= (column + 1) * kTile);
  }
}

// Marks the tiles that bodies may touch.
using TouchSolids = std::function<void(const Piece& piece, TileMask& tiles)>;

// Adds every tile that may look different: where a piece is that the other does not have, or has in another order.
// Bodies are asked for where they are, those of `before` and those of `now`.
void mark_changes(const Batch& before, const Batch& now, const TouchSolids& touch_before,
                  const TouchSolids& touch_now, TileMask& changed);

}  // namespace chainreel

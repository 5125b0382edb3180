// Where two pictures of one page differ, told by their pieces without drawing them.
#pragma once

#include <functional>

#include "render/batch.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

// Marks the tiles that bodies may touch.
using TouchSolids = std::function<void(const Piece& piece, TileMask& tiles)>;

// Adds every tile that may look different: where a piece is that the other does not have, or has in another order.
// Bodies are asked for where they are, those of `before` and those of `now`.
void mark_changes(const Batch& before, const Batch& now, const TouchSolids& touch_before,
                  const TouchSolids& touch_now, TileMask& changed);

}  // namespace chainreel

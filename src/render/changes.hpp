// Where two pictures of one page differ, told by their pieces without drawing them.
#pragma once

#include <functional>

#include "render/batch.hpp"
#include "render/tile_mask.hpp"

namespace chainreel {

// Marks the tiles in which two groups of bodies may differ; null stands for none.
using MarkSolids = std::function<void(const Piece* before, const Piece* now, TileMask& tiles)>;

// Adds every tile that may look different: where a piece is that the other does not have, or has in another order.
void mark_changes(const Batch& before, const Batch& now, const MarkSolids& mark_solids, TileMask& changed);

}  // namespace chainreel

// Which of a frame's blocks of 16x16 pixels are as in the frame before, by comparing what changed boxes touch: it hangs on
// pixels alone, never on how finely somebody told the boxes. Internal to this floor.
#pragma once

#include <cstdint>
#include <vector>

#include "core/pixel_box.hpp"
#include "encode/yuv.hpp"

namespace chainreel {

class StillBlocks {
 public:
  // A number other than 0 of each block that is as it was, row by row.
  using Flags = std::vector<std::uint8_t>;

  StillBlocks(int width, int height);

  // Before the boxes of the frame in `planes` are drawn anew: keeps what they show.
  void keep(const PlanesYuv420& planes, const std::vector<PixelBox>& boxes);
  // Behind it. Of frames whose neighbour is not known nothing is still: then neither is called and flags are empty.
  Flags& compare(const PlanesYuv420& planes);

 private:
  struct Block {
    int x, y;  // of its first pixel
  };
  template <class Row>
  void for_rows(const PlanesYuv420& planes, const Block& block, Row row) const;

  int width_, height_, columns_;
  Flags flags_;
  std::vector<Block> touched_;
  std::vector<std::uint8_t> kept_;
};

}  // namespace chainreel

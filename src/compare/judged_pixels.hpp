// What is thought of each pixel of a pair of pictures: what `compare_images` counts and `difference_picture`
// shows.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/compare_images.hpp"

namespace chainreel {

// Of the pixels of one part of the pictures, row by row of it.
struct JudgedTile {
  enum Kind : std::uint8_t { equal, masked, at_edge, other };
  PixelBox box;
  std::vector<Kind> kinds;    // empty where no pixel differs
  std::vector<float> errors;  // empty where all are 0

  // At a place in the box, where kinds are not empty.
  Kind& kind(int x, int y) { return kinds[std::size_t(y) * std::size_t(box.width) + std::size_t(x)]; }
  Kind kind(int x, int y) const { return kinds[std::size_t(y) * std::size_t(box.width) + std::size_t(x)]; }
};

struct JudgedPixels {
  std::vector<JudgedTile> tiles;  // the whole of both pictures; none where they are equal

  // The pictures are of one size.
  JudgedPixels(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
               const Envelope* envelope);
};

}  // namespace chainreel

// What is thought of each pixel of a pair of pictures: what `compare_images` counts and `difference_picture`
// shows.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/compare_images.hpp"

namespace chainreel {

struct JudgedPixels {
  enum Kind : std::uint8_t { equal, masked, at_edge, other };
  std::vector<Kind> kinds;    // empty where no pixel differs
  std::vector<float> errors;  // of each pixel; empty where no pixel is of kind `other`

  // The pictures are of one size.
  JudgedPixels(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
               const Envelope* envelope);
};

}  // namespace chainreel

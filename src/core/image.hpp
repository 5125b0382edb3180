// Pixels in memory: 8-bit BGRA, premultiplied by nothing (alpha is straight), top row first, no padding.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/large_memory.hpp"

namespace chainreel {

struct Pixel {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

// A pixel's bytes whose colour is multiplied by its alpha, as blending needs it: divided by it again, rounded.
inline void divide_by_alpha(std::uint8_t* bgra) {
  const int alpha = bgra[3];
  if (alpha == 0 || alpha == 255) return;
  for (int k = 0; k < 3; ++k) bgra[k] = std::uint8_t(std::min(255, (255 * bgra[k] + alpha / 2) / alpha));
}

struct Image {
  int width = 0;
  int height = 0;
  PixelBytes bgra;  // 4 * width * height bytes

  Image() = default;
  Image(int w, int h) : width(w), height(h), bgra(std::size_t(4) * std::size_t(w) * std::size_t(h)) {}

  Pixel at(int x, int y) const {  // x to the right, y down from the top row
    const std::uint8_t* p = &bgra[std::size_t(4) * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
    return {p[2], p[1], p[0], p[3]};
  }

  bool is_opaque() const {
    for (std::size_t i = 3; i < bgra.size(); i += 4)
      if (bgra[i] != 255) return false;
    return true;
  }
};

}  // namespace chainreel

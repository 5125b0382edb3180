// Pixels in memory: 8-bit BGRA, premultiplied by nothing (alpha is straight), top row first, no padding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace chainreel {

struct Pixel {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bgra;  // 4 * width * height bytes

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

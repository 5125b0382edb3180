// Pictures of one colour, and single pixels of them.
#pragma once

#include <cstdint>

#include "core/image.hpp"

namespace chainreel {

inline void set_pixel(Image& image, int x, int y, Pixel p) {
  std::uint8_t* bytes =
      &image.bgra[std::size_t(4) * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
  bytes[0] = p.b;
  bytes[1] = p.g;
  bytes[2] = p.r;
  bytes[3] = p.a;
}

inline Image flat_picture(int width, int height, Pixel color) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set_pixel(image, x, y, color);
  return image;
}

}  // namespace chainreel

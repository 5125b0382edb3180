// Pictures made by rule, for the tests of what writes them.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "core/image.hpp"
#include "support/flat_picture.hpp"

namespace chainreel {

inline Pixel pixel_of(unsigned rgb) {
  return {std::uint8_t(rgb >> 16), std::uint8_t(rgb >> 8 & 255), std::uint8_t(rgb & 255), 255};
}

inline Image random_picture(int width, int height, unsigned seed) {
  Image image(width, height);
  std::mt19937 random(seed);
  for (std::uint8_t& byte : image.bgra) byte = static_cast<std::uint8_t>(random() & 255);
  return image;
}

// A blue disc that goes round on white: frame `k` of a film.
inline Image disc_picture(int width, int height, int k) {
  Image image = flat_picture(width, height, pixel_of(0xFFFFFF));
  const double angle = 0.1 * k;
  const double cx = width * (0.5 + 0.25 * std::cos(angle)), cy = height * (0.5 + 0.25 * std::sin(angle));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (std::hypot(x + 0.5 - cx, y + 0.5 - cy) < 0.15 * height) set_pixel(image, x, y, pixel_of(0x56B4E9));
  return image;
}

}  // namespace chainreel

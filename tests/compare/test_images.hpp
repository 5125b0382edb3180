// Small pictures to compare.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "core/image.hpp"
#include "support/flat_picture.hpp"

namespace chainreel {

inline Image noise(int width, int height, unsigned seed) {
  Image image(width, height);
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < image.bgra.size(); ++i)
    image.bgra[i] = i % 4 == 3 ? 255 : std::uint8_t(random() >> 24);
  return image;
}

// What covers a pixel by so much: dark on light.
inline Image drawn(int width, int height, auto&& coverage) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double c = std::clamp(coverage(x + 0.5, y + 0.5), 0.0, 1.0);
      const auto value = [&](double paper, double ink) {
        return std::uint8_t(std::lround(paper + (ink - paper) * c));
      };
      set_pixel(image, x, y, {value(250, 20), value(248, 60), value(240, 120), 255});
    }
  return image;
}

// A stroke along a circle, anti-aliased by its distance as the canvas does it.
inline Image ring(double x, double y, double radius, double stroke, int size = 48) {
  return drawn(size, size, [=](double px, double py) {
    const double distance = std::abs(std::hypot(px - x, py - y) - radius);
    return std::min(1.0, stroke) * std::clamp(0.5 + std::max(stroke, 1.0) / 2 - distance, 0.0, 1.0);
  });
}

}  // namespace chainreel

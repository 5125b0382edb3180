#include "draw/charts/lit_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr double kLikeColours = 0.139;  // in Oklab: nearer ones are taken for one, as two greens

// Lightness and the two opponent colours of Oklab (B. Ottosson, A perceptual color space for image processing, 2020).
std::array<double, 3> oklab(Color color) {
  const auto linear = [](std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double r = linear(color.r), g = linear(color.g), b = linear(color.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double difference(int look, int other) {
  const auto a = oklab(curve_style(look, light_theme()).color), b = oklab(curve_style(other, light_theme()).color);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

void tell_colours_apart(std::span<int* const> looks) {
  std::vector<int> taken;
  const auto nearest = [&](int look) {
    double least = std::numeric_limits<double>::infinity();
    for (const int other : taken) least = std::min(least, difference(look, other));
    return least;
  };
  for (int* const look : looks) {
    if (nearest(*look) < kLikeColours)
      for (int other = 0; other < kCurveLooks; ++other)
        if (nearest(other) > nearest(*look)) *look = other;
    taken.push_back(*look);
  }
}

}  // namespace chainreel

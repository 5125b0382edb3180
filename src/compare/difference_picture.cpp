#include <algorithm>
#include <array>
#include <cmath>

#include "compare/compare_images.hpp"
#include "compare/judged_pixels.hpp"

namespace chainreel {
namespace {

using Color = std::array<double, 3>;  // r g b, 0 to 255

// Magma (N. Smith, S. van der Walt, CC0) at 0, 1/4, .. 1.
constexpr Color kMagma[5] = {{0, 0, 4}, {81, 18, 124}, {183, 55, 121}, {252, 137, 97}, {252, 253, 191}};
constexpr Color kAtEdge = {150, 200, 235};

Color mix(const Color& a, const Color& b, double share_of_b) {
  Color mixed;
  for (int i = 0; i < 3; ++i) mixed[i] = a[i] + (b[i] - a[i]) * share_of_b;
  return mixed;
}

// From orange where the error is none to near black where it is 1: the paper is light.
Color color_of_error(double error) {
  const double at = 0.8 - 0.75 * std::clamp(error, 0.0, 1.0);
  const int piece = std::min(int(4 * at), 3);
  return mix(kMagma[piece], kMagma[piece + 1], 4 * at - piece);
}

Color pale_grey(const std::uint8_t* bgra) {
  const double alpha = bgra[3] / 255.0;
  const double grey = alpha * (0.299 * bgra[2] + 0.587 * bgra[1] + 0.114 * bgra[0]) + (1 - alpha) * 255;
  const double pale = 255 - 0.3 * (255 - grey);
  return {pale, pale, pale};
}

bool is_masked(const std::vector<PixelBox>& masks, int x, int y) {
  return std::any_of(masks.begin(), masks.end(), [&](const PixelBox& m) {
    return x >= m.x && y >= m.y && x < long(m.x) + m.width && y < long(m.y) + m.height;
  });
}

}  // namespace

Image difference_picture(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                         const Envelope* envelope) {
  if (expected.width != actual.width || expected.height != actual.height) return {};
  Image picture(actual.width, actual.height);
  const auto set = [&](int x, int y, const Color& color) {
    std::uint8_t* p = &picture.bgra[4 * (std::size_t(y) * std::size_t(actual.width) + std::size_t(x))];
    for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(std::lround(color[2 - c]));
    p[3] = 255;
  };
  const auto pale = [&](int x, int y) {
    return pale_grey(&actual.bgra[4 * (std::size_t(y) * std::size_t(actual.width) + std::size_t(x))]);
  };
  for (int y = 0; y < actual.height; ++y)
    for (int x = 0; x < actual.width; ++x) {
      const bool hatched = (x + y) % 8 == 0 && is_masked(tolerance.masks, x, y);
      set(x, y, hatched ? mix(pale(x, y), {0, 0, 0}, 0.25) : pale(x, y));
    }
  const JudgedPixels judged(expected, actual, tolerance, envelope);
  for (const JudgedTile& tile : judged.tiles)
    for (std::size_t k = 0; k < tile.kinds.size(); ++k) {
      const int x = tile.box.x + int(k) % tile.box.width, y = tile.box.y + int(k) / tile.box.width;
      if (tile.kinds[k] == JudgedTile::at_edge) {
        set(x, y, kAtEdge);
      } else if (tile.kinds[k] == JudgedTile::other) {
        const double error = tile.errors[k];
        set(x, y, mix(pale(x, y), color_of_error(error), error <= tolerance.error ? 0.4 : 1.0));
      }
    }
  return picture;
}

}  // namespace chainreel

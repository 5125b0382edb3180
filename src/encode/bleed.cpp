#include "encode/bleed.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace chainreel {
namespace {

constexpr int kLevels = 6;  // 2^6 = 64 pixels, the largest block of VP9

// Sums over blocks of 2^level pixels a side: colour times opacity, opacity.
struct Sum {
  std::array<std::uint32_t, 3> bgr{};
  std::uint32_t alpha = 0;
};

struct Level {
  int width = 0;
  std::vector<Sum> sums;
};

Level halve(const Level& fine, int width, int height) {
  Level coarse{(width + 1) / 2, {}};
  coarse.sums.resize(std::size_t(coarse.width) * std::size_t((height + 1) / 2));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Sum& from = fine.sums[std::size_t(y) * std::size_t(width) + std::size_t(x)];
      Sum& to = coarse.sums[std::size_t(y / 2) * std::size_t(coarse.width) + std::size_t(x / 2)];
      for (std::size_t c = 0; c < 3; ++c) to.bgr[c] += from.bgr[c];
      to.alpha += from.alpha;
    }
  return coarse;
}

Level pixels_of(const Image& image) {
  Level level{image.width, {}};
  level.sums.resize(image.bgra.size() / 4);
  for (std::size_t i = 0; i < level.sums.size(); ++i) {
    const std::uint8_t* p = &image.bgra[4 * i];
    level.sums[i].alpha = p[3];
    for (std::size_t c = 0; c < 3; ++c) level.sums[i].bgr[c] = std::uint32_t(p[c]) * p[3];
  }
  return level;
}

}  // namespace

void bleed_colors(Image& image) {
  std::array<Level, kLevels + 1> levels;
  levels[0] = pixels_of(image);
  int width = image.width, height = image.height;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    levels[k] = halve(levels[k - 1], width, height);
    width = levels[k].width;
    height = (height + 1) / 2;
  }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t* p = &image.bgra[4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
      if (p[3] != 0) continue;
      for (int k = 1; k <= kLevels; ++k) {
        const Level& level = levels[std::size_t(k)];
        const Sum& sum = level.sums[std::size_t(y >> k) * std::size_t(level.width) + std::size_t(x >> k)];
        if (sum.alpha == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) p[c] = std::uint8_t((sum.bgr[c] + sum.alpha / 2) / sum.alpha);
        break;
      }
    }
}

}  // namespace chainreel

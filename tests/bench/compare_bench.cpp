// What it costs to compare two pictures of 1920x1080.
//
// Rule: a page of strokes on paper against itself, against a copy with a few places that differ, with all
// strokes moved by 0.3 px, and against noise; all are timed in turn, round after round; reported is the
// median of the rounds' processor time. Reading files is not timed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <stdexcept>
#include <vector>

#include "bench/results.hpp"
#include "compare/compare_images.hpp"
#include "core/format.hpp"

namespace chainreel::bench {
namespace {

constexpr int kRounds = 15, kWidth = 1920, kHeight = 1080;

// Rings of one pixel's stroke, six links' worth of outlines.
Image strokes(double moved) {
  Image image(kWidth, kHeight);
  std::fill(image.bgra.begin(), image.bgra.end(), std::uint8_t(255));
  for (int ring = 0; ring < 12; ++ring) {
    const double x = 200 + 130 * ring + moved, y = 300 + 40 * ring, radius = 60;
    for (int row = int(y) - 64; row < int(y) + 64; ++row)
      for (int column = int(x) - 64; column < int(x) + 64; ++column) {
        const double ink =
            std::clamp(1 - std::abs(std::hypot(column + 0.5 - x, row + 0.5 - y) - radius), 0.0, 1.0);
        std::uint8_t* p = &image.bgra[std::size_t(4) * std::size_t(row * kWidth + column)];
        for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(std::min<long>(p[c], std::lround(255 - 220 * ink)));
      }
  }
  return image;
}

Image with_spots(Image image) {
  for (int spot = 0; spot < 8; ++spot)
    for (int k = 0; k < 20; ++k)
      image.bgra[std::size_t(4) * std::size_t((90 + spot * 110 + k / 4) * kWidth + 120 + spot * 220 + k)] ^=
          0x80;
  return image;
}

Image noise() {
  Image image(kWidth, kHeight);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < image.bgra.size(); ++i)
    image.bgra[i] = i % 4 == 3 ? 255 : std::uint8_t(random() >> 24);
  return image;
}

struct Case {
  const char* name;
  std::function<long()> compare;  // how many pixels are unequal
  double goal_ms;                 // 0: none
  bool differs;
  std::vector<double> ms;
};

void run() {
  const Image page = strokes(0), copy = page, spots = with_spots(page), moved = strokes(0.3), other = noise();
  const ImageTolerance plain, forgiving{.forgive_edges = true};
  const auto pair = [&](const Image& image, const ImageTolerance& tolerance) {
    return [&image, &tolerance, &page] { return compare_images(page, image, tolerance).unequal; };
  };
  std::vector<Case> cases = {{"equal", pair(copy, forgiving), 5, false, {}},
                             {"8 spots of 20 pixels", pair(spots, plain), 30, true, {}},
                             {"the same, edges forgiven", pair(spots, forgiving), 30, true, {}},
                             {"rings moved by 0.3 px", pair(moved, plain), 0, true, {}},
                             {"the same, edges forgiven by neighbours", pair(moved, forgiving), 0, true, {}},
                             {"noise, every pixel", pair(other, plain), 0, true, {}}};
  for (int round = 0; round <= kRounds; ++round)
    for (Case& one : cases) {
      const double begin = processor_seconds();
      const long unequal = one.compare();
      const double ms = 1e3 * (processor_seconds() - begin);
      if ((unequal > 0) != one.differs)
        throw std::logic_error(std::string(one.name) + ": is not what it says");
      if (round > 0) one.ms.push_back(ms);  // the first is warm-up
    }
  Results results("compare", {"case", "median_ms", "goal_ms"});
  for (const Case& one : cases) {
    const double ms = median_of(one.ms);
    std::printf("%-40s %8.2f ms\n", one.name, ms);
    results.add({one.name, format_fixed(ms, 2), one.goal_ms > 0 ? format_fixed(one.goal_ms, 0) : ""});
  }
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  return chainreel::bench::run_main(&chainreel::bench::run);
}

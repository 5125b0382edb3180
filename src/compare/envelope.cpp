#include "compare/envelope.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace chainreel {
namespace {

constexpr int kRounding = 1;  // of 255

// Means over 3 x 3 pixels; the picture's border goes on beyond it.
Image means_of(const Image& image) {
  Image means(image.width, image.height);
  const std::size_t stride = std::size_t(4) * std::size_t(image.width);
  std::vector<int> sums(stride);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* above = &image.bgra[std::size_t(std::max(y - 1, 0)) * stride];
    const std::uint8_t* here = &image.bgra[std::size_t(y) * stride];
    const std::uint8_t* below = &image.bgra[std::size_t(std::min(y + 1, image.height - 1)) * stride];
    for (std::size_t i = 0; i < stride; ++i) sums[i] = above[i] + here[i] + below[i];
    std::uint8_t* target = &means.bgra[std::size_t(y) * stride];
    for (std::size_t i = 0; i < stride; ++i) {
      const int left = sums[i >= 4 ? i - 4 : i], right = sums[i + 4 < stride ? i + 4 : i];
      target[i] = std::uint8_t((left + sums[i] + right + 4) / 9);
    }
  }
  return means;
}

// What one channel may be, half a pixel's way from `here` on to what lies between `lowest` and `highest`,
// where it is nowhere steeper than the steepest of these ways.
struct Range {
  int low, high;
};
Range range_around(int here, int lowest, int highest) {
  const int rise = std::max(highest - here, here - lowest);
  return {std::max((here + lowest - rise) / 2, 0), std::min((here + highest + rise + 1) / 2, 255)};
}

bool is_in(int value, int low, int high) {
  return value >= low - kRounding && value <= high + kRounding;
}

int half_way(int a, int b) {
  return (a + b + 1) / 2;
}

// The lowest and highest values, half a pixel's way from `middle` on to each of `ends`, of what is nowhere
// steeper than the steepest of these ways.
void bound(const Image& middle, std::span<const Image> ends, Image& low, Image& high) {
  low = high = middle;
  if (ends.empty()) return;
  PixelBytes lowest = ends[0].bgra, highest = ends[0].bgra;  // of the ends
  for (const Image& end : ends.subspan(1))
    for (std::size_t i = 0; i < lowest.size(); ++i) {
      lowest[i] = std::min(lowest[i], end.bgra[i]);
      highest[i] = std::max(highest[i], end.bgra[i]);
    }
  for (std::size_t i = 0; i < middle.bgra.size(); ++i) {
    const Range range = range_around(middle.bgra[i], lowest[i], highest[i]);
    low.bgra[i] = std::uint8_t(range.low);
    high.bgra[i] = std::uint8_t(range.high);
  }
}

// `count` bytes half way between `a` and `b`.
void average(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* target) {
  for (std::size_t i = 0; i < count; ++i) target[i] = std::uint8_t(half_way(a[i], b[i]));
}

// The picture half way to its neighbours at (dx, dy), one of them -1 or 1 and the other 0; at the border
// there is none.
Image half_way(const Image& image, int dx, int dy) {
  Image between = image;
  const std::size_t stride = std::size_t(4) * std::size_t(image.width);
  for (int y = std::max(-dy, 0); y < image.height - std::max(dy, 0); ++y) {
    const std::uint8_t* here = &image.bgra[std::size_t(y) * stride];
    const std::uint8_t* there = &image.bgra[std::size_t(y + dy) * stride];
    std::uint8_t* target = &between.bgra[std::size_t(y) * stride];
    if (dx == 0) average(here, there, stride, target);
    if (dx > 0) average(here, here + 4, stride - 4, target);
    if (dx < 0) average(here + 4, here, stride - 4, target + 4);
  }
  return between;
}

}  // namespace

Envelope envelope_of(const Image& drawn, std::span<const Image> moved) {
  for (const Image& image : moved)
    if (image.width != drawn.width || image.height != drawn.height)
      throw std::logic_error("a picture and its moved shapes have one size");
  Envelope envelope;
  bound(drawn, moved, envelope.low, envelope.high);
  std::vector<Image> means;
  for (const Image& image : moved) means.push_back(means_of(image));
  bound(means_of(drawn), means, envelope.mean_low, envelope.mean_high);
  return envelope;
}

Envelope envelope_of(const Image& drawn) {
  const Image moved[4] = {half_way(drawn, 1, 0), half_way(drawn, -1, 0), half_way(drawn, 0, 1),
                          half_way(drawn, 0, -1)};
  return envelope_of(drawn, moved);
}

bool is_near_neighbours(const Image& drawn, const Image& actual, int x, int y) {
  const std::size_t row = std::size_t(4) * std::size_t(drawn.width),
                    here = std::size_t(y) * row + 4 * std::size_t(x);
  for (std::size_t c = here; c < here + 4; ++c) {
    const int value = drawn.bgra[c];
    int lowest = 255, highest = 0;
    const auto look = [&](bool is_there, std::size_t neighbour) {
      const int end = is_there ? half_way(value, drawn.bgra[neighbour]) : value;
      lowest = std::min(lowest, end);
      highest = std::max(highest, end);
    };
    look(x > 0, c - 4);
    look(x + 1 < drawn.width, c + 4);
    look(y > 0, c - row);
    look(y + 1 < drawn.height, c + row);
    const Range range = range_around(value, lowest, highest);
    if (!is_in(actual.bgra[c], range.low, range.high)) return false;
  }
  return true;
}

bool is_within(const Envelope& envelope, const Image& actual, int x, int y) {
  const auto place = [&](int column, int row) {
    return std::size_t(4) * (std::size_t(row) * std::size_t(actual.width) + std::size_t(column));
  };
  const std::size_t here = place(x, y);
  for (std::size_t c = 0; c < 4; ++c) {
    if (!is_in(actual.bgra[here + c], envelope.low.bgra[here + c], envelope.high.bgra[here + c]))
      return false;
  }
  for (std::size_t c = 0; c < 4; ++c) {
    int sum = 0, lowest = 255, highest = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::size_t i =
            c + place(std::clamp(x + dx, 0, actual.width - 1), std::clamp(y + dy, 0, actual.height - 1));
        sum += actual.bgra[i];
        lowest = std::min<int>(lowest, envelope.low.bgra[i]);
        highest = std::max<int>(highest, envelope.high.bgra[i]);
      }
    const int mean = (sum + 4) / 9, slack = kRounding + (highest - lowest) / 8;
    if (mean < envelope.mean_low.bgra[here + c] - slack || mean > envelope.mean_high.bgra[here + c] + slack)
      return false;
  }
  return true;
}

}  // namespace chainreel

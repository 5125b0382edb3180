#include "render/body_pixels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace chainreel {
namespace {

using Bits = std::vector<std::uint64_t>;

// row |= row moved by `by` samples (less than 64) to the right, and to the left.
void add_moved(Bits& row, int by) {
  const Bits old = row;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::uint64_t before = i > 0 ? old[i - 1] : 0, after = i + 1 < row.size() ? old[i + 1] : 0;
    row[i] |= old[i] << by | before >> (64 - by) | old[i] >> by | after << (64 - by);
  }
}

// Sets all samples within `reach` of one that is set.
void widen(Bits& row, int reach) {
  for (int done = 0; done < reach;) {
    const int step = std::min({2 * done + 1, reach - done, 63});
    add_moved(row, step);
    done += step;
  }
}

// Bit k: whether there is a body at sample k.
std::uint64_t body_bits(const std::uint8_t* rgba, int count) {
  std::uint64_t bits = 0;
  int k = 0;
#if defined(__SSE2__)
  for (; k + 4 <= count; k += 4) {
    const __m128i four = _mm_loadu_si128(reinterpret_cast<const __m128i*>(rgba + std::ptrdiff_t(4) * k));
    const __m128i is_body = _mm_cmpgt_epi32(_mm_srli_epi32(four, 24), _mm_setzero_si128());
    bits |= std::uint64_t(unsigned(_mm_movemask_ps(_mm_castsi128_ps(is_body)))) << k;
  }
#endif
  for (; k < count; ++k) bits |= std::uint64_t(rgba[4 * k + 3] != 0) << k;
  return bits;
}

bool has_any(const Bits& row) {
  return std::any_of(row.begin(), row.end(), [](std::uint64_t word) { return word != 0; });
}

// How far a disc reaches to each side in the row that lies dy below its middle, in samples.
int half_width(double radius, int dy) {
  return int(std::floor(std::sqrt(std::max(0.0, radius * radius - double(dy) * dy)) + 0.5));
}

}  // namespace

BodyPixels::BodyPixels(const BodySamples& samples, const BodyPaint& paint)
    : samples_(samples),
      paint_(paint),
      width_(samples.box.width * samples.per_side),
      height_(samples.box.height * samples.per_side),
      body_(std::size_t(height_), Bits(std::size_t(width_ + 63) / 64)) {
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* row = samples.rgba.data() + std::size_t(4) * std::size_t(y) * std::size_t(width_);
    for (int x = 0; x < width_; x += 64)
      body_[std::size_t(y)][std::size_t(x) / 64] = body_bits(row + std::ptrdiff_t(4) * x, std::min(64, width_ - x));
  }
  near_ = body_;
  const double radius = paint.radius * samples.per_side;
  const int rows = int(std::floor(radius + 0.5));
  if (rows == 0) return;
  for (int y = 0; y < height_; ++y) {
    if (!has_any(body_[std::size_t(y)])) continue;
    Bits row = body_[std::size_t(y)];
    // From the disc's uppermost row, which is the narrowest, to its middle.
    for (int dy = rows, reached = 0; dy >= 0; --dy) {
      const int reach = half_width(radius, dy);
      widen(row, reach - reached);
      reached = reach;
      for (const int to : {y - dy, y + dy}) {
        if (to < 0 || to >= height_) continue;
        for (std::size_t i = 0; i < row.size(); ++i) near_[std::size_t(to)][i] |= row[i];
      }
    }
  }
}

bool BodyPixels::is_empty(const PixelBox& part) const {
  const int first = part.x * samples_.per_side, last = part.right() * samples_.per_side - 1;
  for (int y = part.y * samples_.per_side; y < part.bottom() * samples_.per_side; ++y)
    for (int word = first / 64; word <= last / 64; ++word)
      if (near_[std::size_t(y)][std::size_t(word)] != 0) return false;
  return true;
}

bool BodyPixels::draw(const PixelBox& part, std::vector<std::uint8_t>& rgba) const {
  rgba.assign(std::size_t(4) * std::size_t(part.width) * std::size_t(part.height), 0);
  PixelBox known = common_part(part, samples_.box);
  known.x -= samples_.box.x;
  known.y -= samples_.box.y;
  if (known.empty() || is_empty(known)) return false;
  for (int y = known.y; y < known.bottom(); ++y) {
    std::uint8_t* row = &rgba[std::size_t(4) * std::size_t(y + samples_.box.y - part.y) * std::size_t(part.width)];
    draw_row(y, known.x, known.right(), row + std::ptrdiff_t(4) * (known.x + samples_.box.x - part.x));
  }
  return true;
}

// Samples of a pixel stand in one word of each row: their number along a side divides 64.
void BodyPixels::draw_row(int y, int first, int last, std::uint8_t* pixel) const {
  const int n = samples_.per_side;
  const std::uint64_t all = (std::uint64_t(1) << n) - 1;
  const float share = float(paint_.opacity / (n * n));
  for (int x = first; x < last; ++x, pixel += 4) {
    std::array<int, 4> inside{};
    int around = 0;
    for (int sy = n * y; sy < n * (y + 1); ++sy) {
      const std::size_t word = std::size_t(n * x) / 64;
      const std::uint64_t near = near_[std::size_t(sy)][word] >> (n * x % 64) & all;
      if (near == 0) continue;
      const std::uint64_t body = body_[std::size_t(sy)][word] >> (n * x % 64) & all;
      around += std::popcount(near & ~body);
      // Where there is no body all four are 0.
      const std::uint8_t* sample = &samples_.rgba[std::size_t(4) * (std::size_t(sy) * std::size_t(width_) + std::size_t(n * x))];
      if (body != 0)
        for (int k = 0; k < 4 * n; ++k) inside[std::size_t(k % 4)] += sample[k];
    }
    if (around == 0 && inside[3] == 0) continue;
    for (std::size_t c = 0; c < 4; ++c)
      pixel[c] = std::uint8_t(std::min(255.0f, share * (float(inside[c]) + 255 * paint_.line[c] * float(around)) + 0.5f));
  }
}

}  // namespace chainreel

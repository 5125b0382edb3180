#include "render/body_pixels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace chainreel {
namespace {

using Words = std::span<const std::uint64_t>;

// to = from moved by `by` samples (less than 64) to the right, and to the left, and as it is.
void add_moved(Words from, int by, std::span<std::uint64_t> to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::uint64_t before = i > 0 ? from[i - 1] : 0, after = i + 1 < from.size() ? from[i + 1] : 0;
    to[i] = from[i] | from[i] << by | before >> (64 - by) | from[i] >> by | after << (64 - by);
  }
}

bool has_any(Words row) {
  return std::any_of(row.begin(), row.end(), [](std::uint64_t word) { return word != 0; });
}

// How far a disc reaches to each side in the row that lies dy below its middle, in samples.
int half_width(double radius, int dy) {
  return int(std::floor(std::sqrt(std::max(0.0, radius * radius - double(dy) * dy)) + 0.5));
}

}  // namespace

void BodySamples::reset(const PixelBox& new_box, int new_per_side) {
  box = new_box;
  per_side = new_per_side;
  pixels.assign(std::size_t(box.width) * std::size_t(box.height), 0);
  bits.assign(std::size_t(words()) * std::size_t(box.height * per_side), 0);
}

void BodySamples::cut_at(int page_width, int page_height) {
  const int rows = std::clamp(page_height - box.y, 0, box.height) * per_side;
  std::fill(bits.begin() + std::ptrdiff_t(rows) * words(), bits.end(), 0);
  const int columns = std::clamp(page_width - box.x, 0, box.width) * per_side;
  for (int word = columns / 64; word < words(); ++word) {
    const std::uint64_t kept = word == columns / 64 ? (std::uint64_t(1) << columns % 64) - 1 : 0;
    for (int row = 0; row < rows; ++row) bits[std::size_t(row) * std::size_t(words()) + std::size_t(word)] &= kept;
  }
}

BodyPixels::BodyPixels(const BodySamples& samples, const BodyPaint& paint)
    : samples_(samples), paint_(paint), words_(samples.words()), height_(samples.box.height * samples.per_side), near_(samples.bits) {
  for (std::size_t level = 0; level < 256; ++level)
    faded_[level] = std::uint8_t(std::min(255.0, paint.opacity * double(level) + 0.5));
  if (paint.radius > 0) find_near();
}

void BodyPixels::find_near() {
  const double radius = paint_.radius * samples_.per_side;
  const int rows = int(std::floor(radius + 0.5));
  const auto width = std::size_t(words_);
  std::vector<std::uint64_t> row(width), moved(width);
  for (int y = 0; y < height_; ++y) {
    const Words body(&samples_.bits[std::size_t(y) * width], width);
    if (!has_any(body)) continue;
    std::copy(body.begin(), body.end(), row.begin());
    // From the disc's uppermost row, which is the narrowest, to its middle.
    for (int dy = rows, reached = 0; dy >= 0; --dy) {
      const int reach = half_width(radius, dy);
      for (int done = reached; done < reach;) {
        // As far as what is set reaches without gaps.
        const int step = std::min({2 * done + 1, reach - done, 63});
        add_moved(row, step, moved);
        std::swap(row, moved);
        done += step;
      }
      reached = reach;
      for (const int to : {y - dy, y + dy}) {
        if (to < 0 || to >= height_) continue;
        for (std::size_t i = 0; i < width; ++i) near_[std::size_t(to) * width + i] |= row[i];
      }
    }
  }
}

bool BodyPixels::is_empty(const PixelBox& part) const {
  const int n = samples_.per_side, per_word = 64 / n;
  const int first = (part.x - samples_.box.x) / per_word, end = (part.right() - samples_.box.x) / per_word;
  const int top = n * (part.y - samples_.box.y);
  for (int row = top; row < top + n * part.height; ++row)
    if (has_any(Words(&near_[std::size_t(row) * std::size_t(words_) + std::size_t(first)], std::size_t(end - first)))) return false;
  return true;
}

namespace {

// Both premultiplied; each byte is rounded.
std::uint32_t put_over(std::uint32_t above, std::uint32_t below) {
  const std::uint32_t through = 255 - (above >> 24);
  const auto faded = [through](std::uint32_t pair) {  // two bytes, two bytes apart
    const std::uint32_t product = pair * through + 0x00800080U;
    return (product + (product >> 8 & 0x00ff00ffU)) >> 8 & 0x00ff00ffU;
  };
  return above + (faded(below & 0x00ff00ffU) | faded(below >> 8 & 0x00ff00ffU) << 8);
}

}  // namespace

void BodyPixels::draw_over(const PixelBox& part, std::uint32_t* pixels, std::ptrdiff_t stride) const {
  const int per_word = 64 / samples_.per_side;
  const int left = part.x - samples_.box.x, right = part.right() - samples_.box.x;
  for (int y = part.y - samples_.box.y, end = y + part.height; y < end; ++y, pixels += stride)
    for (int x = left, behind = 0; x < right; x = behind) {
      behind = std::min(right, (x / per_word + 1) * per_word);
      if (is_empty(y, x / per_word)) continue;
      if (copies_inside(y, x, behind, pixels + (x - left))) continue;
      for (int k = x; k < behind; ++k) {
        const std::uint32_t above = pixel(k, y);
        if (above != 0) pixels[k - left] = above >> 24 == 255 ? above : put_over(above, pixels[k - left]);
      }
    }
}

// Where opaque bodies fill all pixels from x to behind, which lie in one word of samples, they are the page's.
bool BodyPixels::copies_inside(int y, int x, int behind, std::uint32_t* pixels) const {
  if (paint_.opacity != 1) return false;
  const std::uint32_t* const from = &samples_.pixels[std::size_t(y) * std::size_t(samples_.box.width) + std::size_t(x)];
  std::uint32_t common = 0xff000000U;
  for (int k = 0; k < behind - x; ++k) common &= from[k];
  if (common != 0xff000000U) return false;
  std::copy_n(from, behind - x, pixels);
  return true;
}

// The pixels of a word of samples.
bool BodyPixels::is_empty(int y, int word) const {
  std::uint64_t any = 0;
  for (int k = 0; k < samples_.per_side; ++k)
    any |= near_[std::size_t(samples_.per_side * y + k) * std::size_t(words_) + std::size_t(word)];
  return any == 0;
}

std::uint32_t BodyPixels::pixel(int x, int y) const {
  const std::uint32_t mean = samples_.pixels[std::size_t(y) * std::size_t(samples_.box.width) + std::size_t(x)];
  int around = 0;  // samples of the line
  // Where all samples show opaque bodies there is none.
  if (mean >> 24 != 255) {
    const unsigned n = unsigned(samples_.per_side), bit = n * unsigned(x) % 64;
    const std::uint64_t all = (std::uint64_t(1) << n) - 1;
    for (unsigned k = 0; k < n; ++k) {
      const std::size_t word = std::size_t(n * unsigned(y) + k) * std::size_t(words_) + n * unsigned(x) / 64;
      const std::uint64_t line = (near_[word] & ~samples_.bits[word]) >> bit & all;
      if (line != 0) around += std::popcount(line);
    }
  }
  return around == 0 && paint_.opacity == 1 ? mean : with_line(mean, around);
}

std::uint32_t BodyPixels::with_line(std::uint32_t mean, int around) const {
  const auto level = [&](int shift, std::size_t channel) -> std::uint32_t {
    const std::uint32_t own = mean >> shift & 255;
    if (around == 0) return std::uint32_t(faded_[own]) << shift;
    const double line = 255.0 * paint_.line[channel] * around / (samples_.per_side * samples_.per_side);
    return std::uint32_t(std::min(255.0, paint_.opacity * (own + line) + 0.5)) << shift;
  };
  return level(0, 2) | level(8, 1) | level(16, 0) | level(24, 3);
}

}  // namespace chainreel

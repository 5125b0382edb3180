#include "render/soft_shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/lanes.hpp"

namespace chainreel {
namespace {

constexpr std::uint32_t kFine = 256;  // parts of a level
constexpr double kFinest = 7;         // cells at least that a radius takes, where cells are larger than pixels
constexpr int kLargestCell = 4;       // px

}  // namespace

ShadowBlur::ShadowBlur(double radius) {
  while (pixels < kLargestCell && radius / (2 * pixels) >= kFinest) pixels *= 2;
  reach = int(pixels == 1 ? radius / 2 : std::lround(radius / (2 * pixels)));
  reach_across = reach / 2;
}

namespace {

// Sums over `reach` numbers to each side, twice, along a line of numbers; beyond its ends there is nothing. Divided by their count.
void blur_line(std::span<const std::uint32_t> from, int reach, std::vector<std::uint64_t>& once, std::span<std::uint32_t> to) {
  const int count = int(from.size());
  const std::uint64_t width = std::uint64_t(2 * reach + 1);
  // The first sums are known as far beyond the ends as they are not zero.
  once.assign(std::size_t(count + 2 * reach), 0);
  std::uint64_t sum = 0;
  for (int i = -reach; i < count + reach; ++i) {
    if (i + reach < count) sum += from[std::size_t(i + reach)];
    if (i - reach - 1 >= 0) sum -= from[std::size_t(i - reach - 1)];
    once[std::size_t(i + reach)] = sum;
  }
  sum = 0;
  for (int i = 0; i < 2 * reach; ++i) sum += once[std::size_t(i)];
  for (int i = 0; i < count; ++i) {
    sum += once[std::size_t(i + 2 * reach)];
    to[std::size_t(i)] = std::uint32_t((sum + width * width / 2) / (width * width));
    sum -= once[std::size_t(i)];
  }
}

// The least box of the page's cells that holds all which show something.
PixelBox shown_cells(const BodySamples& samples) {
  PixelBox shown;
  const int width = samples.box.width;
  for (int y = 0; y < samples.box.height; ++y) {
    const std::uint32_t* const row = &samples.pixels[std::size_t(y) * std::size_t(width)];
    std::uint32_t any = 0;
    for (int x = 0; x < width; ++x) any |= row[x];
    if (any == 0) continue;
    int first = 0, last = width - 1;
    while (row[first] == 0) ++first;
    while (row[last] == 0) --last;
    shown = box_around(shown, {samples.box.x + first, samples.box.y + y, last + 1 - first, 1});
  }
  return shown;
}

PixelBox grown(const PixelBox& box, int x, int y) {
  return box.empty() ? box : box_between(box.x - x, box.y - y, box.right() + x, box.bottom() + y);
}

}  // namespace

SoftShadow::SoftShadow(const BodySamples& samples, const BodyPaint& paint) : paint_(paint), blur_(paint.radius) {
  box_ = common_part(grown(shown_cells(samples), 2 * blur_.reach, 2 * blur_.reach_across), samples.box);
  blur(samples);
  take_levels();
}

// Numbers are whole and depend on nothing farther away than the blur reaches, so that parts have the bytes of the whole.
void SoftShadow::blur(const BodySamples& samples) {
  const auto width = std::size_t(box_.width), rows = std::size_t(box_.height);
  sums_.assign(width * rows, 0);
  std::vector<std::uint64_t> once;
  std::vector<std::uint32_t> line(std::max(width, rows)), column(rows);
  for (std::size_t y = 0; y < rows; ++y) {
    const std::size_t first = (y + std::size_t(box_.y - samples.box.y)) * std::size_t(samples.box.width) + std::size_t(box_.x - samples.box.x);
    std::uint32_t any = 0;
    for (std::size_t x = 0; x < width; ++x) any |= line[x] = kFine * (samples.pixels[first + x] >> 24);
    if (any != 0) blur_line({line.data(), width}, blur_.reach, once, {&sums_[y * width], width});
  }
  for (std::size_t x = 0; x < width; ++x) {
    std::uint32_t any = 0;
    for (std::size_t y = 0; y < rows; ++y) any |= column[y] = sums_[y * width + x];
    if (any == 0) continue;
    blur_line(column, blur_.reach_across, once, {line.data(), rows});
    for (std::size_t y = 0; y < rows; ++y) sums_[y * width + x] = line[y];
  }
}

void SoftShadow::take_levels() {
  levels_.resize(sums_.size());
  const Rect whole = paint_.fade.inset(1);
  const double unit = double(paint_.page_height) / blur_.pixels;
  std::size_t i = 0;
  for (int y = box_.y; y < box_.bottom(); ++y)
    for (int x = box_.x; x < box_.right(); ++x, ++i) {
      double opacity = paint_.opacity * sums_[i] / kFine;
      const Point at{(x + 0.5) / unit, 1 - (y + 0.5) / unit};
      if (opacity > 0 && paint_.fade.any() && (at.x < whole.x0 || at.x > whole.x1 || at.y < whole.y0 || at.y > whole.y1))
        opacity *= paint_.fade.opacity_at(at);
      levels_[i] = float(opacity);
    }
}

namespace {

// What lies between two cells, one after the other, at each of the pixels' middles.
template <int pixels>
void stretch(std::span<const float> cells, float* to) {
  for (std::size_t i = 0; i + 1 < cells.size(); ++i, to += pixels)
    for (int k = 0; k < pixels; ++k)
      to[k] = pixels == 1 ? cells[i + 1] : cells[i] + (cells[i + 1] - cells[i]) * ((float(k) + 0.5F) / pixels);
}

// The colour, premultiplied with one opacity, with others.
class Inks {
 public:
  explicit Inks(const std::array<float, 4>& color) {
    const float own = std::max(1e-6F, color[3]);
    for (std::size_t c = 0; c < 3; ++c) share_[c] = color[2 - c] / own;
  }
  Int4 of(Float4 level) const {
    Int4 bytes = __builtin_convertvector(level + 0.5F, Int4) << 24;
    for (std::size_t c = 0; c < 3; ++c) bytes |= __builtin_convertvector(level * share_[c] + 0.5F, Int4) << int(8 * c);
    return bytes;
  }

 private:
  std::array<float, 3> share_{};  // blue, green, red
};

}  // namespace

// The cells' levels at the middle of a row of pixels, one more to each side than there are; whether there are any.
bool SoftShadow::find_levels(int row, std::vector<float>& line) const {
  line.assign(std::size_t(box_.width) + 2, 0);
  const int half = blur_.pixels / 2, upper = (row + half) / blur_.pixels - (blur_.pixels > 1 ? 1 : 0);
  const float share = blur_.pixels == 1 ? 0 : (float((row + half) % blur_.pixels) + 0.5F) / float(blur_.pixels);
  bool any = false;
  for (const auto& [y, weight] : {std::pair{upper, 1 - share}, {upper + 1, share}}) {
    if (y < box_.y || y >= box_.bottom() || weight == 0) continue;
    any = true;
    const float* const levels = &levels_[std::size_t(y - box_.y) * std::size_t(box_.width)];
    for (std::size_t x = 0; x < std::size_t(box_.width); ++x) line[x + 1] += weight * levels[x];
  }
  return any;
}

void SoftShadow::draw_over(const PixelBox& part, std::uint32_t* pixels, std::ptrdiff_t stride) const {
  const int p = blur_.pixels;
  // Where the stretched line begins and ends: between the cell before the first and the first.
  const int start = p == 1 ? box_.x : (box_.x - 1) * p + p / 2, end = start + (box_.width + 1) * p;
  const int left = std::max(part.x, start), right = std::min(part.right(), end);
  if (box_.empty() || left >= right) return;
  const Inks inks(paint_.line);
  std::vector<float> line, stretched(std::size_t(end - start) + 4);
  for (int y = part.y; y < part.bottom(); ++y, pixels += stride) {
    if (!find_levels(y, line)) continue;
    (p == 1 ? stretch<1> : p == 2 ? stretch<2> : stretch<4>)(line, stretched.data());
    for (int x = left; x < right; x += 4) {
      const int count = std::min(4, right - x);
      const Int4 above = inks.of(load4<Float4>(&stretched[std::size_t(x - start)]));
      if (bits_of(above != 0) == 0) continue;
      std::uint32_t* const at = pixels + (x - part.x);
      std::array<std::uint32_t, 4> below{};
      std::copy_n(at, count, below.begin());
      store4(below.data(), put_over(above, load4<Int4>(below.data())));
      std::copy_n(below.begin(), count, at);
    }
  }
}

}  // namespace chainreel

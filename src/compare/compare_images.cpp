#include "compare/compare_images.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "compare/flip.hpp"
#include "compare/judged_pixels.hpp"

namespace chainreel {
namespace {

constexpr int kTile = 64;  // pixels; at least the filters' reach
static_assert(kTile >= Flip::kReach);

// Grows from nothing by the pixels and boxes that it is given.
class Bounds {
 public:
  void add(int x, int y) { add(x, y, x + 1, y + 1); }
  void add(const Bounds& other, int grown) {
    if (!other.empty())
      add(other.left_ - grown, other.top_ - grown, other.right_ + grown, other.bottom_ + grown);
  }
  void cut(int left, int top, int right, int bottom) {
    left_ = std::max(left_, left);
    top_ = std::max(top_, top);
    right_ = std::min(right_, right);
    bottom_ = std::min(bottom_, bottom);
  }
  bool empty() const { return left_ >= right_ || top_ >= bottom_; }
  PixelBox box() const {
    return empty() ? PixelBox{} : PixelBox{left_, top_, right_ - left_, bottom_ - top_};
  }

 private:
  void add(int left, int top, int right, int bottom) {
    left_ = std::min(left_, left);
    top_ = std::min(top_, top);
    right_ = std::max(right_, right);
    bottom_ = std::max(bottom_, bottom);
  }
  int left_ = 1 << 30, top_ = 1 << 30, right_ = 0, bottom_ = 0;
};

const std::uint8_t* pixel(const Image& image, std::size_t index) {
  return &image.bgra[4 * index];
}

// Which pixels are masked; empty where none is.
std::vector<bool> masked_pixels(const std::vector<PixelBox>& masks, int width, int height) {
  std::vector<bool> masked;
  for (const PixelBox& mask : masks) {
    if (mask.empty()) continue;
    masked.resize(std::size_t(width) * std::size_t(height));
    const long left = std::max(mask.x, 0), right = std::min<long>(long(mask.x) + mask.width, width);
    const long top = std::max(mask.y, 0), bottom = std::min<long>(long(mask.y) + mask.height, height);
    for (long y = top; y < bottom; ++y)
      for (long x = left; x < right; ++x) masked[std::size_t(y * width + x)] = true;
  }
  return masked;
}

Image part_of(const Image& image, const PixelBox& box) {
  Image part(box.width, box.height);
  const std::size_t bytes = std::size_t(4) * std::size_t(box.width);
  for (int y = 0; y < box.height; ++y)
    std::memcpy(&part.bgra[std::size_t(y) * bytes],
                pixel(image, std::size_t(box.y + y) * std::size_t(image.width) + std::size_t(box.x)), bytes);
  return part;
}

// The envelope of a tile, from each pixel's neighbours.
class NearEnvelope {
 public:
  NearEnvelope(const Image& expected, const Image& actual, const PixelBox& tile)
      : left_(std::max(tile.x - kAround, 0)), top_(std::max(tile.y - kAround, 0)) {
    const PixelBox box = {left_, top_, std::min(tile.x + tile.width + kAround, expected.width) - left_,
                          std::min(tile.y + tile.height + kAround, expected.height) - top_};
    actual_ = part_of(actual, box);
    envelope_ = envelope_of(part_of(expected, box));
  }
  bool holds(int x, int y) const { return is_within(envelope_, actual_, x - left_, y - top_); }

 private:
  static constexpr int kAround = 2;  // so far around a pixel its envelope looks
  int left_, top_;
  Image actual_;
  Envelope envelope_;
};

// The pixels that differ tile by tile, and the errors around them.
class Tiles {
 public:
  Tiles(int width, int height)
      : width_(width),
        height_(height),
        across_((width + kTile - 1) / kTile),
        down_((height + kTile - 1) / kTile),
        differing_(std::size_t(across_) * std::size_t(down_)) {}

  void add(int x, int y) { at(x / kTile, y / kTile).add(x, y); }

  // Errors wherever a differing pixel bears on them. Each pixel belongs to one tile and is computed once.
  void compute(const Flip& flip, const Image& expected, const Image& actual, std::vector<float>& errors) {
    for (int row = 0; row < down_; ++row)
      for (int column = 0; column < across_; ++column) {
        Bounds needed;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, down_ - 1); ++y)
          for (int x = std::max(column - 1, 0); x <= std::min(column + 1, across_ - 1); ++x)
            needed.add(at(x, y), Flip::kReach);
        needed.cut(column * kTile, row * kTile, std::min((column + 1) * kTile, width_),
                   std::min((row + 1) * kTile, height_));
        if (!needed.empty()) flip.compute(expected, actual, needed.box(), errors);
      }
  }

 private:
  Bounds& at(int column, int row) {
    return differing_[std::size_t(row) * std::size_t(across_) + std::size_t(column)];
  }
  int width_, height_, across_, down_;
  std::vector<Bounds> differing_;
};

}  // namespace

JudgedPixels::JudgedPixels(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                           const Envelope* envelope) {
  const int width = expected.width, height = expected.height;
  if (envelope != nullptr && (envelope->low.width != width || envelope->low.height != height))
    throw std::logic_error("the envelope is that of a picture of another size");
  if (expected.bgra == actual.bgra) return;
  const std::vector<bool> hidden = masked_pixels(tolerance.masks, width, height);
  kinds.assign(std::size_t(width) * std::size_t(height), equal);
  Tiles tiles(width, height);
  bool any = false, forgiven = false;
  for (int top = 0; top < height; top += kTile)
    for (int left = 0; left < width; left += kTile) {
      const PixelBox tile = {left, top, std::min(kTile, width - left), std::min(kTile, height - top)};
      std::optional<NearEnvelope> near;
      for (int y = top; y < top + tile.height; ++y) {
        const std::size_t row = std::size_t(y) * std::size_t(width);
        if (std::memcmp(pixel(expected, row + std::size_t(left)), pixel(actual, row + std::size_t(left)),
                        std::size_t(4) * std::size_t(tile.width)) == 0)
          continue;
        for (int x = left; x < left + tile.width; ++x) {
          const std::size_t i = row + std::size_t(x);
          if (std::memcmp(pixel(expected, i), pixel(actual, i), 4) == 0) continue;
          const auto is_at_edge = [&] {
            if (envelope != nullptr) return is_within(*envelope, actual, x, y);
            if (!tolerance.forgive_edges) return false;
            if (!near) near.emplace(expected, actual, tile);
            return near->holds(x, y);
          };
          kinds[i] = !hidden.empty() && hidden[i] ? masked : is_at_edge() ? at_edge : other;
          if (kinds[i] == other) {
            tiles.add(x, y);
            any = true;
          } else {
            forgiven = true;
          }
        }
      }
    }
  if (!any) return;
  errors.assign(kinds.size(), 0.0f);
  Image counted;
  if (forgiven) {
    counted = actual;
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (kinds[i] == masked || kinds[i] == at_edge) std::memcpy(&counted.bgra[4 * i], pixel(expected, i), 4);
  }
  tiles.compute(Flip(), expected, forgiven ? counted : actual, errors);
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (kinds[i] == other)
      errors[i] = std::max(errors[i], float(std::abs(pixel(expected, i)[3] - pixel(actual, i)[3])) / 255.0f);
}

ImageDifference compare_images(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                               const Envelope* envelope) {
  ImageDifference difference;
  difference.same_size = expected.width == actual.width && expected.height == actual.height;
  if (!difference.same_size) return difference;
  const JudgedPixels judged(expected, actual, tolerance, envelope);
  Bounds beyond, unequal;
  for (std::size_t i = 0; i < judged.kinds.size(); ++i) {
    const JudgedPixels::Kind kind = judged.kinds[i];
    if (kind == JudgedPixels::equal || kind == JudgedPixels::masked) continue;
    const int x = int(i % std::size_t(expected.width)), y = int(i / std::size_t(expected.width));
    ++difference.unequal;
    unequal.add(x, y);
    if (kind == JudgedPixels::at_edge) {
      ++difference.at_edges;
      continue;
    }
    const double error = judged.errors[i];
    difference.worst = std::max(difference.worst, error);
    if (!(error <= tolerance.error)) {  // a tolerance that is no number allows nothing
      ++difference.beyond;
      beyond.add(x, y);
    }
  }
  double sum = 0;
  for (const float error : judged.errors) sum += error;
  if (sum > 0) difference.mean = sum / double(judged.errors.size());
  difference.box = (beyond.empty() ? unequal : beyond).box();
  return difference;
}

}  // namespace chainreel

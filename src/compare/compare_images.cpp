#include "compare/compare_images.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>

#include "compare/flip.hpp"
#include "compare/judged_pixels.hpp"
#include "core/parallel.hpp"

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

PixelBox grown(const PixelBox& box, int by, const Image& image) {
  const int left = std::max(box.x - by, 0), top = std::max(box.y - by, 0);
  return {left, top, std::min(box.x + box.width + by, image.width) - left,
          std::min(box.y + box.height + by, image.height) - top};
}

// The envelope of a tile, from each pixel's neighbours.
class NearEnvelope {
 public:
  NearEnvelope(const Image& expected, const Image& actual, const PixelBox& tile)
      : box_(grown(tile, kAround, expected)),
        actual_(part_of(actual, box_)),
        envelope_(envelope_of(part_of(expected, box_))) {}
  bool holds(int x, int y) const { return is_within(envelope_, actual_, x - box_.x, y - box_.y); }

 private:
  static constexpr int kAround = 2;  // so far around a pixel its envelope looks
  PixelBox box_;
  Image actual_;
  Envelope envelope_;
};

// A pair of pictures tile by tile. Each tile is one thread's; what it finds does not depend on the others'.
class TiledPair {
 public:
  TiledPair(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
            const Envelope* envelope)
      : expected_(expected),
        actual_(actual),
        forgive_edges_(tolerance.forgive_edges),
        envelope_(envelope),
        hidden_(masked_pixels(tolerance.masks, expected.width, expected.height)),
        across_((expected.width + kTile - 1) / kTile),
        down_((expected.height + kTile - 1) / kTile),
        tiles_(std::size_t(across_) * std::size_t(down_)),
        differing_(tiles_.size()) {}

  std::vector<JudgedTile> judge() {
    for_each([this](int column, int row) { find_kinds(column, row); });
    for_each([this](int column, int row) { find_errors(column, row); });
    return std::move(tiles_);
  }

 private:
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(across_) + std::size_t(column);
  }

  // Rows of tiles on all cores.
  template <class Work>
  void for_each(Work work) {
    const int cores = int(std::thread::hardware_concurrency());
    for_each_index(std::size_t(down_), std::clamp(cores, 1, down_), [&](std::size_t row) {
      for (int column = 0; column < across_; ++column) work(column, int(row));
    });
  }

  void find_kinds(int column, int row) {
    JudgedTile& tile = tiles_[index(column, row)];
    const int left = column * kTile, top = row * kTile;
    tile.box = {left, top, std::min(kTile, expected_.width - left), std::min(kTile, expected_.height - top)};
    Bounds doubtful;  // around what an envelope is needed for
    for (int y = 0; y < tile.box.height; ++y) {
      const std::size_t first = std::size_t(top + y) * std::size_t(expected_.width) + std::size_t(left);
      if (std::memcmp(pixel(expected_, first), pixel(actual_, first),
                      std::size_t(4) * std::size_t(tile.box.width)) == 0)
        continue;
      tile.kinds.resize(std::size_t(tile.box.width) * std::size_t(tile.box.height), JudgedTile::equal);
      for (int x = 0; x < tile.box.width; ++x) {
        const std::size_t i = first + std::size_t(x);
        if (std::memcmp(pixel(expected_, i), pixel(actual_, i), 4) == 0) continue;
        const bool is_masked = !hidden_.empty() && hidden_[i];
        tile.kind(x, y) = is_masked ? JudgedTile::masked : JudgedTile::other;
        if (!is_masked && may_be_at_edge(left + x, top + y)) doubtful.add(left + x, top + y);
      }
    }
    if (!doubtful.empty()) find_edges(tile, doubtful.box());
    for (std::size_t k = 0; k < tile.kinds.size(); ++k)
      if (tile.kinds[k] == JudgedTile::other)
        differing_[index(column, row)].add(left + int(k) % tile.box.width, top + int(k) / tile.box.width);
  }

  // Most pixels that differ need no envelope to be told from an edge.
  bool may_be_at_edge(int x, int y) const {
    return envelope_ != nullptr || (forgive_edges_ && is_near_neighbours(expected_, actual_, x, y));
  }

  void find_edges(JudgedTile& tile, const PixelBox& doubtful) const {
    std::optional<NearEnvelope> near;
    if (envelope_ == nullptr) near.emplace(expected_, actual_, doubtful);
    for (int y = doubtful.y; y < doubtful.y + doubtful.height; ++y)
      for (int x = doubtful.x; x < doubtful.x + doubtful.width; ++x) {
        JudgedTile::Kind& kind = tile.kind(x - tile.box.x, y - tile.box.y);
        if (kind != JudgedTile::other) continue;
        if (near ? near->holds(x, y) : is_within(*envelope_, actual_, x, y)) kind = JudgedTile::at_edge;
      }
  }

  // Wherever a pixel of kind `other` bears on it.
  void find_errors(int column, int row) {
    JudgedTile& tile = tiles_[index(column, row)];
    Bounds needed;
    for_neighbours(column, row, [&](std::size_t i) { needed.add(differing_[i], Flip::kReach); });
    needed.cut(tile.box.x, tile.box.y, tile.box.x + tile.box.width, tile.box.y + tile.box.height);
    if (needed.empty()) return;
    const PixelBox box = needed.box(), around = grown(box, Flip::kReach, expected_);
    Image counted = part_of(actual_, around);
    for_neighbours(column, row, [&](std::size_t i) { take_as_equal(tiles_[i], around, counted); });
    const PixelBox inside = {box.x - around.x, box.y - around.y, box.width, box.height};
    const std::vector<float> errors = flip_.errors(part_of(expected_, around), counted, inside);
    tile.errors.assign(std::size_t(tile.box.width) * std::size_t(tile.box.height), 0.0f);
    for (int y = 0; y < box.height; ++y)
      std::copy_n(&errors[std::size_t(y) * std::size_t(box.width)], box.width,
                  &tile.errors[std::size_t(box.y + y - tile.box.y) * std::size_t(tile.box.width) +
                               std::size_t(box.x - tile.box.x)]);
    raise_to_alpha(tile);
  }

  template <class Work>
  void for_neighbours(int column, int row, Work work) const {
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, down_ - 1); ++y)
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, across_ - 1); ++x) work(index(x, y));
  }

  // What is masked or at edges bears on no error: it is given the expected picture's pixels.
  void take_as_equal(const JudgedTile& tile, const PixelBox& around, Image& counted) const {
    if (tile.kinds.empty()) return;
    const int left = std::max(tile.box.x, around.x), top = std::max(tile.box.y, around.y);
    const int right = std::min(tile.box.x + tile.box.width, around.x + around.width);
    const int bottom = std::min(tile.box.y + tile.box.height, around.y + around.height);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const JudgedTile::Kind kind = tile.kind(x - tile.box.x, y - tile.box.y);
        if (kind != JudgedTile::masked && kind != JudgedTile::at_edge) continue;
        const std::size_t to =
            std::size_t(y - around.y) * std::size_t(around.width) + std::size_t(x - around.x);
        std::memcpy(&counted.bgra[4 * to],
                    pixel(expected_, std::size_t(y) * std::size_t(expected_.width) + std::size_t(x)), 4);
      }
  }

  void raise_to_alpha(JudgedTile& tile) const {
    for (std::size_t k = 0; k < tile.kinds.size(); ++k) {
      if (tile.kinds[k] != JudgedTile::other) continue;
      const std::size_t y = k / std::size_t(tile.box.width), x = k % std::size_t(tile.box.width);
      const std::size_t i =
          (std::size_t(tile.box.y) + y) * std::size_t(expected_.width) + std::size_t(tile.box.x) + x;
      const int alpha = std::abs(pixel(expected_, i)[3] - pixel(actual_, i)[3]);
      tile.errors[k] = std::max(tile.errors[k], float(alpha) / 255.0f);
    }
  }

  const Image &expected_, &actual_;
  const bool forgive_edges_;
  const Envelope* envelope_;
  const std::vector<bool> hidden_;
  const int across_, down_;
  std::vector<JudgedTile> tiles_;
  std::vector<Bounds> differing_;  // around each tile's pixels of kind `other`
  const Flip flip_;
};

}  // namespace

JudgedPixels::JudgedPixels(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                           const Envelope* envelope) {
  if (envelope != nullptr &&
      (envelope->low.width != expected.width || envelope->low.height != expected.height))
    throw std::logic_error("the envelope is that of a picture of another size");
  if (&expected == &actual || expected.bgra == actual.bgra) return;
  tiles = TiledPair(expected, actual, tolerance, envelope).judge();
}

ImageDifference compare_images(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                               const Envelope* envelope) {
  ImageDifference difference;
  difference.same_size = expected.width == actual.width && expected.height == actual.height;
  if (!difference.same_size) return difference;
  const JudgedPixels judged(expected, actual, tolerance, envelope);
  Bounds beyond, unequal;
  double sum = 0;
  for (const JudgedTile& tile : judged.tiles) {
    for (std::size_t k = 0; k < tile.kinds.size(); ++k) {
      const JudgedTile::Kind kind = tile.kinds[k];
      if (kind == JudgedTile::equal || kind == JudgedTile::masked) continue;
      const int x = tile.box.x + int(k) % tile.box.width, y = tile.box.y + int(k) / tile.box.width;
      ++difference.unequal;
      unequal.add(x, y);
      if (kind == JudgedTile::at_edge) {
        ++difference.at_edges;
        continue;
      }
      const double error = tile.errors[k];
      difference.worst = std::max(difference.worst, error);
      if (!(error <= tolerance.error)) {  // a tolerance that is no number allows nothing
        ++difference.beyond;
        beyond.add(x, y);
      }
    }
    for (const float error : tile.errors) sum += error;
  }
  if (sum > 0) difference.mean = sum / (double(expected.width) * double(expected.height));
  difference.box = (beyond.empty() ? unequal : beyond).box();
  return difference;
}

}  // namespace chainreel

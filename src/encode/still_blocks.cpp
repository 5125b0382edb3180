#include "encode/still_blocks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace chainreel {
namespace {

constexpr int kSide = 16;  // pixels; of chroma half of it
constexpr std::size_t kBytes = kSide * kSide * 3 / 2;  // of a block, at most

}  // namespace

StillBlocks::StillBlocks(int width, int height)
    : width_(width),
      height_(height),
      columns_((width + kSide - 1) / kSide),
      flags_(std::size_t(columns_) * std::size_t((height + kSide - 1) / kSide)) {}

// row(first byte, bytes) for each row of the block in the three planes.
template <class Row>
void StillBlocks::for_rows(const PlanesYuv420& planes, const Block& block, Row row) const {
  for (int i = 0; i < 3; ++i) {
    const int part = i == 0 ? 1 : 2;
    const int wide = std::min(kSide, width_ - block.x) / part, high = std::min(kSide, height_ - block.y) / part;
    const std::uint8_t* first = planes.plane[i] + std::ptrdiff_t(planes.stride[i]) * (block.y / part) + block.x / part;
    for (int y = 0; y < high; ++y, first += planes.stride[i]) row(first, std::size_t(wide));
  }
}

void StillBlocks::keep(const PlanesYuv420& planes, const std::vector<PixelBox>& boxes) {
  std::fill(flags_.begin(), flags_.end(), std::uint8_t(1));
  touched_.clear();
  for (const PixelBox& box : boxes) {
    if (box.empty()) continue;
    for (int y = box.y / kSide; y <= (box.bottom() - 1) / kSide; ++y)
      for (int x = box.x / kSide; x <= (box.right() - 1) / kSide; ++x) {
        std::uint8_t& still = flags_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)];
        if (!still) continue;  // boxes may meet in it
        still = 0;
        touched_.push_back({x * kSide, y * kSide});
      }
  }
  kept_.resize(std::max(kept_.size(), touched_.size() * kBytes));
  std::uint8_t* kept = kept_.data();
  for (const Block& block : touched_)
    for_rows(planes, block, [&](const std::uint8_t* first, std::size_t bytes) {
      std::memcpy(kept, first, bytes);
      kept += bytes;
    });
}

StillBlocks::Flags& StillBlocks::compare(const PlanesYuv420& planes) {
  const std::uint8_t* kept = kept_.data();
  for (const Block& block : touched_) {
    bool same = true;
    for_rows(planes, block, [&](const std::uint8_t* first, std::size_t bytes) {
      same = same && std::memcmp(first, kept, bytes) == 0;
      kept += bytes;
    });
    flags_[std::size_t(block.y / kSide) * std::size_t(columns_) + std::size_t(block.x / kSide)] = same;
  }
  return flags_;
}

}  // namespace chainreel

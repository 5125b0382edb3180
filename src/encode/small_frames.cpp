#include "encode/small_frames.hpp"

#include <algorithm>
#include <cmath>

#include "encode/bleed.hpp"
#include "encode/libav.hpp"

namespace chainreel {
namespace {

constexpr int kWidest = 800;  // pixels
constexpr int kMostPerSecond = 25;

}  // namespace

SmallSize small_size_of(int width, int height, FrameRate fps) {
  SmallSize size{std::min(width, kWidest), 1, fps, std::max(1L, long(std::ceil(fps.value() / kMostPerSecond)))};
  size.height = std::max(1, int(std::lround(double(height) * size.width / width)));
  size.fps.den *= int(size.every);
  return size;
}

SmallFrames::SmallFrames(int width, int height, FrameRate fps)
    : full_width_(width), full_height_(height), size_(small_size_of(width, height, fps)) {
  if (size_.width == width) return;
  scaler_ = check_allocated(
      libav().sws_getContext(width, height, AV_PIX_FMT_BGRA, size_.width, size_.height, AV_PIX_FMT_BGRA,
                     SWS_AREA | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT,
                     nullptr, nullptr, nullptr),
      "the scaler");
  small_ = Image(size_.width, size_.height);
}

SmallFrames::~SmallFrames() {
  libav().sws_freeContext(scaler_);
}

const Image& SmallFrames::shrink(const Image& frame) {
  if (scaler_ == nullptr) return frame;
  const Image* from = &frame;
  if (!frame.is_opaque()) {
    bled_ = frame;
    bleed_colors(bled_);
    from = &bled_;
  }
  const std::uint8_t* source[4] = {from->bgra.data(), nullptr, nullptr, nullptr};
  std::uint8_t* target[4] = {small_.bgra.data(), nullptr, nullptr, nullptr};
  const int source_stride[4] = {4 * full_width_, 0, 0, 0}, target_stride[4] = {4 * size_.width, 0, 0, 0};
  libav().sws_scale(scaler_, source, source_stride, 0, full_height_, target, target_stride);
  return small_;
}

}  // namespace chainreel

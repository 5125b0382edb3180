#include "encode/yuv444.hpp"

#include <cstddef>

namespace chainreel {
namespace {

constexpr int kBits = 14;

// Rows of Cb and Cr add up to zero: grey has no colour.
struct Weights {
  int b, g, r;
};
constexpr Weights kY = {4064, 40254, 11966}, kCb = {28784, -22189, -6595}, kCr = {-2639, -26145, 28784};
static_assert(kY.b + kY.g + kY.r == 56284);  // 876/255 * 2^14: white becomes 940
static_assert(kCb.b + kCb.g + kCb.r == 0 && kCr.b + kCr.g + kCr.r == 0);

constexpr std::uint16_t level(const Weights& w, int zero, const std::uint8_t* p) {
  return std::uint16_t((w.b * p[0] + w.g * p[1] + w.r * p[2] + (zero << kBits) + (1 << (kBits - 1))) >>
                       kBits);
}

}  // namespace

void convert_to_yuv444(const Image& image, const PlanesYuv444& planes) {
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* p = image.bgra.data() + std::ptrdiff_t(4) * image.width * y;
    const auto row = [&](int i) { return planes.plane[i] + std::ptrdiff_t(planes.stride[i]) * y; };
    std::uint16_t *luma = row(0), *cb = row(1), *cr = row(2);
    std::uint16_t* alpha = planes.plane[3] == nullptr ? nullptr : row(3);
    for (int x = 0; x < image.width; ++x, p += 4) {
      luma[x] = level(kY, 64, p);
      cb[x] = level(kCb, 512, p);
      cr[x] = level(kCr, 512, p);
      if (alpha != nullptr) alpha[x] = std::uint16_t((p[3] * 1023 + 127) / 255);
    }
  }
}

}  // namespace chainreel

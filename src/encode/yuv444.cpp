#include "encode/yuv444.hpp"

#include <cstddef>

#include "encode/bt709.hpp"

namespace chainreel {
namespace {

// 876/255 and 896/255 * 2^14: ten bits a component.
constexpr int kBits10 = 14;
constexpr LumaChroma kTo10 = {{4064, 40254, 11966}, {28784, -22189, -6595}, {-2639, -26145, 28784}};
static_assert(kTo10.white() == 56284);  // becomes 940
static_assert(kTo10.grey_is_grey());

constexpr std::uint16_t level(const Weights& w, int zero, const std::uint8_t* p) {
  return std::uint16_t((dot(w, p[0], p[1], p[2]) + (zero << kBits10) + (1 << (kBits10 - 1))) >> kBits10);
}

}  // namespace

void convert_to_yuv444(const Image& image, const PlanesYuv444& planes) {
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* p = image.bgra.data() + std::ptrdiff_t(4) * image.width * y;
    const auto row = [&](int i) { return planes.plane[i] + std::ptrdiff_t(planes.stride[i]) * y; };
    std::uint16_t *luma = row(0), *cb = row(1), *cr = row(2);
    std::uint16_t* alpha = planes.plane[3] == nullptr ? nullptr : row(3);
    for (int x = 0; x < image.width; ++x, p += 4) {
      luma[x] = level(kTo10.y, 64, p);
      cb[x] = level(kTo10.cb, 512, p);
      cr[x] = level(kTo10.cr, 512, p);
      if (alpha != nullptr) alpha[x] = std::uint16_t((p[3] * 1023 + 127) / 255);
    }
  }
}

}  // namespace chainreel

// BGRA pixels to planar 4:4:4 YCbCr with opacity, 10 bits in 16, ITU-R BT.709-6 limited range: the formulas
// of yuv420.hpp with 64, 876, 512 and 896 for 16, 219, 128 and 224. Opacity is straight and full range.
#pragma once

#include <cstdint>

#include "core/image.hpp"

namespace chainreel {

struct PlanesYuv444 {
  std::uint16_t* plane[4] = {};  // Y, Cb, Cr, and maybe opacity
  int stride[4] = {};            // numbers from row to row
};

void convert_to_yuv444(const Image& image, const PlanesYuv444& planes);

}  // namespace chainreel

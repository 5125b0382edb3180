// BGRA pixels to planar 4:2:0 YCbCr, ITU-R BT.709-6 sections 3 and 4, 8 bit limited range:
//
//   Y  = 16  + 219 (0.2126 R + 0.7152 G + 0.0722 B) / 255
//   Cb = 128 + 224 (B - luma) / (1.8556 * 255)      luma = 0.2126 R + 0.7152 G + 0.0722 B
//   Cr = 128 + 224 (R - luma) / (1.5748 * 255)
//
// in integers with 15 fractional bits, so the bytes are the same on every processor. The weights of Cb and Cr
// are rounded so that each row adds up to zero: grey has no colour. One chroma sample is the mean of 2x2
// pixels; it sits in their centre. Alpha is not looked at.
#pragma once

#include <cstdint>

#include "core/image.hpp"

namespace chainreel {

struct PlanesYuv420 {
  std::uint8_t* plane[3] = {};  // Y, Cb, Cr
  int stride[3] = {};           // bytes from row to row
};

// Both sides of the image must be even.
void convert_to_yuv420(const Image& image, const PlanesYuv420& planes);

// The same bytes without vector instructions: what the other is tested against.
void convert_to_yuv420_scalar(const Image& image, const PlanesYuv420& planes);

}  // namespace chainreel

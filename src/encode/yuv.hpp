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
#include "core/pixel_box.hpp"

namespace chainreel {

struct PlanesYuv420 {
  std::uint8_t* plane[3] = {};  // Y, Cb, Cr
  int stride[3] = {};           // bytes from row to row
};

// The part of the image that the box holds, whose sides must be even and within the image; the rest of the planes stays.
void convert_to_yuv420(const Image& image, const PixelBox& box, const PlanesYuv420& planes);

// The same bytes without vector instructions: what the other is tested against.
void convert_to_yuv420_scalar(const Image& image, const PixelBox& box, const PlanesYuv420& planes);

// BGRA pixels to planar 4:4:4 YCbCr with opacity, 10 bits in 16, ITU-R BT.709-6 limited range: the formulas
// of yuv420.hpp with 64, 876, 512 and 896 for 16, 219, 128 and 224. Opacity is straight and full range.

struct PlanesYuv444 {
  std::uint16_t* plane[4] = {};  // Y, Cb, Cr, and maybe opacity
  int stride[4] = {};            // numbers from row to row
};

void convert_to_yuv444(const Image& image, const PixelBox& box, const PlanesYuv444& planes);

// Luma and chroma of BT.709 as sums of integers: the same bytes on every machine. Internal.

struct Weights {
  int b, g, r;
};

constexpr int dot(const Weights& w, int b, int g, int r) {
  return w.b * b + w.g * g + w.r * r;
}

struct LumaChroma {
  Weights y, cb, cr;

  constexpr int white() const { return y.b + y.g + y.r; }
  constexpr bool grey_is_grey() const { return cb.b + cb.g + cb.r == 0 && cr.b + cr.g + cr.r == 0; }
};

}  // namespace chainreel

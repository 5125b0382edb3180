// Bodies that were drawn with several samples a pixel as pixels of the page, with a line around them. Needs no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pixel_box.hpp"

namespace chainreel {

// How a group of bodies is put down on the page.
struct BodyPaint {
  double opacity = 1;
  double radius = 0;                // of the line around them, px; 0: none
  std::array<float, 4> line{};      // its colour, premultiplied, r g b a
};

// Samples as they were read: red, green, blue and opacity, premultiplied; where the opacity is 0 there is no body.
struct BodySamples {
  PixelBox box;       // of the page's pixels that they cover; beyond it there is no body
  int per_side = 1;   // along a pixel's side: 1, 2 or 4
  std::vector<std::uint8_t> rgba;
};

class BodyPixels {
 public:
  // Looks for bodies and for what is near to them. The samples must live as long as this does.
  BodyPixels(const BodySamples& samples, const BodyPaint& paint);

  // The pixels of a part of the page, row by row, as the samples are; false where they would all be empty.
  bool draw(const PixelBox& part, std::vector<std::uint8_t>& rgba) const;

 private:
  using Bits = std::vector<std::uint64_t>;  // a row of samples

  bool is_empty(const PixelBox& part) const;
  void draw_row(int y, int first, int last, std::uint8_t* pixel) const;

  const BodySamples& samples_;
  BodyPaint paint_;
  int width_, height_;               // in samples
  std::vector<Bits> body_, near_;    // near_: bodies and all within the radius of one
};

}  // namespace chainreel

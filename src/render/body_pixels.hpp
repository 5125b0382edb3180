// Bodies that were drawn with several samples a pixel as pixels of the page, with a line around them. Needs no OpenGL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/pixel_box.hpp"
#include "picture/fade.hpp"

namespace chainreel {

// How a group of bodies is put down on the page.
struct BodyPaint {
  double opacity = 1;
  double radius = 0;                // of the line around them, px; 0: none
  std::array<float, 4> line{};      // its colour, premultiplied, r g b a
  bool is_shadow = false;           // no line: as far are edges blurred, in the line's colour, and fade with `fade` (SoftShadow)
  Fade fade{};
  int page_height = 1;  // px
};

// What samples have shown in a part of the page that is a multiple of 64 samples wide.
struct BodySamples {
  PixelBox box;       // of the page's pixels, or of a shadow's cells; beyond it there is no body
  int per_side = 2;   // samples along a pixel's side: 2 or 4
  std::vector<std::uint32_t> pixels;  // the means of their samples: blue, green, red, opacity from the lowest byte on, premultiplied
  std::vector<std::uint64_t> bits;    // row by row, for each sample whether it shows a body, the first in the lowest bit

  int words() const { return box.width * per_side / 64; }  // of a row of samples
  // Makes it empty and as large as the box.
  void reset(const PixelBox& box, int per_side);
  // What lies beyond the page bears no line.
  void cut_at(int page_width, int page_height);
};

class BodyPixels {
 public:
  // Looks for what is near to bodies. The samples must live as long as this does.
  BodyPixels(const BodySamples& samples, const BodyPaint& paint);

  // Whether a part of the box, which begins and ends with whole words of samples, shows nothing.
  bool is_empty(const PixelBox& part) const;
  // Puts a part of the box, `pixels` that are `stride` apart from row to row, over what is there.
  void draw_over(const PixelBox& part, std::uint32_t* pixels, std::ptrdiff_t stride) const;

 private:
  void find_near();
  bool is_empty(int y, int word) const;
  bool copies_inside(int y, int x, int behind, std::uint32_t* pixels) const;
  std::uint32_t pixel(int x, int y) const;
  std::uint32_t with_line(std::uint32_t mean, int around) const;

  const BodySamples& samples_;
  BodyPaint paint_;
  int words_, height_;               // of rows of samples
  std::vector<std::uint64_t> near_;  // bodies and all within the radius of one
  std::array<std::uint8_t, 256> faded_;  // levels times the opacity
};

}  // namespace chainreel

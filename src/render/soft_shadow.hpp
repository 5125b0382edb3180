// Shadows: how much of each cell bodies cover, blurred and put down on the page. What is soft has no fine detail, so that cells
// are larger than pixels where the blur is wide. Needs no OpenGL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/body_pixels.hpp"

namespace chainreel {

// How far edges are blurred, and on which cells: two sums over `reach` cells to each side, half as far across rows as along them,
// since what lies on the ground is seen from the side.
struct ShadowBlur {
  int pixels = 1;                   // along a cell's side
  int reach = 0, reach_across = 0;  // cells

  // `radius`: how far a body's shadow reaches out of it, px.
  explicit ShadowBlur(double radius);
  // How far a cell may colour the page around it, px.
  int rim() const { return pixels == 1 ? 2 * reach : (2 * reach + 2) * pixels; }
};

class SoftShadow {
 public:
  // `samples.pixels` are cells, so many as `paint` says pixels wide. The samples are no more needed afterwards.
  SoftShadow(const BodySamples& samples, const BodyPaint& paint);

  // Puts a part of the page, `pixels` that are `stride` apart from row to row, over what is there.
  void draw_over(const PixelBox& part, std::uint32_t* pixels, std::ptrdiff_t stride) const;

 private:
  void blur(const BodySamples& samples);
  void take_levels();
  bool find_levels(int row, std::vector<float>& line) const;

  BodyPaint paint_;
  ShadowBlur blur_;
  PixelBox box_;                     // of the cells that it darkens
  std::vector<std::uint32_t> sums_;  // their coverage, 255 * 256 where it is whole
  std::vector<float> levels_;        // their opacity, 0 to 255
};

}  // namespace chainreel

// LDR-FLIP: how much a pair of pictures differs, pixel by pixel, to an eye that flips between them. P.
// Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild: FLIP: A Difference
// Evaluator for Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), HPG 2020. Colours are
// filtered by what the eye resolves and compared in Hunt-adjusted L*a*b* (HyAB); edges and points that are in
// one of the pictures only raise it.
#pragma once

#include <array>
#include <vector>

#include "core/pixel_box.hpp"
#include "core/image.hpp"

namespace chainreel {

class Flip {
 public:
  // Beyond so many pixels no pixel bears on another's error: three standard deviations of the widest filter
  // at 67 pixels per degree, the paper's choice (0.7 m before a screen of 3840 pixels on 0.7 m).
  static constexpr int kReach = 10;
  using Taps = std::array<float, kReach + 1>;  // weights from the middle of a filter on to one side

  Flip();

  // Errors from 0 to 1 of the pixels in `box`, row by row of it. The box lies in the pictures, which are of
  // one size. What is transparent is seen on mid grey.
  std::vector<float> errors(const Image& expected, const Image& actual, const PixelBox& box) const;

 private:
  struct Seen;
  Seen look_at(const Image& image, const PixelBox& box) const;

  Taps achromatic_, red_green_, blue_yellow_wide_, blue_yellow_narrow_;  // contrast sensitivity
  Taps smooth_, edge_, point_;                                           // Gaussian and its derivatives
  float largest_;  // the colour difference of pure green and pure blue, to the power of the paper
};

}  // namespace chainreel

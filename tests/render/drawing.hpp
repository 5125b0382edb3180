// Small drawings and what can be measured on them. One pixel is 1/kSide of the page, so that sizes can be
// given in px.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/image.hpp"
#include "picture/picture.hpp"
#include "render/canvas.hpp"
#include "support/fonts.hpp"

namespace chainreel {

inline constexpr int kSide = 128;
inline constexpr double kPx = 1.0 / kSide;

inline constexpr Color kBlack = color_of(0x000000);
inline constexpr Color kNothing = {};

// A point given in pixels from the upper left corner, y down, as Image::at counts.
inline Point at_px(double x, double y) {
  return {x * kPx, 1 - y * kPx};
}

inline Image draw_items(std::initializer_list<Shape> shapes, Color background = color_of(0xFFFFFF)) {
  static Canvas& canvas = *new Canvas(kSide, kSide, fonts());  // the renderer's library may end before statics do
  Picture picture;
  picture.background = background;
  for (const Shape& shape : shapes) picture.add(shape);
  Image image;
  canvas.draw(picture, image);
  return image;
}

// 0 for white, 1 for black.
inline double darkness(const Image& image, int x, int y) {
  return (255 - image.at(x, y).g) / 255.0;
}

// What black shapes on white cover, in px^2.
inline double covered_area(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += darkness(image, x, y);
  return sum;
}

// The largest difference of any byte.
inline int largest_difference(const Image& one, const Image& other) {
  if (one.bgra.size() != other.bgra.size()) return 256;
  int largest = 0;
  for (std::size_t i = 0; i < one.bgra.size(); ++i)
    largest = std::max(largest, std::abs(int(one.bgra[i]) - int(other.bgra[i])));
  return largest;
}

}  // namespace chainreel

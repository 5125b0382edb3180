// A rectangle of whole pixels: x to the right, y down from the top row.
#pragma once

#include <algorithm>
#include <span>

namespace chainreel {

struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
  int right() const { return x + width; }    // the first column behind it
  int bottom() const { return y + height; }  // the first row below it
  bool empty() const { return width <= 0 || height <= 0; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

// From its sides; empty where they are the wrong way round.
inline PixelBox box_between(int left, int top, int right, int bottom) {
  return {left, top, std::max(right - left, 0), std::max(bottom - top, 0)};
}

inline PixelBox common_part(const PixelBox& a, const PixelBox& b) {
  return box_between(std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.right(), b.right()),
                     std::min(a.bottom(), b.bottom()));
}

// The least box that holds both; an empty one holds nothing.
inline PixelBox box_around(const PixelBox& a, const PixelBox& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return box_between(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.right(), b.right()),
                     std::max(a.bottom(), b.bottom()));
}

inline PixelBox box_around(std::span<const PixelBox> boxes) {
  PixelBox all;
  for (const PixelBox& box : boxes) all = box_around(all, box);
  return all;
}

}  // namespace chainreel

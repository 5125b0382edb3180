// A rectangle of pixels: x to the right, y down from the top row.
#pragma once

namespace chainreel {

struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

}  // namespace chainreel

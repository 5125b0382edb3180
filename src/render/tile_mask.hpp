// The tiles of the page that a path touches: a layer is coloured there only, each pixel once.
#pragma once

#include <cstdint>
#include <vector>

namespace chainreel {

// Whole pixels, y down from the page's top; the right and lower sides are outside.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool empty() const { return left >= right || top >= bottom; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

class TileMask {
 public:
  static constexpr int kSide = 32;  // px

  TileMask(int width, int height);

  void clear();
  // The tiles within `reach` px of the segment, and perhaps a few more beside them.
  void mark_segment(double ax, double ay, double bx, double by, double reach);
  // The tiles that meet the box.
  void mark_box(double left, double top, double right, double bottom);
  // The marked tiles inside `clip` as boxes that do not overlap; neighbours in a row are one box.
  void boxes(const PixelBox& clip, std::vector<PixelBox>& result) const;

 private:
  int columns_, rows_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace chainreel

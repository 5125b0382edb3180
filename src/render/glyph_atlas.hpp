// Bitmaps of glyphs, drawn by FreeType (grey-scale, no hinting) when first asked for and kept side by side in
// one sheet.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "picture/text.hpp"

namespace chainreel {

struct AtlasGlyph {
  int left = 0, top = 0;  // in the sheet
  int width = 0, height = 0;
  int offset_x = 0, offset_y = 0;  // from the pixel of the pen to the bitmap's upper left, y down
};

class GlyphAtlas {
 public:
  static constexpr int kLargestSide = 16384;  // of the sheet, px: Mesa's largest

  explicit GlyphAtlas(const Fonts& fonts, int largest_side = kLargestSide);
  ~GlyphAtlas();
  GlyphAtlas(const GlyphAtlas&) = delete;
  GlyphAtlas& operator=(const GlyphAtlas&) = delete;

  static constexpr int kSteps = 4;  // places of the pen within a pixel, horizontally

  // `size` of the em in 1/64 px; `step` is the pen's place right of its pixel in 1/kSteps px; `stroke`, 1/64 px: above 0,
  // its edge as a line so wide. Throws Error (exit 7) for sizes beyond what fits into the sheet.
  const AtlasGlyph& glyph(Face face, std::uint32_t index, int size, int step, int stroke = 0);

  // Forgets all glyphs if they have come to fill a large sheet. Not between glyph() and the drawing of it.
  void trim();

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint8_t>& sheet() const { return sheet_; }
  int version() const { return version_; }  // changes with every new glyph

 private:
  using Key = std::tuple<Face, std::uint32_t, int, int, int>;
  struct Rasteriser;

  void place(AtlasGlyph& glyph);
  void grow(int width, int height);

  std::unique_ptr<Rasteriser> rasteriser_;
  int largest_side_;
  int width_ = 0, height_ = 0;
  int shelf_x_ = 0, shelf_y_ = 0, shelf_height_ = 0;  // the row that is being filled
  int version_ = 0;
  std::vector<std::uint8_t> sheet_;
  std::map<Key, AtlasGlyph> glyphs_;
};

}  // namespace chainreel

// One palette for all pictures of a clip, by libimagequant. Internal to this floor.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/image.hpp"

namespace chainreel {

// Counts colours, then chooses: all of them where they are 255 at most; else the most frequent ones exactly
// as they are, so that flat areas keep their colour, and for the rest those that libimagequant finds. Nothing
// is dithered. Opacity is not looked at.
class PaletteMaker {
 public:
  static constexpr std::size_t kMostColors = 255;  // one of the 256 is left to "as before" in GIFs

  void count(const Image& image);
  std::vector<Pixel> choose() const;

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> counts_;  // 0xRRGGBB
};

// The nearest colour of a palette for each pixel, in RGB; ties go to the first.
class PaletteMap {
 public:
  explicit PaletteMap(std::vector<Pixel> palette) : palette_(std::move(palette)) {}
  const std::vector<Pixel>& palette() const { return palette_; }
  // width numbers a row, `stride` bytes from row to row.
  void map(const Image& image, std::uint8_t* indices, int stride);

 private:
  std::uint8_t nearest(std::uint32_t rgb);

  std::vector<Pixel> palette_;
  std::unordered_map<std::uint32_t, std::uint8_t> found_;
};

}  // namespace chainreel

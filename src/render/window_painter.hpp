// Fills the windows of a batch in memory, without OpenGL: what moves over a page is small, and to hand small
// parts to its renderer takes ten times as long as to draw them. Gives the bytes that OpenGL's software
// renderer gives by the shaders.
#pragma once

#include <array>
#include <cstdint>

#include "core/large_memory.hpp"
#include "render/fill_windows.hpp"
#include "render/windows.hpp"

namespace chainreel {

class WindowPainter {
 public:
  // For pages of this size.
  WindowPainter(int width, int height, const WindowFillers& fillers = window_fillers().front());

  // Draws a run over the page, whose rows lie behind one another: premultiplied, blue in the lowest byte. Not
  // of bodies.
  void draw(const Run& run, const Windows& windows, const Batch& batch, const GlyphAtlas& atlas,
            std::uint32_t* page);

 private:
  using Levels = std::array<std::uint32_t, 256>;  // a colour at each coverage

  void draw_trail(const Run& run, const Windows& windows);
  void draw_flat(const PixelBox& box, const float* fill, std::uint32_t* page) const;
  void draw_glyph(const PixelBox& box, const float* numbers, const GlyphAtlas& atlas, std::uint32_t* page);
  void draw_layer(const PixelBox& box, const float* fill, std::uint32_t* page);
  void draw_cells(const PixelBox& box, const float* numbers, const CellSheet& sheet,
                  std::uint32_t* page) const;
  void draw_levels(const PixelBox& box, const std::uint8_t* levels, std::ptrdiff_t stride,
                   std::uint32_t* page) const;

  std::uint32_t* at(std::uint32_t* page, int x, int y) const { return page + std::ptrdiff_t(y) * width_ + x; }
  void set_levels(const float* fill);

  int width_, height_;
  const WindowFillers* fillers_;
  PixelBytes trail_;  // of the page: the path that is drawn; made when first used
  std::array<float, 4> color_of_levels_{-1, -1, -1, -1};
  Levels levels_{};
};

}  // namespace chainreel

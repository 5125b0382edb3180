// Shapes that are given by formulas, filled into their windows: by vectors as wide as the processor has them,
// with the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pixel_box.hpp"
#include "render/batch.hpp"

namespace chainreel {

struct WindowFillers {
  int lanes;  // pixels at once
  // A capsule, ellipse, arc, polygon or what fades, over a page whose rows are `stride` apart; `numbers` are
  // its instance's.
  void (*fill)(Primitive primitive, const PixelBox& box, const float* numbers, std::uint32_t* page,
               std::ptrdiff_t stride);
  // A piece of a path, into its levels.
  void (*fill_trail)(const PixelBox& box, const float* numbers, std::uint8_t* trail, std::ptrdiff_t stride);
};

// Those that this processor has, the widest first.
std::span<const WindowFillers> window_fillers();

}  // namespace chainreel

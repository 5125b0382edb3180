// Colours.
#pragma once

#include <cstdint>

namespace chainreel {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  double a = 0;  // opacity 0 to 1; 0 draws nothing

  Color faded(double opacity) const { return {r, g, b, a * opacity}; }
  friend bool operator==(const Color&, const Color&) = default;
};

// From 0xRRGGBB, opaque unless said.
constexpr Color color_of(std::uint32_t rgb, double a = 1) {
  return {std::uint8_t(rgb >> 16), std::uint8_t(rgb >> 8), std::uint8_t(rgb), a};
}

}  // namespace chainreel

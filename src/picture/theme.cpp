#include "picture/theme.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {

double grown(double part, double size, double text_scale) {
  if (!(text_scale > kEvenGrowth)) return part * text_scale;
  const double held = std::clamp(std::log2(size / size::kTick), 0.0, 1.0);
  return part * text_scale * std::pow(kEvenGrowth / text_scale, held);
}

double scaled(double size, double text_scale) {
  return std::max(grown(size, size, text_scale), size::kTick);
}

const Theme& light_theme() {
  static const Theme theme = {
      .background = color_of(0xFFFFFF),
      .ink = color_of(0x1A1A1A),
      .muted = color_of(0x5F6670),
      .base = color_of(0x8A9099),
      .rule = color_of(0xC3C8CF),
      .grid = color_of(0xE3E6EA),
      .link = {color_of(0x56B4E9), color_of(0xE69F00), color_of(0x009E73), color_of(0xCC79A7)},
      .ellipse = color_of(0x5159FD),
      .torque = color_of(0x873C56),
      .velocity = color_of(0x7D700F),
      .force = color_of(0x193C09),
      .constraint = color_of(0x490490),
      .curve = {color_of(0x0072B2), color_of(0xC25700), color_of(0x005F46)},
      .side_a = color_of(0x0072B2),
      .side_b = color_of(0xC25700),
      .axis = {color_of(0xC62F28), color_of(0x1E7B34), color_of(0x2250C4)},
  };
  return theme;
}

const Theme& dark_theme() {
  static const Theme theme = {
      .background = color_of(0x14171C),
      .ink = color_of(0xF2F2F2),
      .muted = color_of(0xA9B0BA),
      .base = color_of(0x8A9099),
      .rule = color_of(0x4A515C),
      .grid = color_of(0x2A2F37),
      .link = {color_of(0x56B4E9), color_of(0xE69F00), color_of(0x009E73), color_of(0xCC79A7)},
      .ellipse = color_of(0x8FFEBF),
      .torque = color_of(0xE04F9F),
      .velocity = color_of(0xC4FA58),
      .force = color_of(0xD8AEC0),
      .constraint = color_of(0xAABE7D),
      .curve = {color_of(0x56B4E9), color_of(0xE69F00), color_of(0x009E73)},
      .side_a = color_of(0x56B4E9),
      .side_b = color_of(0xE69F00),
      .axis = {color_of(0xFF6B61), color_of(0x5BD37A), color_of(0x7DA2FF)},
  };
  return theme;
}

bool is_dark(const Theme& theme) {
  const Color& ground = theme.background;
  return ground.r + ground.g + ground.b < 3 * 128;
}

const Theme& theme_named(std::string_view name) {
  return name == "dark" ? dark_theme() : light_theme();
}

}  // namespace chainreel

// Colours for up to twelve curves in one plot. Contrast with the background is at least 3.5; colour is never
// the only cue: markers differ, and so do the dashes of neighbours. Further curves take the colours again with
// other markers and dashes.
#include <algorithm>
#include <array>

#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr std::array<std::uint32_t, kCurveLooks> kOnLight = {0x0072B2, 0xC25700, 0x005F46, 0x873C56,
                                                             0x5159FD, 0x7D700F, 0xC2378A, 0x00828F,
                                                             0x7A3FB0, 0x8A5A2B, 0x1A1A1A, 0x5F6670};
constexpr std::array<std::uint32_t, kCurveLooks> kOnDark = {0x56B4E9, 0xE69F00, 0x2FCB9C, 0xE04F9F,
                                                            0x8F9BFF, 0xC4FA58, 0xFF9DB8, 0x4FD8E8,
                                                            0xC8A2F5, 0xD2A679, 0xF2F2F2, 0xA9B0BA};

bool is_dark(Color c) {
  return c.r + c.g + c.b < 3 * 128;
}

}  // namespace

CurveStyle curve_style(int index, const Theme& theme, double text_scale) {
  const int look = index % kCurveLooks, round = index / kCurveLooks;
  const auto& colors = is_dark(theme.background) ? kOnDark : kOnLight;
  CurveStyle style;
  style.color = color_of(colors[std::size_t(look)]);
  style.marker = Marker(1 + (look + 5 * round) % kCurveLooks);
  style.dash = Dash((look + round) % 4);
  style.marker_size = size::kMarker * std::max(1.0, text_scale);
  return style;
}

}  // namespace chainreel

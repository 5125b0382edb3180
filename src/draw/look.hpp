// Colours and sizes of one chain's drawing, decided once per clip from the theme and the camera.
#pragma once

#include <algorithm>
#include <cmath>

#include "draw/skeleton.hpp"
#include "picture/camera.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// A link is this much of the shortest link wide where that is less than size::kLinkWidth.
inline constexpr double kLinkWidthOfShortest = 0.09;
// Links of this width go with rails of full size.
inline constexpr double kWidthOfFullRails = 0.030;
// Chains of very short links keep links that can be seen.
inline constexpr double kThinnestLink = 0.010;

struct ChainLook {
  const Theme* theme = nullptr;
  double strength = 1;  // of all colours, mixed with the background: 1 full, 0.25 an onion skin
  double marks = 1;  // size of the marks of joints, rails, ground and end effector; below 1 in small panels
  double link_width = size::kLinkWidth;
  double joint_disc = size::kJointDisc;
  double rails = 1;  // size of rails and carriages: that of the marks, less where links are thin
  bool filled = true;  // false: outlines only
  double stroke = 1;   // width of outlines, of their own
};

inline ChainLook look_of(const Skeleton& skeleton, const Camera& camera, const Theme& theme,
                         double strength = 1, double marks = 1) {
  const double bound = kLinkWidthOfShortest * skeleton.shortest_link * camera.scale;
  const double width =
      skeleton.links.empty() ? size::kLinkWidth : std::clamp(bound, kThinnestLink, size::kLinkWidth);
  return {&theme,
          strength,
          marks,
          width,
          std::min(marks * size::kJointDisc, 1.1 * width),
          marks * std::min(1.0, width / kWidthOfFullRails),
          true};
}

// An opaque colour between the background (0) and `color` (1): onion skins hide what lies behind them, so
// that their inner outlines do not shine through.
inline Color toned(Color color, const ChainLook& look) {
  const Color back = look.theme->background;
  const auto mix = [&](std::uint8_t from, std::uint8_t to) {
    return std::uint8_t(std::lround(from + look.strength * (double(to) - from)));
  };
  return {mix(back.r, color.r), mix(back.g, color.g), mix(back.b, color.b), color.a};
}

// Of the inside of a body: none where only outlines are drawn.
inline Color filling(Color color, const ChainLook& look) {
  return look.filled ? toned(color, look) : Color{};
}

// `tint` of the way from the background to the colour.
inline Color tinted(Color color, double tint, const ChainLook& look) {
  ChainLook paler = look;
  paler.strength *= tint;
  return toned(color, paler);
}

}  // namespace chainreel

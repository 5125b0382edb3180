// The marks of joints, rails, ground, end effector and centre of mass: each at a place of the page, in the sizes
// of the theme.
#pragma once

#include <algorithm>
#include <cmath>

#include "draw/robot/skeleton.hpp"
#include "picture/camera.hpp"
#include "picture/picture.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// A link is this much of the shortest link wide where that is less than size::kLinkWidth.
inline constexpr double kLinkWidthOfShortest = 0.09;
// Links of this width go with rails of full size.
inline constexpr double kWidthOfFullRails = 0.030;
// The radius of a point mass at most, units of H and widths of its link.
inline constexpr double kPointMass = 0.034, kPointOfLink = 0.95;
// Chains of very short links keep links that can be seen.
inline constexpr double kThinnestLink = 0.010;

// Colours and sizes of one chain's drawing, decided once per clip from the theme and the camera.
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
          true,
          theme.lines};
}

// With links no wider than that.
inline ChainLook narrowed(ChainLook look, double widest) {
  look.link_width = std::min(look.link_width, widest);
  look.joint_disc = std::min(look.joint_disc, 1.1 * look.link_width);
  look.rails = std::min(look.rails, look.marks * look.link_width / kWidthOfFullRails);
  return look;
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

// The colour of the inside of a body: none where only outlines are drawn.
inline Color filling(Color color, const ChainLook& look) {
  return look.filled ? toned(color, look) : Color{};
}

// `tint` of the way from the background to the colour.
inline Color tinted(Color color, double tint, const ChainLook& look) {
  ChainLook paler = look;
  paler.strength *= tint;
  return toned(color, paler);
}

// Sizes that belong to the marks alone, in units of H.
inline constexpr double kPinHeight = 0.038;  // from a joint on the ground down to the ground line
inline constexpr double kPinWidth = 0.052;
inline constexpr double kCarrierLength =
    0.118;                                 // of a carriage with a rail of its own: seen on both sides of that
inline constexpr double kLargestMark = size::kCarriageLength / 2;  // around a place of the chain, half of its size
inline constexpr double kRailEnd = 0.018;  // of a rail beyond the outermost end of its carriage

constexpr double carriage_length(bool carrier) {
  return carrier ? kCarrierLength : size::kCarriageLength;
}
// How far a rail goes on beyond the outermost middle of its carriage.
constexpr double rail_overhang(bool carrier) {
  return carriage_length(carrier) / 2 + kRailEnd;
}

// Places this far from the page would only overflow in the renderer, in units of H: a run that diverged.
inline constexpr double kOffPage = 100;

inline bool is_drawable(Point p) {
  return std::abs(p.x) < kOffPage && std::abs(p.y) < kOffPage;  // false for NaN, too
}

// A straight part of a rail or body on the page, from `a` to `b`.
struct PageLine {
  Point a, b;
};

void draw_line(Picture& picture, PageLine line, double width, Color color, int clip);
// Dashes from its beginning on.
void draw_dashed_line(Picture& picture, PageLine line, double width, Color color, int clip);
void draw_revolute(Picture& picture, Point center, const ChainLook& look, int clip);
// How far the end of a drawn link reaches from the place that it ends in.
inline double link_end(const ChainLook& look) { return (look.link_width + look.stroke * size::kLinkOutline) / 2; }
void draw_end_effector(Picture& picture, Point center, const ChainLook& look, int clip);
// A circle with two opposite black quarters.
void draw_center_of_mass(Picture& picture, Point center, const ChainLook& look, int clip);

// The way of a carriage's middle, prolonged by the overhang of its rail.
PageLine with_overhang(PageLine way, bool carrier, const ChainLook& look);
// Two lines with end stops.
void draw_rail(Picture& picture, PageLine rail, Color fill, const ChainLook& look, int clip);
// The block that slides along `along`; `carrier`: it has a rail of its own.
void draw_carriage(Picture& picture, Point center, Point along, bool carrier, Color fill,
                   const ChainLook& look, int clip);

// The line of the ground through `line`, hatched on the side of `inside` (a unit vector).
void draw_ground(Picture& picture, PageLine line, Point inside, const ChainLook& look, int clip);
// A joint that is pinned to the ground below it; `center` is the joint.
void draw_pin(Picture& picture, Point center, const ChainLook& look, int clip);
// The ground under a rail that is fixed to it, along the whole rail.
void draw_rail_ground(Picture& picture, PageLine rail, const ChainLook& look, int clip);

// How far the ground reaches from a pinned joint, from a rail's middle line.
double pin_depth();
double rail_ground_depth();

}  // namespace chainreel

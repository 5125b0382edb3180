// The marks of joints, rails, ground and end effector: each at a place of the page, in the sizes of the
// theme.
#pragma once

#include <cmath>

#include "draw/look.hpp"
#include "picture/picture.hpp"

namespace chainreel {

// Sizes that belong to the marks alone, in units of H.
inline constexpr double kPinHeight = 0.038;  // from a joint on the ground down to the ground line
inline constexpr double kPinWidth = 0.052;
inline constexpr double kCarrierLength =
    0.118;                                 // of a carriage with a rail of its own: seen on both sides of that
inline constexpr double kRailEnd = 0.018;  // of a rail beyond the outermost end of its carriage

constexpr double carriage_length(bool carrier) {
  return carrier ? kCarrierLength : size::kCarriageLength;
}
// Of a rail beyond the outermost middle of its carriage.
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
void draw_revolute(Picture& picture, Point center, const ChainLook& look, int clip);
void draw_end_effector(Picture& picture, Point center, const ChainLook& look, int clip);

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

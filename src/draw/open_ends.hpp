// What curves of effective mass share: dashed axes, and the ends of curves that lead out of the scene. Internal.
#pragma once

#include <cmath>

#include "draw/ellipse.hpp"
#include "draw/joints.hpp"

namespace chainreel {

// On the page, axes shorter than this have no direction (an axis of an ellipsoid towards the viewer).
inline constexpr double kNoLength = 1e-9;
inline constexpr double kEllipseFill = 0.16;     // opacity
inline constexpr double kSilhouetteFill = 0.12;  // of an ellipsoid
inline constexpr int kFadeSteps = 16;  // of the fill; each changes it by 1 %, below what can be seen

inline double length_of(Point v) {
  return std::hypot(v.x, v.y);
}
inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
inline bool contains(const Rect& r, Point p) {
  return p.x >= r.x0 && p.x <= r.x1 && p.y >= r.y0 && p.y <= r.y1;
}
inline Rect inset(const Rect& r, double by) {
  return {r.x0 + by, r.y0 + by, r.x1 - by, r.y1 - by};
}

// Symmetric about its middle.
void draw_dashed(Picture& picture, PageLine line, double width, Color color, int clip);

// How far from p along the unit vector d the scene ends; 0 where p is outside and d leads away.
double way_out(const Rect& scene, Point p, Point d);

// The part of a convex polygon where dot(p - through, inward) >= 0; one corner more at most.
Polygon cut(const Polygon& polygon, Point through, Point inward);

// An infinity sign on the way from the centre along d, off the end effector's disc; nothing where the style wants
// none.
void draw_infinity_along(Picture& picture, Point center, Point d, double half_width,
                         const EllipseStyle& style, int clip);

}  // namespace chainreel

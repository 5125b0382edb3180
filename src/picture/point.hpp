// Places, directions and rectangles on the page.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace chainreel {

struct Point {
  double x = 0, y = 0;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
};

inline double norm(Point v) {
  return std::hypot(v.x, v.y);
}
inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
inline double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}
// (1, 0) where v has no length.
inline Point unit(Point v) {
  const double size = norm(v);
  return size > 0 ? (1 / size) * v : Point{1, 0};
}
// A quarter turn to the left.
inline Point normal_to(Point along) {
  return {-along.y, along.x};
}

struct Rect {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
};

// Cuts a-b to its part inside the box; false, and both as they were, where there is none. Y.-D. Liang,
// B. Barsky, A new concept and method for line clipping (1984).
inline bool cut_segment(const Rect& box, Point& a, Point& b) {
  double t0 = 0, t1 = 1;
  const Point d = b - a;
  const std::array<std::array<double, 2>, 4> sides = {
      {{-d.x, a.x - box.x0}, {d.x, box.x1 - a.x}, {-d.y, a.y - box.y0}, {d.y, box.y1 - a.y}}};
  for (const auto& [p, q] : sides) {
    if (p == 0) {
      if (q < 0) return false;
    } else if (p < 0) {
      t0 = std::max(t0, q / p);
    } else {
      t1 = std::min(t1, q / p);
    }
  }
  if (!(t0 <= t1)) return false;
  const Point from = a;
  if (t0 > 0) a = from + t0 * d;
  if (t1 < 1) b = from + t1 * d;
  return true;
}

inline bool overlap(const Rect& a, const Rect& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

inline bool holds(const Rect& outer, const Rect& inner) {
  return inner.x0 >= outer.x0 && inner.x1 <= outer.x1 && inner.y0 >= outer.y0 && inner.y1 <= outer.y1;
}

// The least box that holds both.
inline Rect around(const Rect& a, const Rect& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

inline Point center_of(const Rect& r) {
  return {(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2};
}

// Of p from the segment a-b.
inline double distance_to(Point p, Point a, Point b) {
  const Point way = b - a;
  const double squared = dot(way, way);
  const double share = squared > 0 ? std::clamp(dot(p - a, way) / squared, 0.0, 1.0) : 0;
  return norm(p - (a + share * way));
}

inline Point nearest_in(const Rect& r, Point p) {
  return {std::clamp(p.x, r.x0, r.x1), std::clamp(p.y, r.y0, r.y1)};
}
inline bool is_within(const Rect& a, const Rect& b) {
  return a.x0 >= b.x0 && a.x1 <= b.x1 && a.y0 >= b.y0 && a.y1 <= b.y1;
}

inline Rect moved(const Rect& box, Point by) {
  return {box.x0 + by.x, box.y0 + by.y, box.x1 + by.x, box.y1 + by.y};
}

inline Rect widened(const Rect& box, double by) {
  return {box.x0 - by, box.y0 - by, box.x1 + by, box.y1 + by};
}

}  // namespace chainreel

// Places and directions on the page.
#pragma once

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

}  // namespace chainreel

// What words and signs of a chart keep clear of.
#pragma once

#include <algorithm>
#include <vector>

#include "picture/point.hpp"

namespace chainreel {

inline constexpr double kClearance = 0.009;  // half a marker and a little air
inline constexpr int kNoCurve = -1;

struct Obstacles {
  struct Line {
    Point a, b;
    int curve;
  };
  Rect inside;  // all must lie here
  std::vector<Line> lines;
  std::vector<Rect> boxes;

  // `curve` may pass through.
  bool is_free(const Rect& box, int curve = kNoCurve) const {
    const Rect wide = widened(box, kClearance);
    return holds(inside, box) &&
           std::none_of(boxes.begin(), boxes.end(),
                        [&](const Rect& other) { return overlap(other, wide); }) &&
           std::none_of(lines.begin(), lines.end(), [&](Line line) {
             return (curve == kNoCurve || line.curve != curve) && cut_segment(wide, line.a, line.b);
           });
  }
};

}  // namespace chainreel

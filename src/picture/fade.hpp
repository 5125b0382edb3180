// How shapes that lead out of a part of the page fade before its edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "picture/point.hpp"

namespace chainreel {

// Over which last stretch before each edge of `scene` things fade, units of H; 0: not at all. Nothing is seen outside of it.
struct Fade {
  Rect scene;
  double left = 0, right = 0, bottom = 0, top = 0;

  bool is_finite() const {
    return std::isfinite(scene.x0 + scene.y0 + scene.x1 + scene.y1 + left + right + bottom + top);
  }
  bool any() const { return left > 0 || right > 0 || bottom > 0 || top > 0; }
  // 1 within the scene, 0 from an edge on that things fade towards.
  double opacity_at(Point p) const {
    double opacity = 1;
    for (const auto& [inside, stretch] : {std::pair{p.x - scene.x0, left},
                                          {scene.x1 - p.x, right},
                                          {p.y - scene.y0, bottom},
                                          {scene.y1 - p.y, top}})
      if (stretch > 0) opacity = std::min(opacity, std::clamp(inside / stretch, 0.0, 1.0));
    return opacity;
  }
  // By this share of the stretches: where the opacity is at least that.
  Rect inset(double share) const {
    return {scene.x0 + share * left, scene.y0 + share * bottom, scene.x1 - share * right, scene.y1 - share * top};
  }
  friend bool operator==(const Fade& a, const Fade& b) {
    return a.scene.x0 == b.scene.x0 && a.scene.y0 == b.scene.y0 && a.scene.x1 == b.scene.x1 && a.scene.y1 == b.scene.y1 &&
           a.left == b.left && a.right == b.right && a.bottom == b.bottom && a.top == b.top;
  }
};

}  // namespace chainreel

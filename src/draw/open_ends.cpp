#include "draw/open_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chainreel {
namespace {

constexpr double kDash = 0.012, kGap = 0.008;

// The sign with its middle as near to `at` as the scene allows.
void draw_infinity(Picture& picture, Point at, const EllipseStyle& style, int clip) {
  const TextStyle text{Face::label, size::kSymbol * style.text_scale, style.theme->ellipse, Align::left};
  const TextLine sign = lay_out_text(*style.fonts, "\u221E", text);
  const Point half{sign.box.width() / 2, sign.box.height() / 2};
  const Rect& scene = style.scene;
  const Point middle{
      std::clamp(at.x, std::min(scene.x0 + half.x, scene.x1), std::max(scene.x1 - half.x, scene.x0)),
      std::clamp(at.y, std::min(scene.y0 + half.y, scene.y1), std::max(scene.y1 - half.y, scene.y0))};
  draw_text(picture, sign, {middle.x - half.x - sign.box.x0, middle.y - half.y - sign.box.y0}, clip);
}

}  // namespace

void draw_dashed(Picture& picture, PageLine line, double width, Color color, int clip) {
  const Point u = unit(line.b - line.a);
  const double length = length_of(line.b - line.a);
  // Symmetric about the middle, which is the middle of a dash.
  const int half_count = int((length / 2 - kDash / 2) / (kDash + kGap)) + 1;
  const Point middle = 0.5 * (line.a + line.b);
  for (int i = -half_count; i <= half_count; ++i) {
    const double from = std::max(i * (kDash + kGap) - kDash / 2, -length / 2);
    const double to = std::min(i * (kDash + kGap) + kDash / 2, length / 2);
    if (from < to) draw_line(picture, {middle + from * u, middle + to * u}, width, color, clip);
  }
}

double way_out(const Rect& scene, Point p, Point d) {
  const auto to_edge = [](double x, double dx, double low, double high) {
    if (std::abs(dx) < kNoLength) return std::numeric_limits<double>::infinity();
    return ((dx > 0 ? high : low) - x) / dx;
  };
  return std::max(0.0,
                  std::min(to_edge(p.x, d.x, scene.x0, scene.x1), to_edge(p.y, d.y, scene.y0, scene.y1)));
}

Polygon cut(const Polygon& polygon, Point through, Point inward) {
  Polygon kept;
  kept.paint = polygon.paint;
  for (int i = 0; i < polygon.count; ++i) {
    const Point p = polygon.corners[std::size_t(i)],
                q = polygon.corners[std::size_t((i + 1) % polygon.count)];
    const double at_p = dot(p - through, inward), at_q = dot(q - through, inward);
    if (at_p >= 0) kept.corners[std::size_t(kept.count++)] = p;
    if ((at_p >= 0) != (at_q >= 0)) {
      kept.corners[std::size_t(kept.count++)] = p + (at_p / (at_p - at_q)) * (q - p);
    }
  }
  return kept;
}

void draw_infinity_along(Picture& picture, Point center, Point d, double half_width,
                         const EllipseStyle& style, int clip) {
  if (!style.signs) return;
  const double clear = 0.45 * size::kSymbol * style.text_scale + 0.008;  // half a sign and some air
  const double along = way_out(style.scene, center, d) - clear;
  if (along > clear + size::kEndEffector) {
    draw_infinity(picture, center + along * d, style, clip);
    return;
  }
  // Too near to the edge: beside the band, on the side that has more room.
  const Point side = normal_to(d), foot = center + std::max(along, 0.0) * d;
  const bool left = way_out(style.scene, foot, side) > way_out(style.scene, foot, -1 * side);
  draw_infinity(picture, foot + ((left ? 1 : -1) * (half_width + clear)) * side, style, clip);
}

}  // namespace chainreel

#include "draw/page/arrow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/robot/joints.hpp"

namespace chainreel {
namespace {

constexpr double kHeadOfShort = 0.7;   // of an arrow that is not much longer than its head
constexpr double kSecondHead = 0.75;   // of a head's length behind the first one
constexpr double kPieceOfTurn = 0.06;  // rad, of the straight pieces of a turn in space: 0.5 % off the circle
constexpr double kSpeck = 1e-6;        // units of H: no direction can be seen
constexpr double kSameShape = 1e-9;    // relative, to tell a circle from an ellipse

void draw_head(Picture& picture, Point tip, Point base, double half_width, Color color, int clip) {
  const Point side = half_width * normal_to(unit(tip - base));
  picture.add(Polygon{{tip, base + side, base - side}, 3, {color, {}, 0}}, clip);
}

// Round ends count as part of a dash.
void draw_dashes(Picture& picture, Point from, Point to, const ArrowStyle& style, int clip) {
  const double width = style.size * size::kArrowShaft, r = width / 2;
  const double dash = style.size * size::kDash, pitch = dash + style.size * size::kDashGap;
  const Point along = unit(to - from);
  const double length = norm(to - from);
  for (double s = 0; s < length; s += pitch) {
    const double end = std::min(s + dash, length);
    if (end - s > 2 * r)
      draw_line(picture, {from + (s + r) * along, from + (end - r) * along}, width, style.color, clip);
  }
}

bool is_circle(Point u, Point w) {
  const double a = norm(u), b = norm(w);
  return std::abs(a - b) <= kSameShape * a && std::abs(u.x * w.x + u.y * w.y) <= kSameShape * a * b;
}

Point on_curve(Point center, Point u, Point w, double angle) {
  return center + std::cos(angle) * u + std::sin(angle) * w;
}

void draw_curve(Picture& picture, Point center, Point u, Point w, double from, double to, double width,
                Color color, int clip) {
  if (is_circle(u, w)) {
    const double side = cross(u, w) > 0 ? 1 : -1, start = std::atan2(u.y, u.x);
    picture.add(Arc{center, norm(u), start + side * from, side * (to - from), width, color}, clip);
    return;
  }
  const int pieces = std::max(2, int(std::ceil(std::abs(to - from) / kPieceOfTurn)));
  Trail path;
  path.color = color;
  for (int i = 0; i <= pieces; ++i)
    path.points.push_back({on_curve(center, u, w, from + (to - from) * i / pieces), width, 1});
  picture.add(std::move(path), clip);
}

}  // namespace

void draw_arrow(Picture& picture, Point tail, Point v, const ArrowStyle& style, int clip) {
  const double length = norm(v);
  if (!(length > kSpeck)) return;
  const Point along = unit(v), tip = tail + v;
  const double head = std::min(style.size * size::kArrowHead, kHeadOfShort * length);
  const double grow = head / size::kArrowHead, half_width = grow * size::kArrowHeadWidth / 2;
  const Point base = tip - head * along;
  // The shaft ends inside of the head, so that no seam shows; round ends begin behind the tail.
  const Point end = base + 0.2 * head * along;
  const double width = std::min(style.size, grow) * size::kArrowShaft;
  if (style.dashed) {
    draw_dashes(picture, tail, end, style, clip);
  } else {
    draw_line(picture, {tail, end}, width, style.color, clip);
  }
  draw_head(picture, tip, base, half_width, style.color, clip);
  const Point back = -kSecondHead * head * along;
  if (style.cut) draw_head(picture, tip + back, base + back, half_width, style.color, clip);
}

void draw_turn(Picture& picture, Point center, Point u, Point w, double turn, const ArrowStyle& style,
               int clip) {
  const double radius = std::max(norm(u), norm(w));
  if (!(radius > kSpeck) || turn == 0) return;
  const double sign = turn > 0 ? 1 : -1;
  // The angle that a head takes.
  const double head = std::min(style.size * size::kArrowHead / radius, kHeadOfShort * std::abs(turn));
  const double grow = head * radius / size::kArrowHead;
  const auto head_at = [&](double angle) {
    const Point tip = on_curve(center, u, w, angle), base = on_curve(center, u, w, angle - sign * head);
    if (norm(tip - base) > kSpeck)
      draw_head(picture, tip, base, grow * size::kArrowHeadWidth / 2, style.color, clip);
  };
  const double end = turn / 2;
  draw_curve(picture, center, u, w, -turn / 2, end - 0.8 * sign * head,
             std::min(style.size, grow) * size::kArrowShaft, style.color, clip);
  head_at(end);
  if (style.cut) head_at(end - kSecondHead * sign * head);
}

void draw_ring(Picture& picture, Point center, Point u, Point w, Color color, int clip) {
  draw_curve(picture, center, u, w, 0, 2 * std::numbers::pi, size::kLinkOutline, color, clip);
}

}  // namespace chainreel

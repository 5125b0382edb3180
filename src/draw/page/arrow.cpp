#include "draw/page/arrow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/robot/joints.hpp"

namespace chainreel {
namespace {

constexpr double kHeadOfShort = 0.7;   // of an arrow that is not much longer than its head
constexpr double kBreakAt = 0.45;      // of the way from the tail to the tip
constexpr double kBreakGap = 0.011, kBreakStroke = 0.022;  // of an open break and its two strokes, units of H
constexpr double kBreakSlant = 0.35;   // of a stroke's length, that it leans along the shaft
constexpr double kPieceOfTurn = 0.06;  // rad, of the straight pieces of a turn in space: 0.5 % off the circle
constexpr double kSpeck = 1e-6;        // units of H: no direction can be seen
constexpr double kSameShape = 1e-9;    // relative, to tell a circle from an ellipse
constexpr double kCasing = 0.0028;     // units of H, on each side

// What lies below an arrow, for one that has a casing. `grown`: the size of its head, of the usual one: what is hardly there would be a speck of casing.
std::optional<ArrowStyle> casing_of(const ArrowStyle& style, double grown) {
  if (!style.casing) return std::nullopt;
  ArrowStyle wide = style;
  wide.color = style.casing->faded(style.color.a);
  wide.casing.reset();
  wide.around = std::min({1.0, style.size, grown}) * kCasing;
  return wide;
}

void draw_head(Picture& picture, Point tip, Point base, double half_width, const ArrowStyle& style, int clip) {
  const Point side = half_width * normal_to(unit(tip - base));
  picture.add(Polygon{{tip, base + side, base - side}, 3, {style.color, style.color, 2 * style.around}}, clip);
}

// The strokes on both sides of a break about `middle`, across the shaft that runs along the unit vector `along`.
void draw_break(Picture& picture, Point middle, Point along, const ArrowStyle& style, int clip) {
  if (style.around > 0) return;  // the gap shows what lies below
  const double gap = style.broken * style.size * kBreakGap, length = style.broken * style.size * kBreakStroke;
  const Point stroke = (length / 2) * (normal_to(along) + kBreakSlant * along);
  for (const double side : {-0.5, 0.5}) {
    const Point at = middle + (side * gap) * along;
    draw_line(picture, {at - stroke, at + stroke}, 0.6 * style.lines * style.size * size::kArrowShaft, style.color, clip);
  }
}

// Round ends count as part of a dash.
void draw_dashes(Picture& picture, Point from, Point to, const ArrowStyle& style, int clip) {
  const double width = style.lines * style.size * size::kArrowShaft, r = width / 2;
  const double dash = style.size * size::kDash, pitch = dash + style.size * size::kDashGap;
  const Point along = unit(to - from);
  const double length = norm(to - from);
  for (double s = 0; s < length; s += pitch) {
    const double end = std::min(s + dash, length);
    if (end - s > 2 * r)
      draw_line(picture, {from + (s + r) * along, from + (end - r) * along}, width + 2 * style.around, style.color, clip);
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
  if (const auto casing = casing_of(style, grow)) draw_arrow(picture, tail, v, *casing, clip);
  const Point base = tip - head * along;
  // The shaft ends inside of the head, so that no seam shows; round ends begin behind the tail.
  const Point end = base + 0.2 * head * along;
  const double width = style.lines * std::min(style.size, grow) * size::kArrowShaft;
  const auto draw_shaft = [&](Point from, Point to) {
    if (style.dashed)
      draw_dashes(picture, from, to, style, clip);
    else
      draw_line(picture, {from, to}, width + 2 * style.around, style.color, clip);
  };
  if (style.broken > 0) {
    const Point middle = tail + kBreakAt * v, half = (style.broken * style.size * kBreakGap / 2) * along;
    draw_shaft(tail, middle - half);
    draw_shaft(middle + half, end);
    draw_break(picture, middle, along, style, clip);
  } else {
    draw_shaft(tail, end);
  }
  draw_head(picture, tip, base, half_width, style, clip);
}

void draw_turn(Picture& picture, Point center, Point u, Point w, double turn, const ArrowStyle& style,
               int clip) {
  const double radius = std::max(norm(u), norm(w));
  if (!(radius > kSpeck) || turn == 0) return;
  const double sign = turn > 0 ? 1 : -1;
  // The angle that a head takes.
  const double head = std::min(style.size * size::kArrowHead / radius, kHeadOfShort * std::abs(turn));
  const double grow = head * radius / size::kArrowHead;
  if (const auto casing = casing_of(style, grow)) draw_turn(picture, center, u, w, turn, *casing, clip);
  const double width = style.lines * std::min(style.size, grow) * size::kArrowShaft + 2 * style.around;
  const double begin = -turn / 2, tip_at = turn / 2, end = tip_at - 0.8 * sign * head;
  if (style.broken > 0) {
    const double middle = begin + kBreakAt * turn, half = sign * style.broken * style.size * kBreakGap / 2 / radius;
    draw_curve(picture, center, u, w, begin, middle - half, width, style.color, clip);
    draw_curve(picture, center, u, w, middle + half, end, width, style.color, clip);
    const Point along = (-std::sin(middle)) * u + std::cos(middle) * w;
    if (norm(along) > kSpeck)
      draw_break(picture, on_curve(center, u, w, middle), sign * unit(along), style, clip);
  } else {
    draw_curve(picture, center, u, w, begin, end, width, style.color, clip);
  }
  const Point tip = on_curve(center, u, w, tip_at), base = on_curve(center, u, w, tip_at - sign * head);
  if (norm(tip - base) > kSpeck)
    draw_head(picture, tip, base, grow * size::kArrowHeadWidth / 2, style, clip);
}

void draw_ring(Picture& picture, Point center, Point u, Point w, Color color, int clip) {
  draw_curve(picture, center, u, w, 0, 2 * std::numbers::pi, size::kLinkOutline, color, clip);
}

}  // namespace chainreel

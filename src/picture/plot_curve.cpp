// Curves, markers and zones: everything that lies inside of a frame is cut at its box here, so that no output
// needs a clip for it.
#include <algorithm>
#include <cmath>

#include "picture/plot.hpp"
#include "picture/point.hpp"
#include "picture/thin_points.hpp"

namespace chainreel {
namespace {

constexpr double kDashOn = 0.018, kDashOff = 0.008, kDotOn = 0.004, kDotOff = 0.007;
constexpr double kShortestDash = 0.0004;  // round ends make a dot of it
constexpr double kHalo = 0.0016;          // of the background around a marker, where curves cross

using Path = std::vector<Point>;

bool same(Point a, Point b) {
  return a.x == b.x && a.y == b.y;
}

// What of the path lies inside the box, in pieces.
std::vector<Path> cut_path(const Rect& box, const Path& path) {
  std::vector<Path> pieces;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Point a = path[i], b = path[i + 1];
    if (!cut_segment(box, a, b)) continue;
    if (pieces.empty() || !same(pieces.back().back(), a)) pieces.push_back({a});
    pieces.back().push_back(b);
  }
  return pieces;
}

// Page points, one path between two gaps.
std::vector<Path> paths_of(const PlotFrame& frame, std::span<const Point> data) {
  std::vector<Path> paths(1);
  for (const Point& p : data) {
    if (frame.can_show(p))
      paths.back().push_back(frame.at(p));
    else if (!paths.back().empty())
      paths.emplace_back();
  }
  return paths;
}

Path thinned(const Path& path) {
  Path kept;
  for (const std::size_t i : column_points(path)) kept.push_back(path[i]);
  return kept;
}

// Lengths of what is drawn and what is not, in turn. Round ends add a line's width to each dash.
std::vector<double> pattern_of(const CurveStyle& style) {
  const auto on = [&](double length) { return std::max(kShortestDash, length - style.width); };
  const auto off = [&](double length) { return length + style.width; };
  switch (style.dash) {
    case Dash::solid:
      return {};
    case Dash::dashed:
      return {on(kDashOn), off(kDashOff)};
    case Dash::dotted:
      return {on(kDotOn), off(kDotOff)};
    case Dash::even:
      return {on(kDashOn), off(kDashOn)};
    case Dash::dash_dot:
      return {on(kDashOn), off(kDashOff), on(kDotOn), off(kDashOff)};
  }
  return {};
}

void add_point(Trail& trail, Point p, double width, bool is_on) {
  trail.points.push_back({p, width, is_on ? 1.0 : 0.0});
}

// A jump with nothing in between: pieces of no opacity at both ends are not drawn.
void lift_pen(Trail& trail, double width) {
  if (!trail.points.empty() && trail.points.back().alpha > 0)
    add_point(trail, trail.points.back().p, width, false);
}

void add_dashed(Trail& trail, const Path& path, const CurveStyle& style) {
  const std::vector<double> pattern = pattern_of(style);
  std::size_t part = 0;
  double left = pattern.empty() ? HUGE_VAL : pattern[0];
  bool is_on = true;
  lift_pen(trail, style.width);
  if (!trail.points.empty()) add_point(trail, path.front(), style.width, false);
  add_point(trail, path.front(), style.width, true);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Point at = path[i];
    const Point d = path[i + 1] - at;
    double rest = std::sqrt(d.x * d.x + d.y * d.y);
    while (rest > left) {
      at = at + (left / rest) * (path[i + 1] - at);
      rest -= left;
      add_point(trail, at, style.width, is_on);
      is_on = !is_on;
      add_point(trail, at, style.width, is_on);
      part = (part + 1) % pattern.size();
      left = pattern[part];
    }
    left -= rest;
    add_point(trail, path[i + 1], style.width, is_on);
  }
}

Polygon polygon_at(Point center, std::initializer_list<Point> corners, double scale, const Paint& paint) {
  Polygon polygon;
  for (const Point& corner : corners) polygon.corners[std::size_t(polygon.count++)] = center + scale * corner;
  polygon.paint = paint;
  return polygon;
}

void add_polygon_marker(Picture& picture, Point at, Marker marker, double size, const Paint& paint,
                        int clip) {
  switch (marker) {
    case Marker::square:
    case Marker::open_square:
      picture.add(polygon_at(at, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.45 * size, paint), clip);
      return;
    case Marker::diamond:
    case Marker::open_diamond:
      picture.add(polygon_at(at, {{-1, 0}, {0, -1.15}, {1, 0}, {0, 1.15}}, 0.60 * size, paint), clip);
      return;
    case Marker::triangle_down:
    case Marker::open_triangle_down:
      picture.add(polygon_at(at, {{-1, 0.62}, {1, 0.62}, {0, -1.1}}, 0.60 * size, paint), clip);
      return;
    default:
      picture.add(polygon_at(at, {{-1, -0.62}, {1, -0.62}, {0, 1.1}}, 0.60 * size, paint), clip);
  }
}

// Two strokes: x or +.
void add_stroke_marker(Picture& picture, Point at, bool is_plus, double size, Color color, Color halo,
                       int clip) {
  const double reach = (is_plus ? 0.55 : 0.42) * size, thin = 0.11 * size;
  const Point one = is_plus ? Point{reach, 0} : Point{reach, reach};
  const Point other = is_plus ? Point{0, reach} : Point{-reach, reach};
  for (const auto& [radius, ink] : {std::pair(thin + kHalo / 2, halo), std::pair(thin, color)})
    for (const Point& arm : {one, other})
      picture.add(Capsule{at - arm, at + arm, radius, {ink, {}, 0}}, clip);
}

}  // namespace

void draw_path(Picture& picture, std::span<const Point> page_points, const CurveStyle& style, int clip) {
  if (page_points.size() < 2) return;
  Trail trail{{}, style.color};
  add_dashed(trail, Path(page_points.begin(), page_points.end()), style);
  picture.add(std::move(trail), clip);
}

void draw_curve(Picture& picture, const PlotFrame& frame, std::span<const Point> data,
                const CurveStyle& style, const Theme& theme) {
  Trail trail{{}, style.color};
  for (const Path& path : paths_of(frame, data))
    for (const Path& piece : cut_path(frame.box, thinned(path))) add_dashed(trail, piece, style);
  if (!trail.points.empty()) picture.add(std::move(trail));
  if (style.marker == Marker::none) return;
  for (const Point& p : data) {
    if (!frame.can_show(p)) continue;
    const Point at = frame.at(p);
    const double slack = 1e-9;  // a point on the edge is in
    if (at.x < frame.box.x0 - slack || at.x > frame.box.x1 + slack || at.y < frame.box.y0 - slack ||
        at.y > frame.box.y1 + slack)
      continue;
    draw_marker(picture, at, style.marker, style.marker_size, style.color, theme.background);
  }
}

void draw_marker(Picture& picture, Point at, Marker marker, double size, Color color, Color background,
                 int clip) {
  const Paint filled{color, background, kHalo};
  const Paint open{background, color, 0.2 * size};
  switch (marker) {
    case Marker::none:
      return;
    case Marker::disc:
      picture.add(Ellipse{at, {size / 2, 0}, {0, size / 2}, filled}, clip);
      return;
    case Marker::ring:
      picture.add(Ellipse{at, {0.43 * size, 0}, {0, 0.43 * size}, open}, clip);
      return;
    case Marker::cross:
    case Marker::plus:
      add_stroke_marker(picture, at, marker == Marker::plus, size, color, background, clip);
      return;
    case Marker::square:
    case Marker::triangle:
    case Marker::diamond:
    case Marker::triangle_down:
      add_polygon_marker(picture, at, marker, size, filled, clip);
      return;
    default:
      add_polygon_marker(picture, at, marker, 0.88 * size, open, clip);
  }
}

void draw_key(Picture& picture, Point at, double length, const CurveStyle& style, const Theme& theme) {
  const Point ends[] = {at, {at.x + length, at.y}};
  draw_path(picture, ends, style);
  draw_marker(picture, {at.x + length / 2, at.y}, style.marker, style.marker_size, style.color,
              theme.background);
}

void draw_zone(Picture& picture, const PlotFrame& frame, Point low, Point high, Color fill) {
  const Rect& box = frame.box;
  const auto place = [](double value, const Axis& axis, double at, double least, double most) {
    if (axis.scale == Scale::log && !(value > 0)) return least;
    return std::clamp(at, least, most);
  };
  const double x0 = place(low.x, frame.x, frame.at_x(low.x), box.x0, box.x1);
  const double x1 = place(high.x, frame.x, frame.at_x(high.x), box.x0, box.x1);
  const double y0 = place(low.y, frame.y, frame.at_y(low.y), box.y0, box.y1);
  const double y1 = place(high.y, frame.y, frame.at_y(high.y), box.y0, box.y1);
  if (!(x1 > x0) || !(y1 > y0)) return;
  picture.add(polygon_at({}, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 1, {fill, {}, 0}));
}

void draw_guide(Picture& picture, const PlotFrame& frame, Point from, Point to, const CurveStyle& style) {
  if (!frame.can_show(from) || !frame.can_show(to)) return;
  Point a = frame.at(from), b = frame.at(to);
  if (!cut_segment(frame.box, a, b)) return;
  const Point ends[] = {a, b};
  draw_path(picture, ends, style);
}

}  // namespace chainreel

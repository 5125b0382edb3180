#include "draw/ellipse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "draw/joints.hpp"

namespace chainreel {
namespace {

constexpr double kFill = 0.16;            // opacity
constexpr double kSilhouetteFill = 0.12;  // of an ellipsoid
constexpr double kDash = 0.012, kGap = 0.008;
constexpr int kFadeSteps = 16;  // of the fill; each changes it by 1 %, below what can be seen
// On the page, axes shorter than this have no direction (an axis of an ellipsoid towards the viewer).
constexpr double kNoLength = 1e-9;

double length_of(Point v) {
  return std::hypot(v.x, v.y);
}
double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
bool contains(const Rect& r, Point p) {
  return p.x >= r.x0 && p.x <= r.x1 && p.y >= r.y0 && p.y <= r.y1;
}

// A semi-axis on the page: the whole vector, or the direction of an infinite one (projected, not unit).
struct PageAxis {
  Point v;
  bool open = false;
};

std::vector<PageAxis> page_axes(const std::vector<MassAxis>& axes, Point center, const Camera& camera,
                                const EllipseStyle& style) {
  std::vector<PageAxis> projected;
  for (const MassAxis& axis : axes) {
    const Point d{camera.right.dot(axis.direction), camera.up.dot(axis.direction)};
    if (!axis.mass) {
      if (length_of(d) > 1e-6) projected.push_back({d, true});
      continue;
    }
    const Point v = (*axis.mass * style.per_kg) * d;
    const bool leaves = !contains(style.scene, center + v) && !contains(style.scene, center - v);
    projected.push_back({leaves ? d : v, leaves});
  }
  return projected;
}

// The ellipse on the page whose support function is sqrt(sum (a_i . n)^2): the silhouette of the ellipsoid
// with the projected semi-axes a_i; for two perpendicular a_i just the ellipse itself.
std::array<Point, 2> silhouette(const std::vector<PageAxis>& axes) {
  double xx = 0, xy = 0, yy = 0;
  for (const PageAxis& a : axes) {
    xx += a.v.x * a.v.x;
    xy += a.v.x * a.v.y;
    yy += a.v.y * a.v.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double mean = (xx + yy) / 2, deviation = std::hypot((xx - yy) / 2, xy);
  const Point u{std::cos(angle), std::sin(angle)};
  return {std::sqrt(mean + deviation) * u, std::sqrt(std::max(mean - deviation, 0.0)) * normal_to(u)};
}

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

void draw_closed(Picture& picture, const std::vector<PageAxis>& axes, Point center, const EllipseStyle& style,
                 int clip) {
  const Color line = style.theme->ellipse;
  const bool solid = axes.size() > 2;
  const auto [u, v] = silhouette(axes);
  picture.add(Ellipse{center, u, v, {line.faded(solid ? kSilhouetteFill : kFill), line, size::kEllipseLine}},
              clip);
  for (std::size_t i = 0; solid && i < axes.size(); ++i) {
    const auto [a, b] = silhouette({axes[i], axes[(i + 1) % axes.size()]});
    if (length_of(b) > kNoLength) picture.add(Ellipse{center, a, b, {{}, line, size::kEllipseAxis}}, clip);
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const PageLine axis{center - axes[i].v, center + axes[i].v};
    if (i == 0) {
      draw_line(picture, axis, size::kEllipseAxis, line, clip);
    } else {
      draw_dashed(picture, axis, size::kEllipseAxis, line, clip);
    }
  }
}

// How far from p along the unit vector d the scene ends; 0 where p is outside and d leads away.
double way_out(const Rect& scene, Point p, Point d) {
  const auto to_edge = [](double x, double dx, double low, double high) {
    if (std::abs(dx) < kNoLength) return std::numeric_limits<double>::infinity();
    return ((dx > 0 ? high : low) - x) / dx;
  };
  return std::max(0.0,
                  std::min(to_edge(p.x, d.x, scene.x0, scene.x1), to_edge(p.y, d.y, scene.y0, scene.y1)));
}

// The whole line through p along the unit vector d, from edge to edge of the scene, fading over its last
// stretches.
void draw_fading_line(Picture& picture, Point p, Point d, const EllipseStyle& style, int clip) {
  // Into the scene and out of it, where the line meets it at all.
  double in = -std::numeric_limits<double>::infinity(), out = -in;
  const auto narrow = [&](double x, double dx, double low, double high) {
    if (std::abs(dx) < kNoLength) {
      if (x < low || x > high) out = in;
      return;
    }
    in = std::max(in, std::min((low - x) / dx, (high - x) / dx));
    out = std::min(out, std::max((low - x) / dx, (high - x) / dx));
  };
  narrow(p.x, d.x, style.scene.x0, style.scene.x1);
  narrow(p.y, d.y, style.scene.y0, style.scene.y1);
  if (!(in < out)) return;
  const double fade = std::min(size::kEllipseFade, (out - in) / 2);
  const Point a = p + in * d, b = p + out * d;
  Capsule line{a + fade * d, b - fade * d, size::kEllipseLine / 2, {style.theme->ellipse, {}, 0}};
  picture.add(line, clip);
  line.alpha_b = 0;
  for (const auto& [inner, edge] : {std::pair{a + fade * d, a}, {b - fade * d, b}}) {
    line.a = inner;
    line.b = edge;
    picture.add(line, clip);
  }
}

// The part of a convex polygon where dot(p - through, inward) >= 0; one corner more at most.
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

// The fill between the lines: scenes one in the other, ever smaller, each cut to the band, so that no seam
// shows.
void draw_fading_fill(Picture& picture, Point center, Point half_width, const EllipseStyle& style, int clip) {
  const Color fill = style.theme->ellipse.faded(1 - std::pow(1 - kFill, 1.0 / kFadeSteps));
  for (int i = 0; i < kFadeSteps; ++i) {
    const double inset = size::kEllipseFade * (i + 0.5) / kFadeSteps;
    const Rect r{style.scene.x0 + inset, style.scene.y0 + inset, style.scene.x1 - inset,
                 style.scene.y1 - inset};
    if (!(r.x0 < r.x1 && r.y0 < r.y1)) return;
    Polygon band{{Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {fill, {}, 0}};
    band = cut(cut(band, center + half_width, -1 * half_width), center - half_width, half_width);
    if (band.count >= 3) picture.add(band, clip);
  }
}

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

// An infinity sign on the way from the centre along d, off the end effector's disc.
void draw_infinity_along(Picture& picture, Point center, Point d, double half_width,
                         const EllipseStyle& style, int clip) {
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

void draw_open(Picture& picture, const std::vector<PageAxis>& axes, Point center, Point direction,
               const EllipseStyle& style, int clip) {
  const Point d = unit(direction), n = normal_to(d);
  double squared = 0;
  for (const PageAxis& axis : axes) {
    if (!axis.open) squared += dot(axis.v, n) * dot(axis.v, n);
  }
  const double half_width = std::sqrt(squared);
  draw_fading_fill(picture, center, half_width * n, style, clip);
  for (const double side : {-1.0, 1.0}) {
    draw_fading_line(picture, center + (side * half_width) * n, d, style, clip);
  }
  draw_dashed(picture, {center - half_width * n, center + half_width * n}, size::kEllipseAxis,
              style.theme->ellipse, clip);
  draw_infinity_along(picture, center, d, half_width, style, clip);
  draw_infinity_along(picture, center, -1 * d, half_width, style, clip);
}

}  // namespace

std::vector<MassAxis> mass_axes(const EffectiveMass& effective) {
  const Eigen::Index rows = effective.mobility.size();
  const double largest = rows == 0 ? 0 : effective.mobility.maxCoeff();
  std::vector<MassAxis> axes;
  for (Eigen::Index i = 0; i < rows; ++i) {
    MassAxis axis;
    axis.direction = Eigen::Vector3d::Zero();
    for (Eigen::Index j = 0; j < rows; ++j) {
      axis.direction += effective.directions(j, i) * effective.basis.directions[std::size_t(j)];
    }
    const double mobility = effective.mobility(i);
    if (mobility > kSingularFraction * largest) axis.mass = 1 / mobility;
    axes.push_back(axis);
  }
  return axes;
}

std::optional<double> smallest_mass(const std::vector<MassAxis>& axes) {
  return axes.empty() ? std::nullopt : axes.back().mass;
}

MassScale mass_scale(std::vector<double> smaller_semi_axes, double bar_length) {
  MassScale scale;
  scale.bar_length = bar_length;
  std::erase_if(smaller_semi_axes, [](double m) { return !(std::isfinite(m) && m > 0); });
  if (smaller_semi_axes.empty()) return scale;
  const auto middle = smaller_semi_axes.begin() + std::ptrdiff_t(smaller_semi_axes.size() / 2);
  std::nth_element(smaller_semi_axes.begin(), middle, smaller_semi_axes.end());
  const double decade = std::pow(10.0, std::floor(std::log10(*middle)));
  double nearest = decade;
  for (const double step : {2.0, 5.0, 10.0}) {
    // Nearest in ratio, as lengths are compared by eye.
    if (std::abs(std::log(*middle / (step * decade))) < std::abs(std::log(*middle / nearest)))
      nearest = step * decade;
  }
  scale.bar_kg = nearest;
  return scale;
}

void draw_mass_ellipse(Picture& picture, const std::vector<MassAxis>& axes, Point center,
                       const Camera& camera, const EllipseStyle& style, int clip) {
  if (!contains(style.scene, center)) return;
  const std::vector<PageAxis> projected = page_axes(axes, center, camera, style);
  Point open{};
  bool all_open = false;
  for (const PageAxis& axis : projected) {
    if (!axis.open) continue;
    // A second, different open direction leaves nothing bounded.
    if (length_of(open) > 0 && std::abs(dot(unit(open), normal_to(unit(axis.v)))) > 1e-6) all_open = true;
    open = axis.v;
  }
  if (all_open) {
    draw_infinity_along(picture, center, {1, 0}, 0, style, clip);
    draw_infinity_along(picture, center, {-1, 0}, 0, style, clip);
  } else if (length_of(open) > 0) {
    draw_open(picture, projected, center, open, style, clip);
  } else if (!projected.empty()) {
    draw_closed(picture, projected, center, style, clip);
  }
}

}  // namespace chainreel

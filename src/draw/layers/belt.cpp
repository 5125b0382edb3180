#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "draw/layers/ellipse.hpp"
#include "draw/layers/fading.hpp"

namespace chainreel {
namespace {

constexpr double kFlat = 0.0003;     // units of H: what a chord may lie off the curve
constexpr int kDeepest = 10;         // halvings of a part of the curve
constexpr int kOutlinePoints = 180;  // of the silhouette of a surface

// A belt in one plane: p(a) = (cos a d0 + sin a d1) / (m0 cos^2 a + m1 sin^2 a) on the page, m0 <= m1.
struct PlaneBelt {
  Point d0, d1;           // axes on the page, units of H for 1 kg
  double m0 = 0, m1 = 0;  // 1/kg

  Point at(double a) const {
    const double c = std::cos(a), s = std::sin(a), r = 1 / (m0 * c * c + m1 * s * s);
    return (r * c) * d0 + (r * s) * d1;
  }
  // Where the curve comes nearer than kBeyond; 0 where all of it does.
  double start() const {
    const double least = std::max(norm(d0), kNoLength) / kBeyond;
    return m0 >= least || m1 <= least ? 0 : std::asin(std::sqrt((least - m0) / (m1 - m0)));
  }
};

// Towards each edge that a curve of these points leaves the scene through, over what it leads out and `most`
// at most.
Fade fade_about(const Rect& scene, const std::vector<Point>& points, double most) {
  Fade fade{scene};
  for (const Point p : points) {
    fade.left = std::max(fade.left, scene.x0 - p.x);
    fade.right = std::max(fade.right, p.x - scene.x1);
    fade.bottom = std::max(fade.bottom, scene.y0 - p.y);
    fade.top = std::max(fade.top, p.y - scene.y1);
  }
  for (double* stretch : {&fade.left, &fade.right, &fade.bottom, &fade.top})
    *stretch = std::min(*stretch, most);
  return fade;
}

void halve(const PlaneBelt& belt, double a, double b, int depth, std::vector<double>& angles) {
  const double middle = (a + b) / 2;
  const Point p = belt.at(a), q = belt.at(b), m = belt.at(middle);
  const bool flat = norm(m - 0.5 * (p + q)) < kFlat && norm(q - p) < 4 * kLongPiece;
  if (depth >= kDeepest || flat) return angles.push_back(b);
  halve(belt, a, middle, depth + 1, angles);
  halve(belt, middle, b, depth + 1, angles);
}

// Angles of a quarter, from where the curve begins to the minor axis.
std::vector<double> quarter(const PlaneBelt& belt) {
  const double from = belt.start(), to = std::numbers::pi / 2;
  std::vector<double> angles{from};
  for (int i = 0; i < 4; ++i)
    halve(belt, from + i * (to - from) / 4, from + (i + 1) * (to - from) / 4, 0, angles);
  return angles;
}

// With its inside where `fill` is seen, and its outline where the line has a width.
void draw_plane_belt(Picture& picture, const PlaneBelt& belt, Point center, double width, Color fill,
                     Color color, const EllipseStyle& style, int clip) {
  const std::vector<double> angles = quarter(belt);
  std::vector<Point> upper, lower;  // halves, from one end of the long axis to the other
  for (const double a : angles) upper.push_back(center + belt.at(a));
  for (std::size_t i = angles.size() - 1; i-- > 0;)
    upper.push_back(center + belt.at(std::numbers::pi - angles[i]));
  for (const Point p : upper) lower.push_back(2 * center - p);
  std::vector<Point> both = upper;
  both.insert(both.end(), lower.begin(), lower.end());
  const Fade fade = fade_about(style.scene, both, style.fade);
  // Along the long axis the curve goes one way only, so that strips across it hold the inside.
  if (fill.a > 0) fill_between(picture, upper, lower, fill, fade, clip);
  if (!(width > 0)) return;
  if (angles.front() > 0) {
    draw_outline(picture, upper, width, color, fade, clip);
    draw_outline(picture, lower, width, color, fade, clip);
    return;
  }
  upper.insert(upper.end(), lower.begin() + 1, lower.end());
  draw_outline(picture, upper, width, color, fade, clip);
}

// The largest sqrt(1 + t^2) / (ee + 2 en t + nn t^2): how far the surface reaches where the camera sees the
// direction e, over all t along the line of sight. Its derivative vanishes where nn t^3 + (2 nn - ee) t + 2
// en = 0.
double seen_reach(double ee, double en, double nn, double most) {
  const auto reach = [&](double t) {
    const double felt = ee + 2 * en * t + nn * t * t;
    return felt > 0 ? std::min(most, std::sqrt(1 + t * t) / felt) : most;
  };
  if (!(nn > 0)) return most;
  const double p = 2 - ee / nn, q = 2 * en / nn;
  const double discriminant = q * q / 4 + p * p * p / 27;
  if (discriminant > 0) {
    const double root = std::sqrt(discriminant);
    return reach(std::cbrt(-q / 2 + root) + std::cbrt(-q / 2 - root));
  }
  const double size = 2 * std::sqrt(-p / 3);
  if (!(size > 0)) return reach(0);
  const double angle = std::acos(std::clamp(3 * q / (p * size), -1.0, 1.0)) / 3;
  double farthest = 0;
  for (int k = 0; k < 3; ++k)
    farthest = std::max(farthest, reach(size * std::cos(angle - 2 * k * std::numbers::pi / 3)));
  return farthest;
}

// Draws the surface 1 / (u^T A u) with A in 1/kg, as the camera sees it.
void draw_surface(Picture& picture, const Eigen::Matrix3d& A, Point center, const Camera& camera,
                  const EllipseStyle& style, int clip) {
  const Eigen::Vector3d n = camera.toward_viewer;
  const double most = kBeyond / style.per_unit;
  const auto reach = [&](double angle) {
    const Eigen::Vector3d e = std::cos(angle) * camera.right + std::sin(angle) * camera.up;
    return style.per_unit * seen_reach(e.dot(A * e), e.dot(A * n), n.dot(A * n), most);
  };
  double longest = 0;
  for (int i = 0; i < kOutlinePoints; ++i) {
    const double angle = i * std::numbers::pi / kOutlinePoints;
    if (reach(angle) > reach(longest)) longest = angle;
  }
  const auto at = [&](double angle) {
    return reach(longest + angle) * Point{std::cos(longest + angle), std::sin(longest + angle)};
  };
  // Upper and lower half over the same places along the longest direction.
  const Point along{std::cos(longest), std::sin(longest)}, across = normal_to(along);
  std::vector<Point> outline, half;
  for (int i = 0; i <= 2 * kOutlinePoints; ++i) {
    const Point p = at(i * std::numbers::pi / kOutlinePoints);
    outline.push_back(center + p);
    if (i <= kOutlinePoints) half.push_back({dot(p, along), dot(p, across)});
  }
  const Fade fade = fade_about(style.scene, outline, style.fade);
  for (std::size_t i = 1; i < half.size(); ++i) half[i].x = std::min(half[i].x, half[i - 1].x);
  const auto height = [&](double x) {
    const auto after =
        std::lower_bound(half.begin(), half.end(), x, [](Point p, double v) { return p.x > v; });
    if (after == half.begin() || after == half.end()) return 0.0;
    const Point a = *(after - 1), b = *after;
    return a.x > b.x ? b.y + (x - b.x) / (a.x - b.x) * (a.y - b.y) : b.y;
  };
  for (std::size_t i = 0; style.draws_below() && i + 1 < half.size(); ++i) {
    const Point a = half[i], b = half[i + 1];
    const auto page = [&](double x, double y) { return center + x * along + y * across; };
    fill_piece(picture, {page(a.x, a.y), page(b.x, b.y), page(b.x, -height(-b.x)), page(a.x, -height(-a.x))},
               fill_of(style, kSilhouetteFill), fade, clip);
  }
  for_each_stroke(style, [&](const Stroke& stroke) {
    draw_outline(picture, outline, stroke.width(size::kEllipseLine, style), stroke.color, fade, clip);
  });
}

}  // namespace

void draw_belt(Picture& picture, const std::vector<MassAxis>& axes, Point center, const Camera& camera,
               const EllipseStyle& style, int clip) {
  std::vector<Point> page;  // for 1 kg
  std::vector<double> mobility;
  std::vector<bool> open;
  Spread spread;  // of the ellipse that the belt touches at its axes
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (const MassAxis& axis : axes) {
    const Point d = style.per_unit * Point{camera.right.dot(axis.direction), camera.up.dot(axis.direction)};
    const double m = axis.mass ? 1 / *axis.mass : 0;
    page.push_back(d);
    mobility.push_back(m);
    open.push_back(!axis.mass && norm(d) > kNoLength * style.per_unit);
    if (open.back()) spread.add(2 * kBeyond * unit(d));
    if (axis.mass) spread.add(*axis.mass * d);
    A += m * axis.direction * axis.direction.transpose();
  }
  const bool solid = axes.size() > 2;
  if (solid && mobility.back() > 0) draw_surface(picture, A, center, camera, style, clip);
  const Fade whole = fade_of(style, center, spread);
  const auto draw_planes = [&](double width, Color fill, Color stroke) {
    for (std::size_t i = 0; i + 1 < axes.size(); ++i)
      for (std::size_t j = i + 1; j < axes.size(); ++j)
        if (mobility[j] > 0)  // else infinite in this whole plane
          draw_plane_belt(picture, {page[i], page[j], mobility[i], mobility[j]}, center, width, fill, stroke,
                          style, clip);
  };
  if (style.draws_below() && !solid) draw_planes(0, fill_of(style), {});
  for_each_stroke(style, [&](const Stroke& stroke) {
    draw_planes(stroke.width(solid ? size::kEllipseAxis : size::kEllipseLine, style), {}, stroke.color);
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (!axes[i].mass) continue;
      const Point v = *axes[i].mass * page[i];
      draw_axis(picture, center, v, i > 0, stroke.width(size::kEllipseAxis, style), stroke.color,
                fade_before_length(center, v, *axes[i].mass, whole, style), clip, style.hole);
    }
  });
  for (std::size_t i = 0; style.draws_above() && i < axes.size(); ++i) {
    if (open[i]) {
      // Beside the curve only the sign at each end says that there is no end.
      draw_infinities(picture, center, unit(page[i]), 0, style, clip);
      continue;
    }
    if (!axes[i].mass) continue;
    std::vector<Point> others;
    for (std::size_t k = 0; k < axes.size(); ++k)
      if (k != i && axes[k].mass && style.unnamed != nullptr) others.push_back(*axes[k].mass * page[k]);
    draw_length(picture, center, *axes[i].mass * page[i], i, *axes[i].mass, 0, style, clip, others);
  }
}

}  // namespace chainreel

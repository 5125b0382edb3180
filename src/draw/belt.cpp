#include "draw/belt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "draw/open_ends.hpp"

namespace chainreel {
namespace {

constexpr double kFlat = 0.0003;     // units of H: what a chord may lie off the curve
constexpr double kLongPiece = 0.02;  // units of H: fading lines change their opacity in steps of this length
constexpr double kBeyond = 3;        // units of H: farther than any corner of a page from any place on it
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
  double start(double per_unit) const {
    const double least = per_unit / kBeyond;
    return m0 >= least || m1 <= least ? 0 : std::asin(std::sqrt((least - m0) / (m1 - m0)));
  }
};

void halve(const PlaneBelt& belt, double a, double b, int depth, std::vector<double>& angles) {
  const double middle = (a + b) / 2;
  const Point p = belt.at(a), q = belt.at(b), m = belt.at(middle);
  const bool flat = length_of(m - 0.5 * (p + q)) < kFlat && length_of(q - p) < 4 * kLongPiece;
  if (depth >= kDeepest || flat) return angles.push_back(b);
  halve(belt, a, middle, depth + 1, angles);
  halve(belt, middle, b, depth + 1, angles);
}

// Angles of a quarter, from where the curve begins to the minor axis.
std::vector<double> quarter(const PlaneBelt& belt, double per_unit) {
  const double from = belt.start(per_unit), to = std::numbers::pi / 2;
  std::vector<double> angles{from};
  for (int i = 0; i < 4; ++i) halve(belt, from + i * (to - from) / 4, from + (i + 1) * (to - from) / 4, 0, angles);
  return angles;
}

// 1 within the scene, 0 from its edge on.
double opacity_at(Point p, const EllipseStyle& style) {
  const Rect& s = style.scene;
  const double inside = std::min({p.x - s.x0, s.x1 - p.x, p.y - s.y0, s.y1 - p.y});
  return std::clamp(inside / style.fade, 0.0, 1.0);
}

// A line through the points; open ones fade towards the edge of the scene.
void draw_outline(Picture& picture, const std::vector<Point>& points, double width, bool open,
                  const EllipseStyle& style, int clip) {
  Trail trail;
  trail.color = style.theme->ellipse;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int pieces =
        open && i > 0 ? std::clamp(int(length_of(points[i] - points[i - 1]) / kLongPiece), 1, 200) : 1;
    for (int j = 1; j <= pieces; ++j) {
      const Point p = i == 0 ? points[0] : points[i - 1] + (double(j) / pieces) * (points[i] - points[i - 1]);
      trail.points.push_back({p, width, open ? opacity_at(p, style) : 1});
    }
  }
  picture.add(std::move(trail), clip);
}

// A convex piece of the inside; of an open curve the part in the scene, fading like its lines.
void fill_piece(Picture& picture, const std::array<Point, 4>& corners, double opacity, bool open,
                const EllipseStyle& style, int clip) {
  Polygon piece;
  for (const Point p : corners) {
    const bool again = piece.count > 0 && length_of(p - piece.corners[std::size_t(piece.count - 1)]) < kNoLength;
    if (!again) piece.corners[std::size_t(piece.count++)] = p;
  }
  if (piece.count > 2 && length_of(piece.corners[std::size_t(piece.count - 1)] - piece.corners[0]) < kNoLength)
    --piece.count;
  if (piece.count < 3) return;
  if (!open) {
    piece.paint.fill = style.theme->ellipse.faded(opacity);
    picture.add(piece, clip);
    return;
  }
  // Frame by frame from the edge inwards, each a little stronger: pieces side by side, none over another.
  const auto fill = [&](const Rect& r, double strength) {
    Polygon part = cut(cut(piece, {r.x0, r.y0}, {1, 0}), {r.x1, r.y1}, {-1, 0});
    part = cut(cut(part, {r.x0, r.y0}, {0, 1}), {r.x1, r.y1}, {0, -1});
    part.paint.fill = style.theme->ellipse.faded(opacity * strength);
    if (part.count >= 3) picture.add(part, clip);
  };
  for (int i = 0; i < kFadeSteps; ++i) {
    const Rect out = inset(style.scene, style.fade * i / kFadeSteps);
    const Rect in = inset(style.scene, style.fade * (i + 1) / kFadeSteps);
    if (!(in.x0 < in.x1 && in.y0 < in.y1)) return;
    const double strength = (i + 0.5) / kFadeSteps;
    fill({out.x0, out.y0, in.x0, out.y1}, strength);
    fill({in.x1, out.y0, out.x1, out.y1}, strength);
    fill({in.x0, out.y0, in.x1, in.y0}, strength);
    fill({in.x0, in.y1, in.x1, out.y1}, strength);
  }
  fill(inset(style.scene, style.fade), 1);
}

void draw_plane_belt(Picture& picture, const PlaneBelt& belt, Point center, double width, bool filled,
                     const EllipseStyle& style, int clip) {
  const std::vector<double> angles = quarter(belt, style.per_unit);
  const bool open = angles.front() > 0;
  std::vector<Point> upper, lower;  // halves, from one end of the long axis to the other
  for (const double a : angles) upper.push_back(center + belt.at(a));
  for (std::size_t i = angles.size() - 1; i-- > 0;)
    upper.push_back(center + belt.at(std::numbers::pi - angles[i]));
  for (const Point p : upper) lower.push_back(2 * center - p);
  if (filled) {
    // Along the long axis the curve goes one way only, so that strips across it hold the inside.
    const std::size_t n = upper.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      fill_piece(picture, {upper[i], upper[i + 1], lower[n - 2 - i], lower[n - 1 - i]}, kEllipseFill, open, style,
                 clip);
  }
  if (open) {
    draw_outline(picture, upper, width, true, style, clip);
    draw_outline(picture, lower, width, true, style, clip);
    return;
  }
  upper.insert(upper.end(), lower.begin() + 1, lower.end());
  draw_outline(picture, upper, width, false, style, clip);
}

// The largest sqrt(1 + t^2) / (ee + 2 en t + nn t^2): how far the surface reaches where the camera sees the direction
// e, over all t along the line of sight. Its derivative vanishes where nn t^3 + (2 nn - ee) t + 2 en = 0.
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

// Of the surface 1 / (u^T A u) with A in 1/kg, as the camera sees it.
void draw_surface(Picture& picture, const Eigen::Matrix3d& A, Point center, const Camera& camera, bool open,
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
  for (std::size_t i = 1; i < half.size(); ++i) half[i].x = std::min(half[i].x, half[i - 1].x);
  const auto height = [&](double x) {
    const auto after = std::lower_bound(half.begin(), half.end(), x, [](Point p, double v) { return p.x > v; });
    if (after == half.begin() || after == half.end()) return 0.0;
    const Point a = *(after - 1), b = *after;
    return a.x > b.x ? b.y + (x - b.x) / (a.x - b.x) * (a.y - b.y) : b.y;
  };
  for (std::size_t i = 0; i + 1 < half.size(); ++i) {
    const Point a = half[i], b = half[i + 1];
    const auto page = [&](double x, double y) { return center + x * along + y * across; };
    fill_piece(picture, {page(a.x, a.y), page(b.x, b.y), page(b.x, -height(-b.x)), page(a.x, -height(-a.x))},
               kSilhouetteFill, open, style, clip);
  }
  draw_outline(picture, outline, style.lines * size::kEllipseLine, open, style, clip);
}

}  // namespace

void draw_belt(Picture& picture, const std::vector<MassAxis>& axes, Point center, const Camera& camera,
               const EllipseStyle& style, int clip) {
  std::vector<Point> page;  // for 1 kg
  std::vector<double> mobility;
  std::vector<bool> open;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (const MassAxis& axis : axes) {
    const Point d =
        style.per_unit * Point{camera.right.dot(axis.direction), camera.up.dot(axis.direction)};
    const double m = axis.mass ? 1 / *axis.mass : 0;
    const auto leaves = [&] {
      const Point v = (1 / m) * d;
      return !contains(style.scene, center + v) && !contains(style.scene, center - v);
    };
    page.push_back(d);
    mobility.push_back(m);
    open.push_back(length_of(d) > kNoLength * style.per_unit && (!(m > 0) || leaves()));
    A += m * axis.direction * axis.direction.transpose();
  }
  const bool solid = axes.size() > 2, any_open = std::find(open.begin(), open.end(), true) != open.end();
  if (solid && mobility.back() > 0) draw_surface(picture, A, center, camera, any_open, style, clip);
  for (std::size_t i = 0; i + 1 < axes.size(); ++i)
    for (std::size_t j = i + 1; j < axes.size(); ++j) {
      if (!(mobility[j] > 0)) continue;  // infinite in this whole plane
      draw_plane_belt(picture, {page[i], page[j], mobility[i], mobility[j]}, center,
                      solid ? style.lines * size::kEllipseAxis : style.lines * size::kEllipseLine, !solid, style, clip);
    }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (open[i]) {
      // Beside the curve only the sign at each end says that there is no end.
      draw_infinity_along(picture, center, unit(page[i]), 0, style, clip);
      draw_infinity_along(picture, center, -1 * unit(page[i]), 0, style, clip);
      continue;
    }
    const Point v = mobility[i] > 0 ? (1 / mobility[i]) * page[i] : Point{};
    if (i == 0)
      draw_line(picture, {center - v, center + v}, style.lines * size::kEllipseAxis, style.theme->ellipse, clip);
    else
      draw_dashed(picture, {center - v, center + v}, style.lines * size::kEllipseAxis, style.theme->ellipse, clip);
  }
}

}  // namespace chainreel

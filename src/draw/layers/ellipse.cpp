#include "draw/layers/ellipse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/format.hpp"
#include "draw/layers/cut_numbers.hpp"
#include "draw/layers/ellipsoid.hpp"
#include "draw/layers/fading.hpp"
#include "draw/page/scales.hpp"

namespace chainreel {
namespace {

// In an ordinary pose the largest mass is at most so many times the smallest one. Nearer to a singular pose
// it has no bound, and to show it would make all ellipses needles: it is written where it leaves its scene.
constexpr double kOrdinaryRatio = 32;
constexpr int kBeltSamples = 64;
constexpr double kLongestAxis = 1e4;  // units of H: what is longer looks the same on any page, and its curve is lost to rounding
constexpr double kMostBounded = 0.8;  // of the ellipses of a film have long axes that are bounded

// A semi-axis on the page: the whole vector, or the direction of an infinite one (projected, not unit).
struct PageAxis {
  Point v;
  std::optional<double> length;  // kg or m/s; absent: infinite
};

// From the longest to the shortest.
std::vector<PageAxis> page_axes(const std::vector<MassAxis>& axes, const Camera& camera, const EllipseStyle& style) {
  std::vector<PageAxis> projected;
  for (const MassAxis& axis : axes) {
    const Point d{camera.right.dot(axis.direction), camera.up.dot(axis.direction)};
    const std::optional<double> length = semi_axis(axis, style.reading);
    if (length) projected.push_back({std::min(*length * style.per_unit, kLongestAxis) * d, length});
    if (!length && norm(d) > 1e-6) projected.push_back({d, length});
  }
  // What is heavy is slow.
  if (style.reading == EllipseReading::energy) std::reverse(projected.begin(), projected.end());
  return projected;
}

Spread spread_of(const std::vector<PageAxis>& axes) {
  Spread spread;
  for (const PageAxis& axis : axes)
    if (axis.length) spread.add(axis.v);
  return spread;
}

// The axes that have an end, solid the first of all and dashed the others.
void draw_finite_axes(Picture& picture, const std::vector<PageAxis>& axes, Point center, const Fade& fade,
                      const Stroke& stroke, const EllipseStyle& style, int clip) {
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].length && norm(axes[i].v) > kNoLength)
      draw_axis(picture, center, axes[i].v, i > 0, stroke.width(size::kEllipseAxis, style), stroke.color,
                fade_before_length(center, axes[i].v, *axes[i].length, fade, style), clip, style.hole);
}

// In the plane.
void draw_closed(Picture& picture, const std::vector<PageAxis>& axes, Point center, const EllipseStyle& style,
                 int clip) {
  const Spread spread = spread_of(axes);
  const Fade fade = fade_of(style, center, spread);
  const std::array<Point, 2> outline = spread.axes();
  const Color fill = fill_of(style);
  if (style.part == EllipsePart::below) draw_ellipse(picture, center, outline, {fill, {}, 0}, fade, clip);
  for_each_stroke(style, [&](const Stroke& stroke) {
    const double width = stroke.width(size::kEllipseLine, style);
    const Paint paint{style.draws_below() ? fill : Color{}, stroke.color, width};
    draw_ellipse(picture, center, outline, paint, fade, clip);
    if (norm(outline[1]) >= kNoLength) draw_finite_axes(picture, axes, center, fade, stroke, style, clip);
  });
  if (!style.draws_above()) return;
  for (const PageAxis& axis : axes) {
    if (!(norm(axis.v) > kNoLength)) continue;
    std::vector<Point> others;
    for (const PageAxis& other : axes)
      if (&other != &axis && style.unnamed != nullptr) others.push_back(other.v);
    draw_length(picture, center, axis.v, std::size_t(&axis - axes.data()), *axis.length, spread.reach(normal_to(unit(axis.v))), style, clip, others);
  }
}

// The whole line through p along the unit vector d, from edge to edge of the scene, fading over its last
// stretches.
void draw_fading_line(Picture& picture, Point p, Point d, const Stroke& stroke, const EllipseStyle& style, int clip) {
  const auto part = part_inside(style.scene, p - kBeyond * d, p + kBeyond * d);
  if (!part) return;
  const double in = kBeyond * (2 * part->first - 1), out = kBeyond * (2 * part->second - 1);
  const double fade = std::min(style.fade, (out - in) / 2);
  const Point a = p + in * d, b = p + out * d;
  Capsule line{a + fade * d, b - fade * d, stroke.width(size::kEllipseLine, style) / 2, {stroke.color, {}, 0}};
  picture.add(line, clip);
  line.alpha_b = 0;
  for (const auto& [inner, edge] : {std::pair{a + fade * d, a}, {b - fade * d, b}}) {
    line.a = inner;
    line.b = edge;
    picture.add(line, clip);
  }
}

// The fill between the lines.
void draw_fading_fill(Picture& picture, Point center, Point half_width, const Fade& fade, Color fill, int clip) {
  const Rect& r = fade.scene;
  Polygon band{{Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {fill, {}, 0}};
  band = cut(cut(band, center + half_width, -1 * half_width), center - half_width, half_width);
  band.fade = fade;
  if (band.count >= 3) picture.add(band, clip);
}

// How far from its long axis an ellipse of semi-axes a > r > b meets the circle of radius r.
double bend_at(double a, double b, double r) {
  return b < r ? b * std::sqrt((a * a - r * r) / (a * a - b * b)) : r;
}

// Dashed arcs at both ends of what a circle shows of a curve, which say that it goes on.
void draw_cut_edges(Picture& picture, Point center, Point along, double half_angle, const EllipseStyle& style, int clip) {
  constexpr double kDashOfRadius = 0.16, kGapOfDash = 0.8;
  const double middle = std::atan2(along.y, along.x);
  const int dashes = std::max(1, int(std::round((2 * half_angle / kDashOfRadius + kGapOfDash) / (1 + kGapOfDash))));
  const double dash = 2 * half_angle / (dashes + (dashes - 1) * kGapOfDash);
  for (const double side : {0.0, std::numbers::pi})
    for (int i = 0; i < dashes; ++i)
      picture.add(Arc{center, style.disc, middle + side - half_angle + i * (1 + kGapOfDash) * dash, dash, style.lines * size::kEllipseAxis, style.theme->ellipse}, clip);
}

// Cut curves of one circle look alike: how far one leads beyond it is seen in its inside.
double fill_beyond(double length, double disc) {
  constexpr double kMostFill = 0.42;  // opacity: lines on it keep a contrast of 3
  constexpr double kDarkest = 4;      // times the circle
  return std::lerp(kEllipseFill, kMostFill, std::clamp(std::log(length / disc) / std::log(kDarkest), 0.0, 1.0));
}

// A curve of a field, which ends at the circle of its cell: the inside is cut there, lines fade over the last quarter of
// the way. `v` may have no length.
void draw_in_disc(Picture& picture, Point center, Point u, Point v, const EllipseStyle& style, int clip) {
  constexpr int kPieces = 48;
  constexpr double kFadeOfDisc = 0.25;
  const Color line = style.theme->ellipse;
  const double a = norm(u), b = norm(v), r = style.disc, end = std::min(a, r);
  const Point along = unit(u), across = normal_to(along);
  const auto opacity = [&](Point p) { return a > r ? std::clamp((r - norm(p)) / (kFadeOfDisc * r), 0.0, 1.0) : 1.0; };
  const auto stroke = [&](const std::vector<Point>& points, double width) {
    Trail trail;
    trail.color = line;
    for (const Point p : points) trail.points.push_back({center + p, width, opacity(p)});
    if (points.size() > 1) picture.add(std::move(trail), clip);
  };
  std::vector<Point> upper, lower, outline;
  const double bend = a > r && b < r ? bend_at(a, b, r) : 0;
  const double meets = std::sqrt(std::max(0.0, std::min(end * end, r * r - bend * bend)));
  for (int i = 0; i <= kPieces; ++i) {
    const double c = std::cos(i * std::numbers::pi / kPieces), x = end * c, seen = meets * c;
    const double curve = b * std::sqrt(std::max(0.0, 1 - x * x / (a * a)));
    const double height = std::min(curve, std::sqrt(std::max(0.0, r * r - x * x)));
    upper.push_back(center + x * along + height * across);
    if (b < r) outline.push_back(seen * along + b * std::sqrt(std::max(0.0, 1 - seen * seen / (a * a))) * across);
  }
  for (const Point p : upper) lower.push_back(2 * center - p);
  const double width = style.lines * size::kEllipseLine;
  if (b > kNoLength && style.is_filled) fill_between(picture, upper, lower, fill_of(style, style.dashed_cut ? fill_beyond(a, r) : kEllipseFill), Fade{style.scene}, clip);
  stroke(outline, width);
  for (Point& p : outline) p = -1 * p;
  stroke(outline, width);
  if (style.dashed_cut && a > r && b > kNoLength) draw_cut_edges(picture, center, along, std::asin(std::min(1.0, bend_at(a, b, r) / r)), style, clip);
  std::vector<Point> axis;
  for (int i = -4; i <= 4; ++i) axis.push_back(i * end / 4 * along);
  stroke(axis, b > kNoLength ? style.lines * size::kEllipseAxis : width);
  draw_axis(picture, center, std::min(b, r) * across, true, style.lines * size::kEllipseAxis, line, Fade{style.scene}, clip);
}

// A strip between the edges of the circle, with its signs there and the lengths of its other axes.
void draw_open_in_disc(Picture& picture, const std::vector<PageAxis>& axes, Point center, Point d, const EllipseStyle& style, int clip) {
  if (!style.draws_above()) return;
  const double half_width = spread_of(axes).reach(normal_to(d)), r = style.disc;
  draw_in_disc(picture, center, kBeyond * d, half_width * normal_to(d), style, clip);
  if (!style.signs) return;
  EllipseStyle until_edge = style;  // of a box whose corners are the strip's ends
  const Point reach{r * std::abs(d.x), r * std::abs(d.y)}, low = center - reach, high = center + reach;
  until_edge.scene = {std::max(style.scene.x0, low.x), std::max(style.scene.y0, low.y), std::min(style.scene.x1, high.x), std::min(style.scene.y1, high.y)};
  draw_infinities(picture, center, d, half_width, until_edge, clip);
  for (const PageAxis& axis : axes)
    if (axis.length && norm(axis.v) > kNoLength) draw_length(picture, center, axis.v, std::size_t(&axis - axes.data()), *axis.length, 0, style, clip);
}

void draw_open(Picture& picture, const std::vector<PageAxis>& axes, Point center, Point direction,
               const EllipseStyle& style, int clip) {
  const Point d = unit(direction), n = normal_to(d);
  const double half_width = spread_of(axes).reach(n);
  // As of an axis that is longer than any page: an ellipse that grows goes over into this band.
  Spread band;
  band.add(2 * kBeyond * d);
  band.add(half_width * n);
  const Fade fade = fade_of(style, center, band);
  if (style.draws_below() && style.is_filled) draw_fading_fill(picture, center, half_width * n, fade, fill_of(style), clip);
  for_each_stroke(style, [&](const Stroke& stroke) {
    const double width = stroke.width(size::kEllipseAxis, style);
    for (const double side : {-1.0, 1.0})
      draw_fading_line(picture, center + (side * half_width) * n, d, stroke, style, clip);
    draw_axis(picture, center, kBeyond * d, false, width, stroke.color, fade_before_infinity(d, fade, style), clip, style.hole);
    draw_axis(picture, center, half_width * n, true, width, stroke.color, fade, clip, style.hole);
  });
  if (!style.draws_above()) return;
  draw_infinities(picture, center, d, half_width, style, clip);
  for (const PageAxis& axis : axes) {
    if (!axis.length || !(norm(axis.v) > kNoLength)) continue;
    draw_length(picture, center, axis.v, std::size_t(&axis - axes.data()), *axis.length, 0, style, clip);
  }
}

}  // namespace

std::string ellipse_legend(EllipseReading reading, EllipseBody body) {
  const std::string cut = body == EllipseBody::section ? ", cut at the tool" : "";
  const std::string name = body == EllipseBody::solid ? "ellipsoid" : "ellipse";
  switch (reading) {
    case EllipseReading::energy:
      return "kinetic energy " + name + " of \u039B(q)" + cut + ": velocities of equal energy, 0.5 J";
    case EllipseReading::belt:
      return "effective mass belt of \u039B(q)" + cut + ": mass felt along each direction";
    default:
      return "effective mass " + name + " \u039B(q)" + cut + ": force for unit acceleration";
  }
}

std::vector<MassAxis> mass_axes(const EffectiveMass& effective) {
  const Eigen::Index rows = effective.mobility.size();
  std::vector<MassAxis> axes;
  for (Eigen::Index i = 0; i < rows; ++i) {
    MassAxis axis;
    axis.direction = Eigen::Vector3d::Zero();
    for (Eigen::Index j = 0; j < rows; ++j) {
      axis.direction += effective.directions(j, i) * effective.basis.directions[std::size_t(j)];
    }
    if (!effective.is_infinite[std::size_t(i)]) axis.mass = 1 / effective.mobility(i);
    axes.push_back(axis);
  }
  return axes;
}

std::optional<double> semi_axis(const MassAxis& axis, EllipseReading reading) {
  if (reading != EllipseReading::energy) return axis.mass;
  return axis.mass ? 1 / std::sqrt(*axis.mass) : 0.0;
}

std::optional<double> bounded_semi_axis(const std::vector<MassAxis>& axes, EllipseReading reading) {
  return axes.empty() ? std::nullopt : semi_axis(axes.back(), reading);
}

bool is_ordinary(const std::vector<MassAxis>& axes) {
  return !axes.empty() && axes.front().mass && axes.back().mass &&
         *axes.front().mass <= kOrdinaryRatio * *axes.back().mass;
}

std::vector<CutLength> cut_lengths(const std::vector<MassAxis>& axes, Point center, const Camera& camera, const EllipseStyle& style) {
  std::vector<CutLength> lengths;
  for (const PageAxis& axis : page_axes(axes, camera, style)) {
    const bool is_seen_cut = contains(style.scene, center) && (!axis.length || is_cut(center, axis.v, style));
    lengths.push_back(is_seen_cut ? CutLength(axis.length.value_or(HUGE_VAL)) : std::nullopt);
  }
  return lengths;
}

std::string EllipseScale::label() const {
  return format_shortest(bar) + (reading == EllipseReading::energy ? " m/s" : " kg");
}

EllipseScale ellipse_scale(std::vector<double> bounded, double bar_length, EllipseReading reading) {
  EllipseScale scale{1, bar_length, reading};
  std::erase_if(bounded, [](double m) { return !(std::isfinite(m) && m > 0); });
  if (bounded.empty()) return scale;
  const auto middle = bounded.begin() + std::ptrdiff_t(bounded.size() / 2);
  std::nth_element(bounded.begin(), middle, bounded.end());
  const double decade = std::pow(10.0, std::floor(std::log10(*middle)));
  double nearest = decade;
  for (const double step : {2.0, 5.0, 10.0}) {
    // Nearest in ratio, as lengths are compared by eye.
    if (std::abs(std::log(*middle / (step * decade))) < std::abs(std::log(*middle / nearest)))
      nearest = step * decade;
  }
  scale.bar = nearest;
  return scale;
}

EllipseScale bounded_scale(const EllipseScale& scale, std::vector<double> longest_axes, double longest) {
  if (longest_axes.empty()) return scale;
  const auto at = longest_axes.begin() + std::ptrdiff_t(kMostBounded * double(longest_axes.size() - 1));
  std::nth_element(longest_axes.begin(), at, longest_axes.end());
  const double per_unit = longest / *at;
  if (!(per_unit < scale.per_unit())) return scale;
  const double bar = round_length(kLongestBar / per_unit);
  return {bar, bar * per_unit, scale.reading};
}

Room room_of(const std::vector<MassAxis>& axes, const Camera& camera, const EllipseScale& scale,
             double most) {
  double x = 0, y = 0;
  for (const MassAxis& axis : axes) {
    const auto length = semi_axis(axis, scale.reading);
    const double drawn = length ? std::min(*length * scale.per_unit(), most) : 0;
    x = std::hypot(x, drawn * camera.right.dot(axis.direction));
    y = std::hypot(y, drawn * camera.up.dot(axis.direction));
  }
  if (scale.reading != EllipseReading::belt) return {x, x, y, y};
  // Between the axes a belt lies outside of its ellipse: in the plane of its first and last axis at most.
  const auto long_axis = axes.front().mass, short_axis = axes.back().mass;
  for (int i = 0; long_axis && short_axis && i < kBeltSamples; ++i) {
    const double a = i * 2 * std::numbers::pi / kBeltSamples, c = std::cos(a), s = std::sin(a);
    const double r = std::min(scale.per_unit() / (c * c / *long_axis + s * s / *short_axis), most);
    const Eigen::Vector3d p = r * (c * axes.front().direction + s * axes.back().direction);
    x = std::max(x, std::abs(camera.right.dot(p)));
    y = std::max(y, std::abs(camera.up.dot(p)));
  }
  return {x, x, y, y};
}

void draw_mass_ellipse(Picture& picture, const std::vector<MassAxis>& axes, Point center,
                       const Camera& camera, const EllipseStyle& style, int clip) {
  if (!contains(style.scene, center)) return;
  if (style.reading == EllipseReading::belt) return draw_belt(picture, axes, center, camera, style, clip);
  const std::vector<PageAxis> projected = page_axes(axes, camera, style);
  Point open{};
  bool all_open = false;
  for (const PageAxis& axis : projected) {
    if (axis.length) continue;
    // A second, different open direction leaves nothing bounded.
    if (norm(open) > 0 && std::abs(dot(unit(open), normal_to(unit(axis.v)))) > 1e-6) all_open = true;
    open = axis.v;
  }
  if (style.disc > 0 && !all_open) {
    const Point d = unit(open);
    const auto closed = spread_of(projected).axes();
    if (norm(open) > 0)
      draw_open_in_disc(picture, projected, center, d, style, clip);
    else if (norm(closed[0]) > kNoLength)
      draw_in_disc(picture, center, closed[0], closed[1], style, clip);
  } else if (all_open) {
    if (style.draws_above()) draw_infinities(picture, center, {1, 0}, 0, style, clip);
  } else if (norm(open) > 0) {
    draw_open(picture, projected, center, open, style, clip);
  } else if (axes.size() > 2) {
    draw_ellipsoid(picture, axes, center, camera, style, clip);
  } else if (!projected.empty()) {
    draw_closed(picture, projected, center, style, clip);
  }
}

std::vector<MassAxis> section_axes(const EffectiveMass& effective, const Eigen::Matrix<double, 3, 2>& plane,
                                   EllipseReading reading) {
  const double largest = effective.mobility.size() < 3 ? 0 : effective.mobility.maxCoeff();
  if (!(largest > 0)) return mass_axes(effective);
  // The form of the curve of `energy` grows without bounds towards singular poses, where the curve is a segment: a mass beyond all that counts stands for
  // it, from which the other axis is off by as much as it is by rounding. Eigenvalues of a form are known to rounding of its largest one, those of
  // `mass` before their root.
  constexpr double kBeyondAll = 1e-10, kLeastOfMass = 3e-8;
  const double least = largest * (reading == EllipseReading::mass ? kLeastOfMass : reading == EllipseReading::energy ? 2 * kBeyondAll : kSingularFraction);
  auto values = effective.mobility;
  for (double& m : values) {
    if (reading == EllipseReading::mass) m = m * m;
    if (reading == EllipseReading::energy) m = 1 / std::max(m, kBeyondAll * largest);
  }
  const PlaneForm form = form_on_plane(effective, values, plane);
  std::vector<MassAxis> axes;
  for (int i = 0; i < 2; ++i) {
    // As kg, whatever the form says.
    double mobility = form.values[i];
    if (reading == EllipseReading::mass) mobility = std::sqrt(mobility);
    if (reading == EllipseReading::energy) mobility = mobility > 0 ? 1 / mobility : 0;
    MassAxis axis;
    axis.direction = form.directions.col(i);
    if (mobility > least) axis.mass = 1 / mobility;
    axes.push_back(axis);
  }
  if (reading == EllipseReading::energy) std::swap(axes[0], axes[1]);
  return axes;
}

}  // namespace chainreel

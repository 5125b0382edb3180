#include "draw/layers/ellipsoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/format.hpp"
#include "draw/layers/fading.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr int kHalfTurn = 64;          // of half a turn
constexpr double kFarLine = 0.0016;  // units of H: lines behind the middle
constexpr double kFarOpacity = 0.75;
constexpr double kAroundSilhouette = 0.006;  // units of H: half of its line, and air
constexpr double kFarDash = 0.008, kFarGap = 0.006;  // units of H

// A semi-axis in W, units of H on a page that it is parallel to.
struct SolidAxis {
  Vector3d v, direction;
  double length = 0;  // kg or m/s
};

// A line in space, relative to the middle of the ellipsoid.
using Line = std::vector<Vector3d>;

class Ellipsoid {
 public:
  Ellipsoid(const std::vector<MassAxis>& axes, Point center, const Camera& camera, const EllipseStyle& style)
      : center_(center), camera_(camera), style_(style) {
    for (const MassAxis& axis : axes)
      if (const auto length = semi_axis(axis, style.reading))
        axes_.push_back({*length * style.per_unit * axis.direction, axis.direction, *length});
    // What is heavy is slow.
    if (style.reading == EllipseReading::energy) std::reverse(axes_.begin(), axes_.end());
    for (const SolidAxis& axis : axes_) spread_.add(on_page(axis.v) - center_);
    fade_ = fade_of(style, center, spread_);
  }

  void draw(Picture& picture, int clip) const {
    const Color line = style_.theme->ellipse;
    const std::array<Point, 2> outline = spread_.axes();
    if (style_.draws_below()) {
      draw_ellipse(picture, center_, outline, {fill_of(style_, kSilhouetteFill), {}, 0}, fade_, clip);
      for (const Line& far : far_lines()) draw_dashed(picture, on_page(far), style_.lines * kFarLine, line.faded(kFarOpacity), clip);
    }
    const bool has_inside = norm(outline[1]) > kNoLength;
    // Of what stands before the middle, and of the silhouette, that which a body hides.
    if (style_.part == EllipsePart::below && style_.hides) {
      const Stroke stroke{line, 0};
      if (has_inside) draw_pieces(picture, silhouette(), true, stroke, size::kEllipseLine, clip);
      for (const Line& near : near_lines())
        draw_pieces(picture, near, true, stroke, size::kEllipseAxis, clip);
    }
    for_each_stroke(style_, [&](const Stroke& stroke) {
      if (has_inside) draw_pieces(picture, silhouette(), false, stroke, size::kEllipseLine, clip);
      for (const Line& near : near_lines())
        draw_pieces(picture, near, false, stroke, size::kEllipseAxis, clip);
    });
    if (style_.part == EllipsePart::above && style_.hides) draw_hidden(picture, clip);
    if (style_.draws_above()) draw_numbers(picture, clip);
  }

 private:
  Point on_page(const Vector3d& p) const { return center_ + Point{camera_.right.dot(p), camera_.up.dot(p)}; }
  std::vector<Point> on_page(const Line& line) const {
    std::vector<Point> points;
    for (const Vector3d& p : line) points.push_back(on_page(p));
    return points;
  }

  // How the normal at cos(a) axis_i + sin(a) axis_j turns towards the viewer: as cos(a - facing).
  double facing(const SolidAxis& i, const SolidAxis& j) const {
    const Vector3d& n = camera_.toward_viewer;
    return std::atan2(n.dot(j.v) / j.v.squaredNorm(), n.dot(i.v) / i.v.squaredNorm());
  }
  static bool has_length(const SolidAxis& axis) { return axis.v.norm() > kNoLength; }

  // Half of each axis, in pieces, since bodies may hide a part of it.
  std::vector<Line> half_axes(double side) const {
    std::vector<Line> lines;
    for (const SolidAxis& axis : axes_) {
      if (!has_length(axis)) continue;
      const double toward = camera_.toward_viewer.dot(axis.v) < 0 ? -side : side;
      Line line;
      for (int i = 0; i <= kHalfTurn; ++i) line.push_back(double(i) / kHalfTurn * toward * axis.v);
      lines.push_back(std::move(line));
    }
    return lines;
  }
  // Half of each principal ellipse, from where it meets the silhouette on, and of each axis.
  std::vector<Line> halves(double side) const {
    std::vector<Line> lines = half_axes(side);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const SolidAxis &u = axes_[i], &v = axes_[(i + 1) % axes_.size()];
      if (axes_.size() < 3 || !has_length(u) || !has_length(v)) continue;
      const double middle = facing(u, v) + (side > 0 ? 0 : std::numbers::pi);
      Line half;
      for (int k = -kHalfTurn / 2; k <= kHalfTurn / 2; ++k) {
        const double a = middle + k * std::numbers::pi / kHalfTurn;
        half.push_back(std::cos(a) * u.v + std::sin(a) * v.v);
      }
      lines.push_back(std::move(half));
    }
    return lines;
  }
  std::vector<Line> near_lines() const { return halves(1); }
  std::vector<Line> far_lines() const { return halves(-1); }

  // Where the surface turns away from the viewer: the image of a great circle of the unit sphere.
  Line silhouette() const {
    Vector3d w = Vector3d::Zero();
    double largest = 0;
    for (const SolidAxis& axis : axes_) largest = std::max(largest, axis.v.norm());
    for (std::size_t i = 0; i < axes_.size() && i < 3; ++i) {
      const double size = std::max(axes_[i].v.norm(), kNoLength * largest);
      w[Eigen::Index(i)] = camera_.toward_viewer.dot(axes_[i].direction) / size;
    }
    if (axes_.size() < 3) w = Vector3d::UnitZ();  // the third one has no end, and is seen from there
    const Vector3d a = w.norm() > 0 ? Vector3d(w.unitOrthogonal()) : Vector3d(Vector3d::UnitX());
    const Vector3d b = w.norm() > 0 ? Vector3d(w.normalized().cross(a)) : Vector3d(Vector3d::UnitY());
    Line line;
    for (int k = 0; k <= 2 * kHalfTurn; ++k) {
      const double angle = k * std::numbers::pi / kHalfTurn;
      const Vector3d on_sphere = std::cos(angle) * a + std::sin(angle) * b;
      Vector3d p = Vector3d::Zero();
      for (std::size_t i = 0; i < axes_.size() && i < 3; ++i) p += on_sphere[Eigen::Index(i)] * axes_[i].v;
      line.push_back(p);
    }
    return line;
  }

  // The pieces of the line that a body hides, or the others.
  std::vector<std::vector<Point>> pieces_of(const Line& line, bool hidden) const {
    std::vector<std::vector<Point>> pieces;
    bool goes_on = false;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const bool is_hidden = style_.hides && style_.hides(0.5 * (line[i] + line[i + 1]));
      if (is_hidden == hidden && !goes_on) pieces.push_back({on_page(line[i])});
      if (is_hidden == hidden) pieces.back().push_back(on_page(line[i + 1]));
      goes_on = is_hidden == hidden;
    }
    return pieces;
  }

  void draw_pieces(Picture& picture, const Line& line, bool hidden, const Stroke& stroke, double width,
                   int clip) const {
    for (std::vector<Point>& piece : pieces_of(line, hidden)) {
      // The edge ends before the line does, which goes on below.
      if (stroke.wider > 0 && piece.size() > 2) piece = {piece.begin() + 1, piece.end() - 1};
      if (piece.size() > 1) draw_outline(picture, piece, stroke.width(width, style_), stroke.color, fade_, clip);
    }
  }

  // Over a body, so that the shape of the whole and its axes are seen: the outline and the near axes, dashed.
  void draw_hidden(Picture& picture, int clip) const {
    std::vector<Line> lines = half_axes(1);
    if (norm(spread_.axes()[1]) > kNoLength) lines.push_back(silhouette());
    for (const Line& line : lines)
      for (const std::vector<Point>& piece : pieces_of(line, true)) {
        draw_dashed(picture, piece, style_.lines * size::kEllipseAxis + 2 * style_.lines * kLineEdge, style_.theme->background, clip);
        draw_dashed(picture, piece, style_.lines * size::kEllipseAxis, style_.theme->ellipse, clip);
      }
  }

  // Dashes symmetric about the middle of the line's length.
  void draw_dashed(Picture& picture, const std::vector<Point>& points, double width, Color color, int clip) const {
    std::vector<double> way{0};
    for (std::size_t i = 1; i < points.size(); ++i)
      way.push_back(way.back() + norm(points[i] - points[i - 1]));
    const double whole = way.back(), period = kFarDash + kFarGap;
    if (!(whole > kNoLength)) return;
    const auto at = [&](double s) {
      const auto after = std::lower_bound(way.begin() + 1, way.end() - 1, s);
      const std::size_t i = std::size_t(after - way.begin());
      const double step = way[i] - way[i - 1];
      return points[i - 1] + (step > 0 ? (s - way[i - 1]) / step : 0) * (points[i] - points[i - 1]);
    };
    const int count = int(std::min(whole / 2, kBeyond) / period);
    for (int i = -count; i <= count; ++i) {
      const double from = std::max(0.0, whole / 2 + i * period - kFarDash / 2);
      const double to = std::min(whole, whole / 2 + i * period + kFarDash / 2);
      const double opacity = fade_.opacity_at(at((from + to) / 2));
      if (from < to && opacity > 0) draw_line(picture, {at(from), at(to)}, width, color.faded(opacity), clip);
    }
  }

  // Whether the silhouette, with the width of its line and some air, has any of a box.
  bool meets_silhouette(const Rect& box) const {
    constexpr int kSteps = 8;  // words are some five times as wide as high
    const std::array<Point, 2> axes = spread_.axes();
    const auto share = [](Point p, Point axis) { return dot(p, unit(axis)) / (norm(axis) + kAroundSilhouette); };
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= 2; ++j) {
        const Point p = Point{box.x0 + i * box.width() / kSteps, box.y0 + j * box.height() / 2} - center_;
        if (std::hypot(share(p, axes[0]), share(p, axes[1])) < 1) return true;
      }
    return false;
  }

  // The length of each semi-axis at the end that faces the viewer, or that no robot hides, else at the other one.
  void draw_numbers(Picture& picture, int clip) const {
    EllipseStyle style = style_;
    if (style.unnamed == nullptr) style.covers = [this](const Rect& box) { return meets_silhouette(box); };
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const Point v = on_page(axes_[i].v) - center_;
      if (!(norm(v) > kNoLength)) continue;
      bool back = camera_.toward_viewer.dot(axes_[i].v) < 0;
      if (style_.hides) {
        const auto is_hidden = [&](bool other) { return style_.hides((other ? -1 : 1) * axes_[i].v); };
        if (is_hidden(back) && !is_hidden(!back)) back = !back;
      }
      draw_length(picture, center_, (back ? -1 : 1) * v, i, axes_[i].length, spread_.reach(normal_to(unit(v))), style, clip);
    }
  }

  std::vector<SolidAxis> axes_;  // from the longest to the shortest
  Point center_;
  const Camera& camera_;
  const EllipseStyle& style_;
  Spread spread_;
  Fade fade_;
};

// What pairs of planes with 13 normals leave of space, for rays of one direction v.
class Hull {
 public:
  Hull(const BodyShape& shape, const Workspace& ws, const Vector3d& v) : sides_{v.unitOrthogonal(), {}} {
    sides_[1] = v.cross(sides_[0]);
    const Eigen::Isometry3d X_WB = pose_of(ws, shape.body);
    const Eigen::Matrix3d axes = (X_WB * shape.X_BM).linear();
    std::size_t n = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (9 * x + 3 * y + z <= 0) continue;  // one of each pair
          normals_[n] = axes * Vector3d(x, y, z);
          rates_[n] = normals_[n].dot(v);
          ++n;
        }
    slabs_.fill({HUGE_VAL, -HUGE_VAL});
    seen_.fill({HUGE_VAL, -HUGE_VAL});
    for (const Vector3d& corner : shape.corners) {
      const Vector3d p = X_WB * corner;
      for (n = 0; n < normals_.size(); ++n) slabs_[n].add(normals_[n].dot(p));
      for (std::size_t i = 0; i < 2; ++i) seen_[i].add(sides_[i].dot(p));
    }
    // Between corners a round body reaches out farther, by up to 1 - cos(22.5 deg) of its half.
    for (Range& range : seen_) {
      const double more = 0.04 * (range.high - range.low);
      range.low -= more, range.high += more;
    }
  }

  // Whether the ray from p along v has more of it than a touch.
  bool is_met_from(const Vector3d& p) const {
    constexpr double kTouch = 1e-3;  // m
    // Most bodies stand well beside it.
    for (std::size_t i = 0; i < 2; ++i)
      if (!seen_[i].holds(sides_[i].dot(p))) return false;
    double in = 0, out = HUGE_VAL;
    for (std::size_t n = 0; n < normals_.size(); ++n) {
      const double at = normals_[n].dot(p);
      if (std::abs(rates_[n]) < 1e-12) {
        if (!slabs_[n].holds(at)) return false;
        continue;
      }
      const double a = (slabs_[n].low - at) / rates_[n], b = (slabs_[n].high - at) / rates_[n];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return out > in + kTouch;
  }

 private:
  struct Range {
    double low, high;
    void add(double at) { low = std::min(low, at), high = std::max(high, at); }
    bool holds(double at) const { return at >= low && at <= high; }
  };

  std::array<Vector3d, 2> sides_;  // with v a frame
  std::array<Range, 2> seen_;      // along v
  std::array<Vector3d, 13> normals_;
  std::array<Range, 13> slabs_;
  std::array<double, 13> rates_;  // of v along the normals
};

}  // namespace

void draw_ellipsoid(Picture& picture, const std::vector<MassAxis>& axes, Point center, const Camera& camera,
                    const EllipseStyle& style, int clip) {
  Ellipsoid(axes, center, camera, style).draw(picture, clip);
}

Hides robot_hides(const BodyShapes& shapes, const Workspace& ws, const Camera& camera, const Vector3d& tip) {
  const double share = 1 - camera.nearing.dot(tip - camera.focus);
  const Vector3d toward = camera.seen_at(tip).toward_viewer;
  std::vector<Hull> hulls;
  for (const BodyShape& shape : shapes.shapes)
    if (!shape.corners.empty()) hulls.emplace_back(shape, ws, toward);
  return [hulls = std::move(hulls), tip, metres = share / camera.scale](const Vector3d& place) {
    const Vector3d p = tip + metres * place;
    return std::any_of(hulls.begin(), hulls.end(), [&](const Hull& hull) { return hull.is_met_from(p); });
  };
}

}  // namespace chainreel

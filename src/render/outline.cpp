#include "render/outline.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

// Beyond, squares of their ratio leave too few digits: such an ellipse fills its box.
constexpr double kThinnestAxis = 1, kLongestAxis = 1e5;  // px
constexpr int kPolygonCorners = 8;

struct Interval {
  double low = HUGE_VAL, high = -HUGE_VAL;
  bool empty() const { return !(low <= high); }
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  void keep(const Interval& other) { low = std::max(low, other.low), high = std::min(high, other.high); }
};

// Adds the columns of the part of a segment that lies between two heights.
void add_segment(Interval& columns, double ax, double ay, double bx, double by, double top, double bottom) {
  if (std::max(ay, by) < top || std::min(ay, by) > bottom) return;
  const auto at = [&](double y) { return ax + (bx - ax) * std::clamp((y - ay) / (by - ay), 0.0, 1.0); };
  if (ay == by) {
    columns.add(ax);
    columns.add(bx);
    return;
  }
  columns.add(at(std::clamp(ay, top, bottom)));
  columns.add(at(std::clamp(by, top, bottom)));
}

// About its centre: A x^2 + 2 B x y + C y^2 <= 1, whose determinant A C - B^2 is 1 / (a b)^2.
class EllipseRows {
 public:
  EllipseRows(const Outline& o, double scale) {
    const double a = o.a * scale, b = o.b * scale;
    a_ = o.u * o.u / (a * a) + o.v * o.v / (b * b);
    b_ = o.u * o.v * (1 / (a * a) - 1 / (b * b));
    ab_ = a * b;
    width_ = std::sqrt(a * a * o.u * o.u + b * b * o.v * o.v);
    height_ = std::sqrt(a * a * o.v * o.v + b * b * o.u * o.u);
    height_of_right_ = (a * a - b * b) * o.u * o.v / width_;
  }

  // Of one height; empty where it does not reach it.
  Interval at(double y) const {
    if (std::abs(y) > height_) return {};
    const double root = std::sqrt(std::max(0.0, a_ - y * y / (ab_ * ab_))) / a_, middle = -b_ * y / a_;
    return {middle - root, middle + root};
  }
  // Of all heights between two.
  Interval between(double top, double bottom) const {
    if (top > height_ || bottom < -height_) return {};
    const double first = std::max(top, -height_), last = std::min(bottom, height_);
    const auto is_between = [&](double y) { return y >= first && y <= last; };
    Interval all{std::min(at(first).low, at(last).low), std::max(at(first).high, at(last).high)};
    if (is_between(height_of_right_)) all.high = width_;
    if (is_between(-height_of_right_)) all.low = -width_;
    return all;
  }

 private:
  double a_, b_, ab_, width_, height_, height_of_right_;
};

struct Columns {
  Interval outer, inner;
};

Columns columns_of_ellipse(const Outline& o, double top, double bottom) {
  Columns columns;
  columns.outer = EllipseRows(o, 1).between(top - o.y - o.reach, bottom - o.y + o.reach);
  // From the edge a point inside is away by at least (1 - level) b, level that of the scaled ellipse through it.
  if (const double scale = 1 - o.reach / o.b; scale > 0) {
    const EllipseRows rows(o, scale);
    columns.inner = rows.at(top - o.y);  // convex: what both ends have, all between them have
    columns.inner.keep(rows.at(bottom - o.y));
  }
  for (Interval* part : {&columns.outer, &columns.inner}) part->low += o.x, part->high += o.x;
  columns.outer = {columns.outer.low - o.reach, columns.outer.high + o.reach};
  return columns;
}

Columns columns_of_ring(const Outline& o, double top, double bottom) {
  const double lowest = std::max({0.0, top - o.y, o.y - bottom}), highest = std::max(std::abs(top - o.y), std::abs(bottom - o.y));
  const double outer = o.a + o.reach, inner = o.a - o.reach;
  Columns columns;
  if (lowest <= outer) {
    const double half = std::sqrt(outer * outer - lowest * lowest);
    columns.outer = {o.x - half, o.x + half};
  }
  if (inner > highest) {
    const double half = std::sqrt(inner * inner - highest * highest);
    columns.inner = {o.x - half, o.x + half};
  }
  return columns;
}

// Columns in which a point of either height lies at least `depth` on the inner side of the edge.
Interval beside_edge(double ax, double ay, double bx, double by, double top, double bottom, double depth) {
  const double length = std::hypot(bx - ax, by - ay), nx = -(by - ay) / length, ny = (bx - ax) / length;
  Interval columns{-HUGE_VAL, HUGE_VAL};
  for (const double y : {top, bottom}) {
    const double missing = depth - ny * (y - ay);  // nx (x - ax) must be that much
    if (std::abs(nx) < 1e-9) {
      if (missing > 0) return {};
    } else if (nx > 0) {
      columns.low = std::max(columns.low, ax + missing / nx);
    } else {
      columns.high = std::min(columns.high, ax + missing / nx);
    }
  }
  return columns;
}

// Its corners run in the sense of growing angle, y down.
Columns columns_of_polygon(const Outline& o, const float* corners, double top, double bottom) {
  Columns columns{{}, {-HUGE_VAL, HUGE_VAL}};
  for (int i = 0; i < kPolygonCorners; ++i) {
    const float *from = corners + 2 * i, *to = corners + 2 * ((i + 1) % kPolygonCorners);
    if (from[0] == to[0] && from[1] == to[1]) continue;
    add_segment(columns.outer, from[0], from[1], to[0], to[1], top - o.reach, bottom + o.reach);
    columns.inner.keep(beside_edge(from[0], from[1], to[0], to[1], top, bottom, o.reach));
  }
  columns.outer = {columns.outer.low - o.reach, columns.outer.high + o.reach};
  return columns;
}

Columns columns_of_segment(const Outline& o, double top, double bottom) {
  Columns columns;
  add_segment(columns.outer, o.x, o.y, o.x + o.a * o.u, o.y + o.a * o.v, top - o.reach, bottom + o.reach);
  columns.outer = {columns.outer.low - o.reach, columns.outer.high + o.reach};
  return columns;
}

}  // namespace

Spans Outline::spans(int top, int bottom, const float* numbers) const {
  const Spans whole{box.x, box.right(), box.right(), box.right()};
  if (kind == Kind::box || (kind == Kind::ellipse && (b < kThinnestAxis || a > kLongestAxis))) return whole;
  const Columns columns = kind == Kind::segment   ? columns_of_segment(*this, top, bottom)
                          : kind == Kind::ring    ? columns_of_ring(*this, top, bottom)
                          : kind == Kind::ellipse ? columns_of_ellipse(*this, top, bottom)
                                                  : columns_of_polygon(*this, numbers, top, bottom);
  if (columns.outer.empty()) return {};
  const auto column = [this](double edge) { return int(std::clamp(edge, double(box.x), double(box.right()))); };
  Spans spans{column(std::floor(columns.outer.low)), column(std::ceil(columns.outer.high)), 0, 0};
  if (!columns.inner.empty()) {
    spans.inner_left = column(std::ceil(columns.inner.low));
    spans.inner_right = column(std::floor(columns.inner.high));
  }
  if (!spans.has_inner()) spans.inner_left = spans.inner_right = spans.right;
  return spans;
}

}  // namespace chainreel

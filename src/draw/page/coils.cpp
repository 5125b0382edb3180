#include "draw/page/coils.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/robot/joints.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

constexpr double kWire = 0.0042;       // units of H
constexpr int kWindings = 10, kPiecesOfWinding = 14;
constexpr double kCoilRadius = 0.0175;  // within a full rail, with a gap to its lines
constexpr double kLoop = 0.35;         // of the radius: how far a winding swings along the coil, which makes its loops
constexpr double kLead = 0.012;        // of straight wire at both ends
constexpr double kCylinder = 0.58, kPiston = 0.40, kCylinderWidth = 0.024;  // shares of the length; units of H
constexpr double kSpiralInner = 0.019, kSpiralWindings = 2;
constexpr int kPiecesOfSpiral = 56;          // at least
constexpr double kPieceOfSpiral = 0.15;      // rad, at most
constexpr double kMostWindings = 4.5;        // more are a disc to the eye
constexpr double kSpiralBreak = 0.16;        // of the way from inside to outside: the gap of a spiral that has more
constexpr double kSpiralFade = 0.14;         // ... in which its ends beside the gap fade
constexpr double kVanesInner = 0.0175;
constexpr double kRoundCoil = 0.0085;  // half its width
constexpr int kRoundWindings = 6;
constexpr double kWireCasing = 0.0016;     // beside a wire over bodies, units of H
constexpr double kRoundGrown = 0.05;   // units of H: a coil as long has its full width

double width_of_wire(double size) {
  return std::max(0.6, size) * kWire;
}

void add_wire(Picture& picture, Trail path, int clip, Color casing) {
  if (casing.a > 0) {
    Trail below = path;
    below.color = casing;
    for (TrailPoint& point : below.points) point.width += 2 * kWireCasing;
    picture.add(std::move(below), clip);
  }
  picture.add(std::move(path), clip);
}

}  // namespace

void draw_coil(Picture& picture, Point a, Point b, double size, Color color, int clip, Color casing) {
  const double length = norm(b - a), width = width_of_wire(size);
  const Point along = unit(b - a), side = normal_to(along);
  const double lead = std::min(size * kLead, length / 4), radius = size * kCoilRadius;
  const double loop = std::min(kLoop * radius, length / 8), begin = lead + loop, end = length - lead - loop;
  Trail path;
  path.color = color;
  path.points.push_back({a, width, 1});
  for (int i = 0; i <= kWindings * kPiecesOfWinding; ++i) {
    const double share = double(i) / (kWindings * kPiecesOfWinding), angle = 2 * std::numbers::pi * kWindings * share;
    path.points.push_back({a + (begin + share * (end - begin) - loop * std::cos(angle)) * along +
                               (radius * std::sin(angle)) * side,
                           width, 1});
  }
  path.points.push_back({b, width, 1});
  add_wire(picture, std::move(path), clip, casing);
}

void draw_dashpot(Picture& picture, Point a, Point b, double size, Color color, Color inside, int clip) {
  const Point v = b - a, half = (size * kCylinderWidth / 2) * normal_to(unit(v));
  const Point bottom = a + 0.08 * v, mouth = a + kCylinder * v, piston = a + kPiston * v;
  const double width = width_of_wire(size);
  picture.add(Polygon{{bottom + half, mouth + half, mouth - half, bottom - half}, 4, {inside, {}, 0}}, clip);
  draw_line(picture, {a, bottom}, width, color, clip);
  draw_line(picture, {bottom - half, bottom + half}, width, color, clip);
  for (const double s : {-1.0, 1.0}) draw_line(picture, {bottom + s * half, mouth + s * half}, width, color, clip);
  draw_line(picture, {piston - 0.75 * half, piston + 0.75 * half}, 1.6 * width, color, clip);
  draw_line(picture, {piston, b}, width, color, clip);
}

Point PageTurn::at(double radius, double angle) const {
  return center + (radius * std::cos(angle)) * u + (radius * std::sin(angle)) * w;
}

void draw_spiral(Picture& picture, const PageTurn& turn, double q, double rest, double size, Color color, int clip, Color casing) {
  const double width = width_of_wire(size);
  // The fixed end is opposite to the link at rest; a link that turns on unwinds it.
  const double outer = rest + std::numbers::pi, most = 2 * std::numbers::pi * kMostWindings;
  // Below zero it is unwound and winds up again the other way round.
  const double span = 2 * std::numbers::pi * kSpiralWindings + outer - q;
  if (!std::isfinite(span)) return;
  const double shown = std::copysign(std::min(most, std::abs(span)), span);
  const int pieces = std::max(kPiecesOfSpiral, int(std::ceil(std::abs(shown) / kPieceOfSpiral)));
  // Of more windings than can be told apart both ends stay where they are, with a gap between them that opens over half a turn.
  const double open = std::min(1.0, (std::abs(span) - std::abs(shown)) / std::numbers::pi);
  const double gap = open * kSpiralBreak / 2, fade = open * kSpiralFade;
  const auto add_part = [&](double from, double to, double angle) {
    Trail path;
    path.color = color;
    for (int i = 0; i <= pieces; ++i) {
      const double share = double(i) / pieces;
      if (share < from || share > to) continue;
      const double radius = size * (kSpiralInner + share * (kSpiralOuter - kSpiralInner));
      const double beside = std::abs(share - 0.5) - gap;
      path.points.push_back({turn.at(radius, angle + shown * share), width, fade > 0 ? std::clamp(beside / fade, 0.0, 1.0) : 1.0});
    }
    add_wire(picture, std::move(path), clip, casing);
  };
  if (open > 0) {
    add_part(0, 0.5 - gap, q);
    add_part(0.5 + gap, 1, outer - shown);
  } else {
    add_part(0, 1, outer - shown);
  }
  const Point end = turn.at(size * kSpiralOuter, outer);
  const double pin = 1.1 * width;
  picture.add(Ellipse{end, {pin, 0}, {0, pin}, {color, {}, 0}}, clip);
}

void draw_vanes(Picture& picture, const PageTurn& turn, double q, double size, Color color, Color inside, int clip) {
  const double inner = size * kVanesInner, outer = size * kVanesOuter, middle = (inner + outer) / 2;
  const double width = 0.5 * width_of_wire(size);
  const auto circle = [&](double radius, double stroke, Color stroke_color) {
    Trail path;
    path.color = stroke_color;
    for (int i = 0; i <= 48; ++i)
      path.points.push_back({turn.at(radius, 2 * std::numbers::pi * i / 48), stroke, 1});
    picture.add(std::move(path), clip);
  };
  circle(middle, outer - inner, inside);
  circle(inner, width, color);
  circle(outer, width, color);
  for (int i = 0; i < 3; ++i) {
    const double angle = q + 2 * std::numbers::pi * i / 3;
    draw_line(picture, {turn.at(inner, angle), turn.at(outer, angle)}, 1.2 * width_of_wire(size), color, clip);
  }
}

void draw_round_coil(Picture& picture, const PageTurn& turn, double radius, double from, double to, double size,
                     Color color, int clip, Color casing) {
  const double length = std::abs(to - from) * radius, grown = std::min(1.0, length / kRoundGrown);
  const int pieces = kRoundWindings * 8;
  Trail path;
  path.color = color;
  for (int i = 0; i <= pieces; ++i) {
    const double share = double(i) / pieces;
    const double swing = grown * size * kRoundCoil * std::sin(2 * std::numbers::pi * kRoundWindings * share);
    path.points.push_back({turn.at(radius + swing, from + share * (to - from)), width_of_wire(size) * grown, 1});
  }
  add_wire(picture, std::move(path), clip, casing);
}

}  // namespace chainreel

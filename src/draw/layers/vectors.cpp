#include "draw/layers/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/joints.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kVectorLabelGap = 0.010;  // between an arrow's tip or an arc and its label, units of H
constexpr double kFarLabelGap = 0.035;      // ... where there is no room nearer
constexpr double kRoomStep = 0.01;   // units of H: rooms are rounded up to multiples, to have few kinds

Point on_page(const Vector3d& direction, const Camera& camera) {
  return {camera.right.dot(direction), camera.up.dot(direction)};
}

// The circle of an arc about `axis`, radius 1: its top as seen on the page, and a quarter turn on.
struct Circle {
  Vector3d top, quarter;
};
Circle circle_about(const Vector3d& axis, const Camera& camera) {
  Vector3d top = camera.up - camera.up.dot(axis) * axis;
  if (top.norm() < 1e-6) top = -camera.toward_viewer;
  top.normalize();
  return {top, axis.cross(top)};
}

Rect label_box(const TextLine& label, Point near, Point direction) {
  return place_beyond(label, near, kVectorLabelGap, direction);
}

// Before the tip of an arrow, or beside its head and shaft, `half` off their middle.
std::vector<Rect> places_along(const TextLine& label, Point tail, Point v, double half) {
  const Point ahead = unit(v), side = normal_to(ahead), tip = tail + v;
  const Point aslant = std::sqrt(0.5) * ahead, across = std::sqrt(0.5) * side;
  std::vector<Rect> places{label_box(label, tip, ahead), label_box(label, tip, aslant + across),
                           label_box(label, tip, aslant - across)};
  for (const double share : {1.0, 0.6, 0.25})
    for (const double way : {1.0, -1.0})
      places.push_back(label_box(label, tail + share * v + (way * half) * side, way * side));
  for (const double way : {1.0, -1.0}) {
    places.push_back(place_beyond(label, tip, kFarLabelGap, aslant + way * across));
    places.push_back(place_beyond(label, tail + 0.6 * v, half + kFarLabelGap, way * side));
  }
  return places;
}

// The same word of the same mark from frame to frame.
std::string word_name(const WorldVector& vector) {
  return std::to_string(int(vector.kind)) + " " + vector.label;
}

}  // namespace

void VectorPeaks::add(const WorldVector& vector) {
  const double magnitude = vector.value.norm();
  double& most = largest[std::size_t(vector.kind)];
  if (std::isfinite(magnitude)) most = std::max(most, magnitude);
}

void VectorPeaks::add(const VectorPeaks& other) {
  for (std::size_t i = 0; i < largest.size(); ++i) largest[i] = std::max(largest[i], other.largest[i]);
}

VectorScale VectorScales::of(VectorKind kind) const {
  if (kind == VectorKind::torque) return {peaks.of(kind), kWidestTurn * std::numbers::pi / 180};
  return {peaks.of(kind), shrink * size::kLongestArrow};
}

Color color_of(VectorKind kind, const Theme& theme) {
  switch (kind) {
    case VectorKind::velocity:
      return theme.velocity;
    case VectorKind::weight:
      return theme.force;
    case VectorKind::constraint:
      return theme.constraint;
    default:
      return theme.torque;
  }
}

std::string name_of(VectorKind kind) {
  switch (kind) {
    case VectorKind::torque:
      return "torque";
    case VectorKind::joint_force:
      return "joint force";
    case VectorKind::velocity:
      return "velocity";
    case VectorKind::weight:
      return "weight";
    case VectorKind::constraint:
      return "constraint force";
  }
  return "";
}

std::string unit_of(VectorKind kind) {
  return kind == VectorKind::torque ? "N m" : kind == VectorKind::velocity ? "m/s" : "N";
}

std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme) {
  std::vector<ScaleEntry> entries;
  for (const VectorKind kind : shown) {
    const VectorScale scale = scales.of(kind);
    const std::string name = named ? name_of(kind) + " " : "";
    const auto mark = kind == VectorKind::torque       ? ScaleEntry::Mark::turn
                      : kind == VectorKind::constraint ? ScaleEntry::Mark::dashed_arrow
                                                       : ScaleEntry::Mark::arrow;
    if (scale.largest > 0) {
      const double value = round_length(scale.largest);
      entries.push_back({mark, scale.on_page(value), color_of(kind, theme),
                         name + format_shortest(value) + "\u2009" + unit_of(kind)});
    } else if (kind == VectorKind::torque) {
      // Rings are drawn where nothing acts; arrows are not.
      entries.push_back({mark, 0, color_of(kind, theme), name + "0"});
    }
  }
  return entries;
}

VectorPen::VectorPen(const Theme& theme, const Fonts& fonts, double text_scale, const VectorScales& scales)
    : theme_(&theme), fonts_(&fonts), text_scale_(text_scale), scales_(scales) {}

const TextLine& VectorPen::label(const WorldVector& vector, double marks) const {
  const auto key = std::tuple{vector.kind, vector.label, marks};
  const auto known = labels_.find(key);
  if (known != labels_.end()) return known->second;
  const TextStyle style{Face::math, scaled(size::kSymbol * std::sqrt(marks), text_scale_),
                        color_of(vector.kind, *theme_), Align::left};
  return labels_.emplace(key, lay_out_math(*fonts_, vector.label, style)).first->second;
}

VectorPen::Straight VectorPen::straight(const WorldVector& vector, const Camera& camera, double marks) const {
  const VectorScale scale = scales_.of(vector.kind);
  const double magnitude = vector.value.norm();
  double length = scale.on_page(magnitude);
  Straight arrow;
  arrow.cut = length > scales_.shrink * size::kArrowCut * (1 + 1e-12);
  if (arrow.cut) length = scales_.shrink * size::kArrowCut;
  if (!(magnitude > 0) || !std::isfinite(magnitude)) return arrow;
  const Camera seen = camera.seen_at(vector.place);
  arrow.v = (length / magnitude) * on_page(vector.value, seen);
  const Point rail = on_page(vector.rail, seen);
  if (norm(rail) > 0) {
    // On the side where there is no ground.
    Point side = normal_to(unit(rail));
    if (side.y < -1e-9 || (std::abs(side.y) <= 1e-9 && side.x < 0)) side = -1 * side;
    arrow.shift = (marks * size::kBesideRail) * side;
  }
  return arrow;
}

Rect VectorPen::extent(const WorldVector& vector, const Camera& camera, double marks) const {
  const TextLine& text = label(vector, marks);
  if (vector.kind == VectorKind::torque) {
    const double r = marks * (size::kTorqueArc + size::kArrowHeadWidth / 2);
    return around({-r, -r, r, r}, label_box(text, {0, r}, {0, 1}));
  }
  const Straight arrow = straight(vector, camera, marks);
  if (norm(arrow.v) < size::kShortestArrow) return {};
  const double half = marks * size::kArrowHeadWidth / 2;
  const Point tail = arrow.shift, tip = arrow.shift + arrow.v;
  const Rect shaft{std::min(tail.x, tip.x) - half, std::min(tail.y, tip.y) - half,
                   std::max(tail.x, tip.x) + half, std::max(tail.y, tip.y) + half};
  if (vector.label.empty()) return shaft;
  return around(shaft, label_box(text, tip, unit(arrow.v)));
}

void VectorPen::add_to(FitBox& box, const WorldVector& vector, const Camera& camera, double marks) const {
  const Rect r = extent(vector, camera, marks);
  const Point place = camera.flat(vector.place);
  const std::array<double, 4> sides{-r.x0, r.x1, -r.y0, r.y1};
  for (int side = 0; side < 4; ++side) {
    const int steps = int(std::ceil(sides[std::size_t(side)] / kRoomStep));
    if (steps <= 0) continue;
    Room room;
    (side == 0 ? room.left : side == 1 ? room.right : side == 2 ? room.down : room.up) = steps * kRoomStep;
    box.add(room, place);
  }
}

void VectorPen::draw_torque(Picture& picture, const WorldVector& vector, const Camera& camera, double marks,
                            int clip, MarkLabels& labels) const {
  const Point center = camera.project(vector.place);
  const double radius = marks * size::kTorqueArc;
  const Camera seen = camera.seen_at(vector.place);
  const Circle circle = circle_about(vector.axis, seen);
  const Point u = radius * on_page(circle.top, seen), w = radius * on_page(circle.quarter, seen);
  const VectorScale scale = scales_.of(vector.kind);
  const double value = vector.value.dot(vector.axis);
  ArrowStyle style{color_of(vector.kind, *theme_), marks, false, false};
  if (!(std::abs(value) >= kRingBelow * scale.largest) || scale.largest == 0) {
    draw_ring(picture, center, u, w, style.color, clip);
  } else {
    style.cut = std::abs(value) > scale.largest * (1 + 1e-12);
    const double turn = style.cut ? scale.page_of_largest : scale.on_page(std::abs(value));
    draw_turn(picture, center, u, w, value > 0 ? turn : -turn, style, clip);
  }
  const TextLine& text = label(vector, marks);
  const double off = radius + marks * size::kArrowHeadWidth / 2 + kVectorLabelGap;
  std::vector<Rect> places = places_about(text, center, off, {0, 1});
  for (const Rect& far : places_about(text, center, off + kFarLabelGap, {0, 1})) places.push_back(far);
  labels.add({word_name(vector), text, std::move(places)});
}

void VectorPen::draw(Picture& picture, const WorldVector& vector, const Camera& camera, double marks, int clip,
                     MarkLabels& labels) const {
  const Point place = camera.project(vector.place);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return;
  if (vector.kind == VectorKind::torque) return draw_torque(picture, vector, camera, marks, clip, labels);
  const Straight arrow = straight(vector, camera, marks);
  if (norm(arrow.v) < size::kShortestArrow) return;
  const Point tail = place + arrow.shift;
  draw_arrow(picture, tail, arrow.v,
             {color_of(vector.kind, *theme_), marks, vector.kind == VectorKind::constraint, arrow.cut},
             clip);
  if (vector.label.empty()) return;
  const TextLine& text = label(vector, marks);
  labels.add({word_name(vector), text, places_along(text, tail, arrow.v, marks * size::kArrowHeadWidth / 2)});
}

}  // namespace chainreel

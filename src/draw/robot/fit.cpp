// Half sizes are given on the page, places in metres, so the box in metres depends on the scale s that it
// decides: with w metres between the places and c page units of room, s (w + c / s)(1 + 2 margin) = A. The
// iteration s <- A / ((w + c / s)(1 + 2 margin)) shrinks its error by c (1 + 2 margin) / A a pass, a tenth or
// so.
#include "draw/robot/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "picture/point.hpp"

namespace chainreel {
namespace {

constexpr double kKeptBesideMarks = 0.5;  // of the scale without them
constexpr int kPasses = 60;  // to the last bit also where the room takes half of the area

Room room_at(const Room& room, double scale) {
  if (room.metres < 0) return room;
  const double bound = room.metres * scale + room.beyond;
  return {std::min(room.left, bound), std::min(room.right, bound), std::min(room.down, bound),
          std::min(room.up, bound), -1, 0, room.in_margin};
}

}  // namespace

void FitBox::add(const Room& room, Point place_m) {
  if (!std::isfinite(place_m.x) || !std::isfinite(place_m.y)) return;
  const Rect place{place_m.x, place_m.y, place_m.x, place_m.y};
  const auto [known, is_new] = places_.emplace(room, place);
  if (!is_new) known->second = around(known->second, place);
}

void FitBox::add(const FitBox& other) {
  for (const auto& [room, places] : other.places_) {
    const auto [known, is_new] = places_.emplace(room, places);
    if (!is_new) known->second = around(known->second, places);
  }
}

Rect FitBox::box(double scale, double margin) const {
  std::optional<Rect> bare, over;
  for (const auto& [any_scale, places] : places_) {
    const Room room = room_at(any_scale, scale);
    const Rect r{places.x0 - room.left / scale, places.y0 - room.down / scale, places.x1 + room.right / scale,
                 places.y1 + room.up / scale};
    std::optional<Rect>& whole = room.in_margin ? over : bare;
    whole = whole ? around(*whole, r) : r;
  }
  if (!bare) return over.value_or(Rect{});
  const double dx = margin * bare->width(), dy = margin * bare->height();
  const Rect wide{bare->x0 - dx, bare->y0 - dy, bare->x1 + dx, bare->y1 + dy};
  return over ? around(wide, *over) : wide;
}

void fit_to(Camera& camera, const FitBox& box, const Rect& area, double margin) {
  // Without any extent in metres there is nothing to scale by: one metre is shown.
  const Rect bare = box.box(std::numeric_limits<double>::infinity());
  if (box.empty() || std::max(bare.width(), bare.height()) <= 0) {
    fit(camera, {bare.x0 - 0.5, bare.y0 - 0.5, bare.x1 + 0.5, bare.y1 + 0.5}, area, margin);
    return;
  }
  fit(camera, bare, area, margin);
  // Marks that would fill the area by themselves stick out of it rather than shrink the motion to nothing.
  const double least = kKeptBesideMarks * camera.scale;
  for (int pass = 0; pass < kPasses && camera.scale > least; ++pass) fit(camera, box.box(camera.scale, margin), area, 0);
  if (camera.scale > least) return;
  camera.scale = least;
  const Rect shown = box.box(least, margin);
  camera.origin = center_of(area) - least * center_of(shown);
}

namespace {

// Where the origin of an axis lies on the page: the middle of what is wished for is that of the area, but what must be
// seen stays inside.
double placed(double must_low, double must_high, double low, double high, double area_low, double area_high) {
  const double origin = (area_low + area_high - low - high) / 2;
  return std::clamp(origin, std::min(area_low - must_low, area_high - must_high), std::max(area_low - must_low, area_high - must_high));
}

}  // namespace

void fit_to(Camera& camera, const FitBox& box, const FitBox& wishes, const Rect& area, double margin) {
  fit_to(camera, box, area, margin);
  if (wishes.empty()) return;
  FitBox all = box;
  all.add(wishes);
  const double least = kKeptForWishes * camera.scale;
  fit_to(camera, all, area, margin);
  if (camera.scale >= least) return;
  const double s = camera.scale = least;
  const Rect must = box.box(s, margin), whole = all.box(s, margin);
  camera.origin = {placed(s * must.x0, s * must.x1, s * whole.x0, s * whole.x1, area.x0, area.x1),
                   placed(s * must.y0, s * must.y1, s * whole.y0, s * whole.y1, area.y0, area.y1)};
}

using Eigen::Vector3d;

Vector3d up_of(const Chain& chain) {
  return chain.gravity.norm() > 1e-9 ? Vector3d(-chain.gravity.normalized()) : Vector3d(Vector3d::UnitZ());
}

MotionBox::MotionBox(const Vector3d& up) : up_(up) {
  const Vector3d near = std::abs(up.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d first = (near - up.dot(near) * up).normalized();
  upright_ << first.transpose(), up.cross(first).transpose(), up.transpose();
}

std::array<Vector3d, 8> MotionBox::corners() const {
  std::array<Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[std::size_t(i)] = upright_.transpose() * box_.corner(Eigen::AlignedBox3d::CornerType(i));
  return corners;
}

}  // namespace chainreel

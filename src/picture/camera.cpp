#include "picture/camera.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace chainreel {
namespace {

// A share of the way from `focus` to the eye: nearer points have no picture.
constexpr double kBesideTheEye = 1e-3;

}  // namespace

Point Camera::flat(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d r = x - focus;
  const double share = 1 - nearing.dot(r);
  if (share < kBesideTheEye) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  return {right.dot(r) / share, up.dot(r) / share};
}

Point Camera::flat_vector(const Eigen::Vector3d& v, const Eigen::Vector3d& x) const {
  const double share = 1 - nearing.dot(x - focus);
  const Point at = flat(x);
  const double toward = nearing.dot(v);
  return {(right.dot(v) + toward * at.x) / share, (up.dot(v) + toward * at.y) / share};
}

Camera Camera::seen_at(const Eigen::Vector3d& x) const {
  Camera local = *this;
  if (!has_eye()) return local;
  const Point at = flat(x);
  local.right += at.x * nearing;
  local.up += at.y * nearing;
  local.toward_viewer = local.right.cross(local.up).normalized();
  local.nearing.setZero();
  return local;
}

void fit(Camera& camera, const Rect& box_m, const Rect& area, double margin) {
  double width_m = box_m.width() * (1 + 2 * margin);
  double height_m = box_m.height() * (1 + 2 * margin);
  if (!(width_m > 0) && !(height_m > 0)) width_m = height_m = 1;

  // A box that is only a line is bounded by one of the two quotients; the other is infinite.
  const double scale_x = width_m > 0 ? area.width() / width_m : HUGE_VAL;
  const double scale_y = height_m > 0 ? area.height() / height_m : HUGE_VAL;
  camera.scale = std::min(scale_x, scale_y);
  const Point center_m = {(box_m.x0 + box_m.x1) / 2, (box_m.y0 + box_m.y1) / 2};
  const Point center = {(area.x0 + area.x1) / 2, (area.y0 + area.y1) / 2};
  camera.origin = center - camera.scale * center_m;
}

}  // namespace chainreel

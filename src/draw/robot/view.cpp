#include "draw/robot/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kAzimuth = 35 * std::numbers::pi / 180;
constexpr double kElevation = 20 * std::numbers::pi / 180;
constexpr double kFieldOfView = 30 * std::numbers::pi / 180;  // from the lower to the upper edge of the scene
constexpr int kEyePasses = 6;  // scale and distance depend on one another; each pass leaves a tenth or so
constexpr double kLeastClear = 1.05;  // ... also where the scene says how far it is
constexpr double kClear = 1.5;        // the eye keeps this many times the way to the nearest place
// Unit vectors whose part in the plane is shorter than this count as normal to it: far above round-off of the
// axes of a file, far below an angle that anyone draws.
constexpr double kNegligible = 1e-6;

Vector3d in_plane(const Plane& plane, const Vector3d& v) {
  return v - plane.normal.dot(v) * plane.normal;
}

Vector3d up_in(const Plane& plane, const Vector3d& gravity) {
  const Vector3d against_gravity = in_plane(plane, -gravity);
  if (against_gravity.norm() > kNegligible * (1 + gravity.norm())) return against_gravity.normalized();
  const Vector3d y = in_plane(plane, Vector3d::UnitY());
  if (y.norm() > kNegligible) return y.normalized();
  return in_plane(plane, Vector3d::UnitZ()).normalized();
}

// From the first joint to the farthest frame of its body or to its first child: where the first link points
// at zero.
Vector3d first_link(const Chain& chain) {
  const PlanarChain& planar = *chain.planar;
  for (std::size_t b = 2; b < chain.bodies.size(); ++b) {
    const Vector3d r = planar.X_WB_zero[b].translation() - planar.X_WB_zero[1].translation();
    if (r.norm() > kNegligible) return r;
  }
  Vector3d farthest = Vector3d::Zero();
  for (const Frame& frame : chain.frames) {
    if (frame.body != 1) continue;
    const Vector3d r = planar.X_WB_zero[1].linear() * frame.X_BF.translation();
    if (r.norm() > farthest.norm()) farthest = r;
  }
  return farthest;
}

Camera planar_view(const Chain& chain) {
  const Plane& plane = chain.planar->plane;
  Camera camera;
  camera.up = up_in(plane, chain.gravity);
  camera.right = camera.up.cross(plane.normal).normalized();
  double rightward = camera.right.x();
  // Where x is upright z faces the viewer, lest turns be seen from behind; the first link decides where x is not in the plane.
  if (std::abs(rightward) <= kNegligible) rightward = camera.right.cross(camera.up).z();
  if (std::abs(rightward) <= kNegligible && chain.bodies.size() > 1)
    rightward = camera.right.dot(first_link(chain));
  if (rightward < -kNegligible) camera.right = -camera.right;
  camera.toward_viewer = camera.right.cross(camera.up);
  return camera;
}

// Against gravity where that acts along an axis of the world; z where it does not, or there is none.
Vector3d upright_axis(const Chain& chain) {
  for (const Vector3d& axis : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::UnitZ())})
    if (const double along = chain.gravity.dot(axis); (chain.gravity - along * axis).norm() < kNegligible * std::abs(along)) return along > 0 ? Vector3d(-axis) : axis;
  return Vector3d::UnitZ();
}

// Azimuth 0, elevation 0: the plane's own view, or x to the right and z up; as far as gravity leaves it so.
Camera front_view(const Chain& chain) {
  if (chain.planar) return planar_view(chain);
  Camera camera;
  camera.up = upright_axis(chain);
  camera.right = std::abs(camera.up.x()) > 0.5 ? Vector3d::UnitY() : Vector3d::UnitX();
  camera.toward_viewer = camera.right.cross(camera.up);
  return camera;
}

}  // namespace

namespace {

// To two digits.
double rounded_up(double value) {
  if (!(value > 0)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::ceil(value / unit) * unit;
}

// Along which things grow, by 1 for each m that leads to the eye. Horizontal, so that what stands upright is drawn so; seen from
// high above, where that would stretch the page, straight to the viewer.
Vector3d direction_of_growth(const Vector3d& toward_viewer, const Vector3d& up) {
  constexpr double kSteep = 0.5;  // of elevations above 45 degrees
  const Vector3d level = toward_viewer - up.dot(toward_viewer) * up;
  return level.squaredNorm() < kSteep ? toward_viewer : Vector3d(level / level.squaredNorm());
}

}  // namespace

bool is_oblique(const Chain& chain, const CameraEntry& entry) {
  return !chain.planar || entry.azimuth || entry.elevation;
}

bool has_eye(const Chain& chain, const CameraEntry& entry) {
  return entry.distance ? std::isfinite(*entry.distance) : is_oblique(chain, entry);
}

Camera view_of(const Chain& chain, const CameraEntry& entry) {
  if (entry.focus && !has_eye(chain, entry))
    throw Error(ExitCode::bad_input, "'camera.focus' is where an eye looks, and here the rays are parallel: give a camera.distance, or leave it out");
  Camera camera = front_view(chain);
  if (!is_oblique(chain, entry)) return camera;
  const double azimuth = entry.azimuth.value_or(chain.planar ? 0 : kAzimuth);
  const double elevation = entry.elevation.value_or(chain.planar ? 0 : kElevation);
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  const Vector3d right = camera.right, up = camera.up, ahead = camera.toward_viewer;
  camera.toward_viewer = ce * ca * ahead + ce * sa * right + se * up;
  camera.right = ca * right - sa * ahead;
  camera.up = camera.toward_viewer.cross(camera.right);
  return camera;
}

void place_eye(Camera& camera, const MotionBox& motion, const CameraEntry& entry, double height,
               const std::function<void(Camera&)>& fit, const Place& place) {
  if (motion.empty()) return;
  camera.focus = entry.focus.value_or(motion.middle());
  const Vector3d growing = direction_of_growth(camera.toward_viewer, motion.up());
  double nearest = 0;  // m before the focus
  for (const Vector3d& corner : motion.corners()) nearest = std::max(nearest, growing.dot(corner - camera.focus));
  const double least = kLeastClear * nearest;
  if (entry.distance && *entry.distance < least)
    throw Error(ExitCode::bad_input,
                "'camera.distance' puts the eye among the bodies: " +
                    format_significant(rounded_up(least), 2) + " m are needed at least",
                place);
  for (int pass = 0; pass < kEyePasses; ++pass) {
    fit(camera);
    const double seen = height / camera.scale / 2;  // m above and below the focus
    const double fitting = std::max(seen / std::tan(kFieldOfView / 2), kClear * nearest);
    camera.nearing = growing / entry.distance.value_or(fitting);
  }
  fit(camera);
}

bool fit_as_told(Camera& camera, const CameraEntry& entry, const Rect& area) {
  if (!entry.fit) return false;
  const auto& [left, bottom, right, top] = *entry.fit;
  const double x = camera.right.dot(camera.focus), y = camera.up.dot(camera.focus);
  fit(camera, {left - x, bottom - y, right - x, top - y}, area, 0);
  return true;
}

KeptCamera kept_camera(const Camera& camera, const Rect& area) {
  KeptCamera kept{part_shown(camera, area), {}};
  if (camera.has_eye()) kept.eye = {camera.focus.x(), camera.focus.y(), camera.focus.z(), camera.distance()};
  return kept;
}

std::array<double, 4> part_shown(const Camera& camera, const Rect& area) {
  const double x = camera.right.dot(camera.focus), y = camera.up.dot(camera.focus);
  return {(area.x0 - camera.origin.x) / camera.scale + x, (area.y0 - camera.origin.y) / camera.scale + y,
          (area.x1 - camera.origin.x) / camera.scale + x, (area.y1 - camera.origin.y) / camera.scale + y};
}

Camera aimed_camera(const Chain& chain, const CameraEntry& entry, const MotionBox& motion, const Rect& area,
                    const std::function<void(Camera&)>& fit) {
  Camera camera = view_of(chain, entry);
  const auto fit_or_obey = [&](Camera& seen) {
    if (!fit_as_told(seen, entry, area)) fit(seen);
  };
  if (has_eye(chain, entry))
    place_eye(camera, motion, entry, area.height(), fit_or_obey, {});
  else
    fit_or_obey(camera);
  return camera;
}

}  // namespace chainreel

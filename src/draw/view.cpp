#include "draw/view.hpp"

#include <cmath>
#include <numbers>

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kAzimuth = 35 * std::numbers::pi / 180;
constexpr double kElevation = 20 * std::numbers::pi / 180;
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
  if (std::abs(rightward) <= kNegligible && chain.bodies.size() > 1)
    rightward = camera.right.dot(first_link(chain));
  if (rightward < -kNegligible) camera.right = -camera.right;
  camera.toward_viewer = camera.right.cross(camera.up);
  return camera;
}

}  // namespace

Camera view_of(const Chain& chain) {
  if (chain.planar) return planar_view(chain);
  Camera camera;
  const double ca = std::cos(kAzimuth), sa = std::sin(kAzimuth);
  const double ce = std::cos(kElevation), se = std::sin(kElevation);
  camera.toward_viewer = {ce * sa, -ce * ca, se};
  camera.right = {ca, sa, 0};
  camera.up = camera.toward_viewer.cross(camera.right);
  return camera;
}

}  // namespace chainreel

#include "draw/motion_box.hpp"

#include <cmath>

namespace chainreel {

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

#include "model/pose.hpp"

#include <cmath>

namespace chainreel {

std::string trouble_of_pose(const Chain& chain, std::span<const double> q) {
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind != JointKind::floating) continue;
    const auto part = q.subspan(std::size_t(joint.q_index) + 3, 4);
    const double length = std::hypot(std::hypot(part[0], part[1]), std::hypot(part[2], part[3]));
    // Its square must be a number to divide by.
    if (!(length > 1e-150) || !(length < 1e150))
      return "the quaternion of '" + joint.name + "' (qx qy qz qw) has no direction: 0, 0, 0, 1 turns nothing";
  }
  return "";
}

}  // namespace chainreel

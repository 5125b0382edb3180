#include "model/chain.hpp"

#include <cmath>

#include "core/error.hpp"

namespace chainreel {

double mass_of(const Chain& chain) {
  double mass = 0;
  for (const Body& body : chain.bodies) mass += body.inertia.mass;
  return mass;
}

int find_frame(const Chain& chain, const std::string& name) {
  for (std::size_t i = 0; i < chain.frames.size(); ++i)
    if (chain.frames[i].name == name) return int(i);
  return -1;
}

int require_end_effector(const Chain& chain) {
  if (chain.end_effector >= 0) return chain.end_effector;
  std::string leaves;
  for (const int frame : chain.leaf_frames)
    leaves += (leaves.empty() ? "" : ", ") + chain.frames[std::size_t(frame)].name;
  throw Error(ExitCode::bad_input,
              "the model '" + chain.name +
                  "' has no link 'gripper' and several ends: choose the end effector with "
                  "`--set end_effector=NAME`; the ends are " +
                  leaves);
}

std::vector<std::size_t> places_of_joint(std::span<const std::string> names, const std::string& joint) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == joint || names[i].starts_with(joint + ".")) places.push_back(i);
  return places;
}

std::vector<std::string> position_names(const Chain& chain) {
  std::vector<std::string> names(std::size_t(chain.nq));
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const auto at = std::size_t(joint.q_index);
    if (joint.kind != JointKind::floating) {
      names[at] = chain.coordinate_names[std::size_t(joint.v_index)];
      continue;
    }
    const char* parts[] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
    for (std::size_t k = 0; k < 7; ++k) names[at + k] = joint.name + "." + parts[k];
  }
  return names;
}

std::vector<double> zero_configuration(const Chain& chain) {
  std::vector<double> q(std::size_t(chain.nq), 0.0);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind == JointKind::floating) q[std::size_t(joint.q_index) + 6] = 1;
  }
  return q;
}

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

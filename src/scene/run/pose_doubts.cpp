#include "scene/run/pose_doubts.hpp"

#include <cmath>
#include <numbers>

#include "core/format.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

// Of rounding, as where a limit of 1.5708 is given as 90deg; rad or m.
constexpr double kNear = 1e-4;

// "126 deg" or "0.3 m"
std::string told(double value, bool turns) {
  return turns ? format_significant(value * 180 / std::numbers::pi, 4) + " deg" : format_significant(value, 4) + " m";
}

std::string doubt_of_limits(const Joint& joint, double value) {
  const bool turns = joint.kind == JointKind::revolute;
  const JointLimit& limit = joint.limit;
  if (value >= limit.lower - kNear && value <= limit.upper + kNear) return "";
  return joint.name + " at " + told(value, turns) + " is beyond its limits, " + told(limit.lower, turns) + " to " +
         told(limit.upper, turns);
}

}  // namespace

std::vector<std::string> doubts_of_pose(const Chain& chain, std::span<const double> q, std::span<const std::string> written) {
  std::vector<std::string> doubts;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const bool is_own = joint.kind != JointKind::floating && joint.ratio == 1 && joint.offset == 0 && joint.q_index >= 0;
    const auto at = std::size_t(joint.q_index);
    if (!is_own || at >= q.size()) continue;
    std::string doubt;
    if (at < written.size() && !written[at].empty() && joint.kind == JointKind::revolute)
      doubt = doubt_of_angle(written[at], q[at], " of " + joint.name);
    if (doubt.empty()) doubt = doubt_of_limits(joint, q[at]);
    if (!doubt.empty()) doubts.push_back(std::move(doubt));
  }
  return doubts;
}

}  // namespace chainreel

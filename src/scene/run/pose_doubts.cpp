#include "scene/run/pose_doubts.hpp"

#include <algorithm>
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

// One a coordinate or a freedom; "" of a quaternion's numbers, which have none.
std::vector<std::string> units_of(const Chain& chain, StateNumbers numbers) {
  const auto unit = [&](bool turns) {
    if (numbers == StateNumbers::q) return turns ? "rad" : "m";
    if (numbers == StateNumbers::qd) return turns ? "rad/s" : "m/s";
    return turns ? "N m" : "N";
  };
  const bool is_q = numbers == StateNumbers::q;
  std::vector<std::string> units(std::size_t(is_q ? chain.nq : chain.nv));
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const auto at = std::size_t(is_q ? joint.q_index : joint.v_index);
    if (joint.kind != JointKind::floating) {
      units[at] = unit(joint.kind == JointKind::revolute);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      units[at + k] = unit(false);
      if (!is_q) units[at + 3 + k] = unit(true);
    }
  }
  return units;
}

}  // namespace

std::vector<std::string> names_of_state(const Chain& chain, StateNumbers numbers) {
  return numbers == StateNumbers::q ? position_names(chain) : chain.coordinate_names;
}

std::string trouble_of_units(const Chain& chain, std::span<const std::string> written, StateNumbers numbers) {
  const std::vector<std::string> units = units_of(chain, numbers);
  const std::vector<std::string> names = names_of_state(chain, numbers);
  for (std::size_t i = 0; i < std::min(units.size(), written.size()); ++i) {
    const std::string kind = unit_kind(written[i]);
    if (kind.empty() || kind == units[i]) continue;
    return written[i] + " of " + names[i] + " is in the unit " + kind + ", but " +
           (units[i].empty() ? "a quaternion's numbers have none" : "this is in " + units[i]);
  }
  return "";
}

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

#include "sim/drive/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {

std::span<const Name> names_of(LimitPolicy) {
  static constexpr Name names[] = {{"report", "said in the audit"},
                                   {"clamp", "and torques are cut at the joint's effort"},
                                   {"stop", "and the run ends where one is passed"}};
  return names;
}

std::string to_string(const LimitEvent& event) {
  // Where the instant of the passage itself is known, the value is the limit, but for rounding.
  const std::string limit = format_significant(event.limit, 6);
  const bool is_there = format_significant(std::abs(event.limit), 6) == format_significant(std::abs(event.value), 6);
  return "joint '" + event.joint + "' passed its " + event.quantity + " limit " + limit + (is_there ? "" : " with " + format_significant(event.value, 6)) +
         " at t = " + format_significant(event.t, 6) + " s";
}

LimitWatch::LimitWatch(const Chain& chain) {
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const JointLimit& limit = joint.limit;
    const bool limited = std::isfinite(limit.lower) || std::isfinite(limit.upper) ||
                         std::isfinite(limit.velocity) || std::isfinite(limit.effort);
    if (!limited || joint.kind == JointKind::floating) continue;
    const bool owns_freedom = chain.coordinate_names[std::size_t(joint.v_index)] == joint.name;
    watched_.push_back({.joint = &joint, .has_torque = owns_freedom});
  }
}

bool LimitWatch::add(const Joint& joint, const char* quantity, double t, double value, double limit) {
  events_.push_back({joint.name, quantity, t, value, limit});
  return true;
}

bool LimitWatch::check_state(double t, ConstVec q, ConstVec qd) {
  bool added = false;
  for (Watched& one : watched_) {
    const Joint& joint = *one.joint;
    const JointLimit& limit = joint.limit;
    const double value = joint.ratio * q[std::size_t(joint.q_index)] + joint.offset;
    const double rate = joint.ratio * qd[std::size_t(joint.v_index)];
    if (!one.position_passed && (value < limit.lower - touched(limit.lower) || value > limit.upper + touched(limit.upper))) {
      one.position_passed = true;
      added = add(joint, "position", t, value, value < limit.lower ? limit.lower : limit.upper);
    }
    if (!one.velocity_passed && std::abs(rate) > limit.velocity + touched(limit.velocity)) {
      one.velocity_passed = true;
      added = add(joint, "velocity", t, rate, limit.velocity);
    }
  }
  return added;
}

double LimitWatch::distance(std::size_t measure, ConstVec q, ConstVec qd, ConstVec tau) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Watched& one = watched_[measure / 4];
  const Joint& joint = *one.joint;
  const double value = joint.ratio * q[std::size_t(joint.q_index)] + joint.offset;
  switch (measure % 4) {
    case 0:
      return one.position_passed ? kFar : joint.limit.upper + touched(joint.limit.upper) - value;
    case 1:
      return one.position_passed ? kFar : value - joint.limit.lower + touched(joint.limit.lower);
    case 2:
      return one.velocity_passed ? kFar : joint.limit.velocity + touched(joint.limit.velocity) - std::abs(joint.ratio * qd[std::size_t(joint.v_index)]);
    default:
      return one.effort_passed || !one.has_torque || tau.empty() ? kFar : joint.limit.effort + touched(joint.limit.effort) - std::abs(tau[std::size_t(joint.v_index)]);
  }
}

// The torque of a joint that passes its effort; null of one that does not.
double* LimitWatch::excessive(const Watched& one, Vec tau) {
  if (!one.has_torque) return nullptr;
  double& torque = tau[std::size_t(one.joint->v_index)];
  return std::abs(torque) > one.joint->limit.effort ? &torque : nullptr;
}

bool LimitWatch::check_effort(double t, Vec tau, bool clamp) {
  bool added = false;
  for (Watched& one : watched_) {
    const double* const torque = excessive(one, tau);
    if (!torque || one.effort_passed || !(std::abs(*torque) > one.joint->limit.effort + touched(one.joint->limit.effort))) continue;
    one.effort_passed = true;
    added = add(*one.joint, "effort", t, *torque, one.joint->limit.effort);
  }
  if (clamp) cut(tau);
  return added;
}

void LimitWatch::cut(Vec tau) const {
  for (const Watched& one : watched_)
    if (double* const torque = excessive(one, tau)) *torque = std::copysign(one.joint->limit.effort, *torque);
}

bool LimitWatch::have_effort() const {
  return std::any_of(watched_.begin(), watched_.end(),
                     [](const Watched& one) { return std::isfinite(one.joint->limit.effort); });
}

}  // namespace chainreel

#include "sim/watch/limit_search.hpp"

#include <algorithm>
#include <cmath>

#include "sim/watch/events.hpp"
#include "sim/watch/first_instant.hpp"

namespace chainreel {
namespace {

// What the limit is about: a position, a rate or a torque.
double value_of_limit(const LimitEvent& seen, ChainSystem& system, double t, ConstVec q, ConstVec qd) {
  const auto& bodies = system.chain().bodies;
  const auto body = std::find_if(bodies.begin() + 1, bodies.end(),
                                 [&](const auto& one) { return one.joint.name == seen.joint; });
  const Joint& joint = body->joint;
  if (seen.quantity == "position") return joint.ratio * q[std::size_t(joint.q_index)] + joint.offset;
  if (seen.quantity == "velocity") return joint.ratio * qd[std::size_t(joint.v_index)];
  return system.uncut_torque(t, q, qd)[std::size_t(joint.v_index)];
}

double beyond(const LimitEvent& seen, double value) {
  if (seen.quantity != "position") return std::fabs(value) - seen.limit;
  return seen.value > seen.limit ? value - seen.limit : seen.limit - value;
}

}  // namespace

double excess_of(const LimitEvent& seen, ChainSystem& system, double t, ConstVec q, ConstVec qd) {
  return beyond(seen, value_of_limit(seen, system, t, q, qd));
}

std::optional<LimitEvent> first_passing(const LimitEvent& seen, ChainSystem& system, Integrator& integrator) {
  std::vector<double> q(std::size_t(system.nq())), qd(std::size_t(system.nv()));
  const double begin = integrator.begin_time(), end = integrator.time();
  const auto value_at = [&](double t) {
    if (t == end) return value_of_limit(seen, system, t, integrator.q(), integrator.v());
    integrator.interpolate(t, q, qd);
    return value_of_limit(seen, system, t, q, qd);
  };
  const auto excess_at = [&](double t) { return beyond(seen, value_at(t)); };
  LimitEvent found = seen;
  Look before{begin, excess_at(begin)};
  found.t = begin;
  for (int look = 1; look <= kLooksPerStep && !(before.value > 0); ++look) {
    const double t = look == kLooksPerStep ? end : begin + (end - begin) * look / kLooksPerStep;
    const Look now{t, excess_at(t)};
    if (now.value > 0) {
      found.t = first_instant(before, now, excess_at, [](double excess) { return excess > 0; });
      before.value = now.value;
    } else {
      before = now;
    }
  }
  if (!(before.value > 0)) return {};
  found.value = value_at(found.t);
  return found;
}

}  // namespace chainreel

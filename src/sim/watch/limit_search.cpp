#include "sim/watch/limit_search.hpp"

#include <algorithm>
#include <cmath>

#include "sim/watch/dip.hpp"
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
  if (seen.quantity != "position") return std::fabs(value) - seen.limit - touched(seen.limit);
  return (seen.value > seen.limit ? value - seen.limit : seen.limit - value) - touched(seen.limit);
}

}  // namespace

double excess_of(const LimitEvent& seen, ChainSystem& system, double t, ConstVec q, ConstVec qd) {
  return beyond(seen, value_of_limit(seen, system, t, q, qd));
}

LimitSearch::LimitSearch(ChainSystem& system)
    : system_(system),
      q_(std::size_t(system.nq())),
      qd_(std::size_t(system.nv())),
      before_(system.limits().measures()),
      now_(before_.size()),
      change_(before_.size()) {}

void LimitSearch::read(double t, ConstVec q, ConstVec qd, std::vector<double>& distances) {
  const LimitWatch& limits = system_.limits();
  tau_.clear();
  if (limits.have_effort()) {
    const ConstVec tau = system_.uncut_torque(t, q, qd);
    tau_.assign(tau.begin(), tau.end());
  }
  for (std::size_t k = 0; k < distances.size(); ++k) distances[k] = limits.distance(k, q, qd, tau_);
}

void LimitSearch::look_within(Integrator& integrator, int looks) {
  const double begin = integrator.begin_time(), end = integrator.time();
  if (known_at_ != begin) {
    integrator.interpolate(begin, q_, qd_);
    read(begin, q_, qd_, before_);
    std::ranges::fill(change_, 0.0);
  }
  double last = begin;
  for (int look = 1; look <= looks; ++look) {
    const bool is_end = look == looks;
    const double t = is_end ? end : begin + (end - begin) * look / looks;
    if (is_end) {
      read(t, integrator.q(), integrator.v(), now_);
    } else {
      integrator.interpolate(t, q_, qd_);
      read(t, q_, qd_, now_);
      system_.limits().check_state(t, q_, qd_);
      if (!tau_.empty()) system_.limits().check_effort(t, tau_, false);
    }
    for (std::size_t k = 0; k < now_.size(); ++k) {
      if (now_[k] >= 0 && before_[k] >= 0 && std::isfinite(now_[k])) look_for_a_visit(integrator, k, last, t);
      change_[k] = std::fabs(now_[k] - before_[k]);
    }
    std::swap(before_, now_);
    last = t;
  }
  known_at_ = end;
  system_.forget_bad_torque();
}

void LimitSearch::look_for_a_visit(Integrator& integrator, std::size_t measure, double a, double b) {
  const LimitWatch& limits = system_.limits();
  const double change = std::max(std::fabs(now_[measure] - before_[measure]), std::isfinite(change_[measure]) ? change_[measure] : 0.0);
  const bool is_effort = measure % 4 == 3;
  const auto at = [&](double t) {
    integrator.interpolate(t, q_, qd_);
    return limits.distance(measure, q_, qd_, is_effort ? system_.uncut_torque(t, q_, qd_) : ConstVec{});
  };
  const std::optional<Look> there = visit_between({a, before_[measure]}, {b, now_[measure]}, change, 0, at);
  if (!there) return;
  integrator.interpolate(there->t, q_, qd_);
  system_.limits().check_state(there->t, q_, qd_);
  if (!is_effort) return;
  const ConstVec tau = system_.uncut_torque(there->t, q_, qd_);
  tau_.assign(tau.begin(), tau.end());
  system_.limits().check_effort(there->t, tau_, false);
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
  const auto look_at = [&](double t) {
    const Look now{t, excess_at(t)};
    if (now.value > 0) {
      found.t = first_instant(before, now, excess_at, [](double excess) { return excess > 0; });
      before.value = now.value;
    } else {
      before = now;
    }
  };
  for (int look = 1; look <= kLooksPerStep && !(before.value > 0); ++look) {
    const double t = look == kLooksPerStep ? end : begin + (end - begin) * look / kLooksPerStep;
    if (seen.t > before.t && seen.t < t) look_at(seen.t);
    if (!(before.value > 0)) look_at(t);
  }
  if (!(before.value > 0)) return {};
  found.value = value_at(found.t);
  return found;
}

}  // namespace chainreel

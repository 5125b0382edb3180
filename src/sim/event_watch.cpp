#include "sim/event_watch.hpp"

#include <algorithm>
#include <cmath>

#include "sim/first_instant.hpp"
#include "sim/foot.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kUsualHits = 64;  // room for as many is made before the run

int sign_of(double x) {
  return (x > 0) - (x < 0);
}

bool holds(Event::Test test, double value) {
  switch (test) {
    case Event::Test::above:
      return value > 0;
    case Event::Test::at_or_above:
      return value >= 0;
    case Event::Test::below:
      return value < 0;
    case Event::Test::at_or_below:
      return value <= 0;
    case Event::Test::changes_side:
      return false;
  }
  return false;
}

}  // namespace

EventWatch::EventWatch(const EventSet& events, ChainSystem& system)
    : events_(events),
      system_(system),
      ws_(system.chain()),
      probe_(events.probe),
      before_(events.list.size()),
      now_(events.list.size()),
      q_(std::size_t(system.nq())),
      qd_(std::size_t(system.nv())),
      qdd_(std::size_t(system.nv())) {
  pending_.reserve(events.list.size());
}

void EventWatch::set_probe(double t, ConstVec q, ConstVec qd) {
  const Chain& chain = system_.chain();
  probe_.set(chain, ws_, t, q, qd, events_.needs_kinematics);
  if (events_.needs_multipliers) {
    ConstrainedChain& constrained = *system_.constrained();
    constrained.look(system_.workspace(), q, qd, system_.torque(t, q, qd));
    probe_.set_multipliers(constrained.lambda());
  }
  if (events_.cop_slot < 0) return;
  system_.acceleration(t, q, qd, qdd_);
  probe_.set_value(events_.cop_slot,
                   center_of_pressure(chain, ws_, events_.ground, events_.foot->height, q, qd, qdd_));
}

bool EventWatch::read(double t, ConstVec q, ConstVec qd) {
  set_probe(t, q, qd);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    now_[i] = events_.list[i].value.evaluate(probe_.values());
    if (std::isfinite(now_[i])) continue;
    bad_ = int(i);
    return false;
  }
  return true;
}

bool EventWatch::start(double t, ConstVec q, ConstVec qd) {
  if (!read(t, q, qd)) return false;
  for (std::size_t i = 0; i < now_.size(); ++i)
    before_[i] = {now_[i], holds(events_.list[i].test, now_[i]), sign_of(now_[i])};
  return true;
}

bool EventWatch::happens(const Event& event, const State& before, double value) {
  if (event.test != Event::Test::changes_side) return !before.holds && holds(event.test, value);
  return before.side != 0 && sign_of(value) != before.side;
}

double EventWatch::value_at(Integrator& integrator, const Event& event, double t) {
  integrator.interpolate(t, q_, qd_);
  set_probe(t, q_, qd_);
  return event.value.evaluate(probe_.values());
}

// The first instant found at which the event has happened; within the tolerance before it, it had not.
double EventWatch::locate(Integrator& integrator, std::size_t i, double a, double b) {
  const Event& event = events_.list[i];
  return first_instant(
      {a, before_[i].value}, {b, now_[i]}, [&](double t) { return value_at(integrator, event, t); },
      [&](double value) { return happens(event, before_[i], value); });
}

void EventWatch::record(Integrator& integrator, const Pending& hit, EventHits& hits) {
  if (hits.t.empty()) hits.reserve(kUsualHits, q_.size(), qd_.size());
  if (hit.t == integrator.time())
    hits.add(hit.event, hit.t, integrator.q(), integrator.v());
  else {
    integrator.interpolate(hit.t, q_, qd_);
    hits.add(hit.event, hit.t, q_, qd_);
  }
}

bool EventWatch::check_step(Integrator& integrator, EventHits& hits) {
  const double begin = integrator.begin_time(), end = integrator.time();
  const auto instant = [&](int look) { return begin + (end - begin) * look / kLooksPerStep; };
  for (int look = 1; look <= kLooksPerStep; ++look) {
    const bool last = look == kLooksPerStep;
    const double t = last ? end : instant(look);
    if (!last) integrator.interpolate(t, q_, qd_);
    if (!(last ? read(t, integrator.q(), integrator.v()) : read(t, q_, qd_))) return false;
    pending_.clear();
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (happens(events_.list[i], before_[i], now_[i]))
        pending_.push_back({int(i), locate(integrator, i, instant(look - 1), t)});
    std::sort(pending_.begin(), pending_.end(),
              [](const Pending& x, const Pending& y) { return x.t != y.t ? x.t < y.t : x.event < y.event; });
    for (const Pending& hit : pending_) {
      record(integrator, hit, hits);
      ended_ = ends_the_run(events_.list[std::size_t(hit.event)].kind);
      if (ended_) return true;
    }
    for (std::size_t i = 0; i < now_.size(); ++i)
      before_[i] = {now_[i], holds(events_.list[i].test, now_[i]), sign_of(now_[i])};
  }
  return true;
}

}  // namespace chainreel

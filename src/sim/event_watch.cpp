// The root finder is ITP: I. F. D. Oliveira, R. H. C. Takahashi, An Enhancement of the Bisection Method
// Average Performance Preserving Minmax Optimality, ACM Trans. Math. Softw. 47 (2020) 5, with kappa_1 = 0.2 /
// (b - a), kappa_2 = 2, n_0 = 1. It takes one look more than bisection at worst, whatever the function does
// between the ends, and converges as fast as the secant method where that is smooth.
#include "sim/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double itp_estimate(double a, double b, double ya, double yb, double truncation, double radius) {
  const double half = 0.5 * (a + b);
  // Regula falsi, where it means something.
  const bool brackets = sign_of(ya) * sign_of(yb) < 0 && std::isfinite(ya) && std::isfinite(yb);
  const double secant = brackets ? (yb * a - ya * b) / (yb - ya) : half;
  const double sigma = secant < half ? 1 : -1;
  const double truncated = truncation <= std::abs(half - secant) ? secant + sigma * truncation : half;
  const double x = std::abs(truncated - half) <= radius ? truncated : half - sigma * radius;
  return x > a && x < b ? x : half;
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
  double ya = before_[i].value, yb = now_[i];
  const double ulp = std::nextafter(std::abs(b), std::numeric_limits<double>::max()) - std::abs(b);
  const double tolerance = 0.5 * std::max(kInstantTolerance, 4 * ulp);
  const double kappa = 0.2 / (b - a);
  const int most = 1 + int(std::ceil(std::max(0.0, std::log2((b - a) / (2 * tolerance)))));
  for (int j = 0; j <= most && b - a > 2 * tolerance; ++j) {
    const double radius = tolerance * std::ldexp(1, most - j) - 0.5 * (b - a);
    const double x = itp_estimate(a, b, ya, yb, kappa * (b - a) * (b - a), std::max(radius, 0.0));
    const double y = value_at(integrator, event, x);
    if (happens(event, before_[i], y)) {
      b = x;
      yb = y;
    } else {
      a = x;
      ya = y;
    }
  }
  return b;
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

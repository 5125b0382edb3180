#include "sim/watch/events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "expr/course.hpp"
#include "sim/drive/probe.hpp"
#include "sim/watch/dip.hpp"
#include "sim/watch/first_instant.hpp"

namespace chainreel {
namespace {

Event::Test test_of(const Expression& when, const EventEntry& entry) {
  const std::optional<Operation> comparison = when.comparison();
  const auto refuse = [&](const std::string& why) -> Event::Test {
    throw Error(ExitCode::bad_input, "the event `" + entry.when + "` " + why, entry.place);
  };
  if (when.used_variables().empty()) return refuse("reads nothing that changes, so it can never happen");
  const bool has_both_signs = values_of(when.difference().program()).has_both_signs();
  if (!comparison && when.compares_inside() && !has_both_signs)
    return refuse(
        "is 1 or 0 and never crosses zero: write `min(q1 > 1, t > 2) > 0` for both, max for one of them");
  // What only touches zero is found at no look: |x| - 0, (x - 1)^2, sin(x) - 1. Conditions of conditions are 0 for a while.
  if (!when.compares_inside() && !has_both_signs)
    return refuse("is never on both sides of zero, so that it can touch it at most, which no look at a run finds: name what passes zero, as "
                  "`q1 + pi/2` for `abs(q1 + pi/2)`, or a bound that it passes, `abs(q1) < 0.1`");
  if (comparison && *comparison != Operation::equal && entry.direction != Crossing::either)
    return refuse("is a comparison, which says its direction itself: leave out `direction`");
  if (comparison == Operation::less) return Event::Test::below;
  if (comparison == Operation::less_equal) return Event::Test::at_or_below;
  if (comparison == Operation::greater) return Event::Test::above;
  if (comparison == Operation::greater_equal) return Event::Test::at_or_above;
  if (comparison == Operation::not_equal)
    return refuse("holds nearly always: name the instant with == or with the difference of the two sides");
  return entry.direction == Crossing::rising    ? Event::Test::at_or_above
         : entry.direction == Crossing::falling ? Event::Test::at_or_below
                                                : Event::Test::changes_side;
}

void add_event(EventSet& events, const Chain& chain, const EventEntry& entry) {
  const Expression when = Expression::parse(entry.when, events.probe.names(), entry.place);
  events.list.push_back({entry.title(), entry.kind, when.difference(), test_of(when, entry)});
  for (const int slot : when.used_variables()) {
    require_frame_of(chain, events.probe, slot, entry.place);
    events.needs_kinematics |= events.probe.is_kinematic(slot);
    events.needs_multipliers |= events.probe.is_multiplier(slot);
    if (events.foot) events.load.add(events.probe.names()[std::size_t(slot)], slot);
  }
}

}  // namespace

std::span<const Name> names_of(EventKind) {
  static constexpr Name names[] = {{"mark", "written into the audit and below the film"},
                                   {"stop", "and ends the run"},
                                   {"fall", "and counts as a fall"}};
  return names;
}

std::span<const Name> names_of(Crossing) {
  static constexpr Name names[] = {{"either", "whichever way"}, {"rising", "from below zero"}, {"falling", "from above"}};
  return names;
}

Parameters foot_parameters(const Foot& foot) {
  return {{"cop", 0.0}, {"grf", 0.0}, {"heel", foot.heel}, {"toe", foot.toe}};
}

bool bears(const GroundLoad& load, const Foot& foot) {
  return load.grf >= 0 && load.cop >= foot.heel && load.cop <= foot.toe;  // false without a number
}

bool presses_near(const GroundLoad& load, const Foot& foot) {
  constexpr double kFarthest = 3;  // lengths of the foot
  return load.grf > 0 && std::abs(load.cop - (foot.heel + foot.toe) / 2) < kFarthest * (foot.toe - foot.heel);
}

// As two forces at the ends of the foot: where one of them pulls and the other presses, no pull nearer to the middle is smaller. Where
// both pull, or press, they are as good as one between them.
FootHold hold_of(const GroundLoad& load, const Foot& foot, const GroundAxes& axes) {
  const double length = foot.toe - foot.heel;
  const double at_heel = (foot.toe * load.grf - load.moment) / length, at_toe = (load.moment - foot.heel * load.grf) / length;
  if (at_heel == 0 && at_toe == 0) return {(foot.heel + foot.toe) / 2, load.force, 0, 0};
  if (at_heel >= 0 && at_toe >= 0) return {load.cop, load.force, 0, 0};
  if (at_heel <= 0 && at_toe <= 0) return {load.cop, load.force - load.grf * axes.up, load.cop, -load.grf};
  const bool is_heel = at_heel < 0;
  const double pull = -std::min(at_heel, at_toe);
  return {is_heel ? foot.toe : foot.heel, load.force + pull * axes.up, is_heel ? foot.heel : foot.toe, pull};
}

void GroundSlots::add(const std::string& name, int slot) {
  if (name == "cop") cop = slot;
  if (name == "grf") grf = slot;
}

void GroundSlots::set(Probe& probe, const GroundLoad& load) const {
  if (cop >= 0) probe.set_value(cop, load.cop);
  if (grf >= 0) probe.set_value(grf, load.grf);
}

std::shared_ptr<const EventSet> make_events(const Chain& chain, const std::vector<EventEntry>& entries,
                                            const Parameters& parameters, const NamedFrames& frames,
                                            const std::optional<Foot>& foot, int rows) {
  if (entries.empty() && !foot) return nullptr;
  Parameters known = parameters;
  GroundAxes ground;
  if (foot) {
    if (rows > 0)
      throw Error(ExitCode::bad_input, "a foot goes without constraints: they would carry part of the robot");
    ground = ground_axes(chain);
    const Parameters of_foot = foot_parameters(*foot);
    known.insert(known.end(), of_foot.begin(), of_foot.end());
  }
  auto events =
      std::make_shared<EventSet>(EventSet{Probe(chain, known, rows, frames), {}, false, false, foot, ground, {}});
  ProblemList problems;
  for (const EventEntry& entry : entries) {
    try {
      add_event(*events, chain, entry);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  problems.throw_if_any();
  return events;
}

namespace {

constexpr double kNegligible = 1e-6;  // of a unit vector: far above round-off of the axes of a file

}  // namespace

GroundAxes ground_axes(const Chain& chain) {
  if (!chain.planar || chain.has_floating)
    throw Error(ExitCode::bad_input,
                "a foot needs a chain that moves in one plane on a fixed base; here " + chain.why_algebra);
  const Eigen::Vector3d& normal = chain.planar->plane.normal;
  const Eigen::Vector3d up = -(chain.gravity - chain.gravity.dot(normal) * normal);
  if (!(up.norm() > kNegligible * (1 + chain.gravity.norm())))
    throw Error(ExitCode::bad_input,
                "a foot needs gravity in the plane of the chain: nothing presses it down");
  GroundAxes axes;
  axes.up = up.normalized();
  axes.along = axes.up.cross(normal).normalized();
  const double rightward = std::abs(axes.along.x()) > kNegligible ? axes.along.x() : axes.along.y();
  if (rightward < 0) axes.along = -axes.along;
  return axes;
}

GroundLoad ground_load(const Chain& chain, Workspace& ws, const GroundAxes& axes, double height, ConstVec q,
                       ConstVec qd, ConstVec qdd, const Wrench& pushed) {
  const Wrench on_robot = compute_ground_reaction(chain, ws, q, qd, qdd);
  const Eigen::Vector3d force = on_robot.force - pushed.force;
  const double moment = axes.along.cross(axes.up).dot(on_robot.moment - pushed.moment);
  const double up = force.dot(axes.up), on_ground = moment + height * force.dot(axes.along);
  return {on_ground / up, up, force, on_ground};
}

GroundLoad ground_load(ChainSystem& system, Workspace& ws, const GroundAxes& axes, double height, double t, ConstVec q,
                       ConstVec qd, Vec qdd) {
  system.acceleration(t, q, qd, qdd);
  return ground_load(system.chain(), ws, axes, height, q, qd, qdd, system.pushed(t, q, qd));
}

namespace {

constexpr int kMostLooks = kLeastWatchedSteps * kLooksPerStep;  // at a step
constexpr std::size_t kUsualHits = 64;  // room for as many is made before the run
constexpr int kHastyTurns = 3;
constexpr double kStray = 0.3;          // of all that was seen of a value: a quarter is the most that a smooth one strays by where it turns round
constexpr double kNoRange = 1e-12;
constexpr double kTurning = 1e-6;       // of a value: its change, above rounding

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

EventWatch::EventWatch(const EventSet& events, ChainSystem& system, double duration)
    : events_(events),
      system_(system),
      longest_part_(duration / (kLeastWatchedSteps * kLooksPerStep)),
      ws_(system.chain()),
      probe_(events.probe),
      before_(events.list.size()),
      courses_(events.list.size()),
      now_(events.list.size()),
      q_(std::size_t(system.nq())),
      qd_(std::size_t(system.nv())),
      qdd_(std::size_t(system.nv())) {
  pending_.reserve(2 * events.list.size());
}

void EventWatch::set_probe(double t, ConstVec q, ConstVec qd) {
  const Chain& chain = system_.chain();
  probe_.set(chain, ws_, t, q, qd, events_.needs_kinematics);
  if (events_.needs_multipliers) {
    ConstrainedChain& constrained = *system_.constrained();
    constrained.look(system_.workspace(), q, qd, system_.applied_torque(t, q, qd));
    probe_.set_multipliers(constrained.lambda());
  }
  if (!events_.load.are_read()) return;
  events_.load.set(probe_, ground_load(system_, ws_, events_.ground, events_.foot->height, t, q, qd, qdd_));
}

bool EventWatch::read(double t, ConstVec q, ConstVec qd) {
  set_probe(t, q, qd);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    now_[i] = events_.list[i].value.evaluate(probe_.values());
    // Infinite at one instant it is a pole that a look fell on.
    if (std::isfinite(now_[i]) || (std::isinf(now_[i]) && std::isfinite(before_[i].value))) continue;
    bad_ = int(i);
    bad_at_ = t;
    return false;
  }
  return true;
}

bool EventWatch::start(double t, ConstVec q, ConstVec qd, EventHits& hits) {
  if (!read(t, q, qd)) return false;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const Event::Test test = events_.list[i].test;
    before_[i] = {now_[i], holds(test, now_[i]), sign_of(now_[i])};
    courses_[i] = {now_[i], now_[i]};
    if (before_[i].holds && test != Event::Test::changes_side) hits.from_start.push_back(int(i));
  }
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

// Whether the value changes its side by way of infinity and is never zero: near a pole it doubles at half the distance, near a zero it
// is half as large, beside a jump it stays as it is. `a`, `b`: the part of the step in which it changes.
bool EventWatch::is_pole(Integrator& integrator, std::size_t i, double t, double a, double b) {
  const Event& event = events_.list[i];
  if (event.test != Event::Test::changes_side) return false;
  constexpr double kNear = 1e-4;   // of the part
  constexpr double kGrows = 1.5;   // at half the distance
  const double d = std::max(kNear * (b - a), 100 * kInstantTolerance);
  const auto size = [&](double at) { return std::fabs(value_at(integrator, event, at)); };
  const auto grows = [&](double side) { return size(t + side * d) > kGrows * size(t + 2 * side * d); };
  const bool has_left = t - 2 * d >= integrator.begin_time(), has_right = t + 2 * d <= integrator.time();
  return (has_left || has_right) && (!has_left || grows(-1)) && (!has_right || grows(1));
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

void EventWatch::look_within(Integrator& integrator, std::size_t i, double a, double b) {
  if (!happens(events_.list[i], before_[i], now_[i])) return look_for_a_visit(integrator, i, a, b);
  const double when = locate(integrator, i, a, b);
  if (!is_pole(integrator, i, when, a, b)) pending_.push_back({int(i), when});
}

void EventWatch::look_for_a_visit(Integrator& integrator, std::size_t i, double a, double b) {
  const Event& event = events_.list[i];
  const State& before = before_[i];
  if (before.holds || (event.test == Event::Test::changes_side && before.side == 0)) return;
  const bool from_below = event.test == Event::Test::changes_side ? before.side < 0 : holds(event.test, 1.0);
  const auto distance = [&](double value) { return from_below ? -value : value; };  // from zero, not below it until it happens
  const double at_a = distance(before.value), at_b = distance(now_[i]);
  const double change = std::max(std::fabs(at_b - at_a), std::fabs(before.change));
  const auto at = [&](double t) { return distance(value_at(integrator, event, t)); };
  // What holds at zero already happens there.
  const double limit = event.test == Event::Test::at_or_above || event.test == Event::Test::at_or_below ? std::numeric_limits<double>::min() : 0;
  const std::optional<Look> there = visit_between({a, at_a}, {b, at_b}, change, limit, at);
  if (!there) return;
  const double nearest = there->t, value = from_below ? -there->value : there->value;
  const auto read = [&](double t) { return value_at(integrator, event, t); };
  pending_.push_back({int(i), first_instant({a, before.value}, {nearest, value}, read, [&](double y) { return happens(event, before, y); })});
  if (event.test != Event::Test::changes_side) return;
  const State beyond{value, false, sign_of(value)};
  pending_.push_back({int(i), first_instant({nearest, value}, {b, now_[i]}, read, [&](double y) { return happens(event, beyond, y); })});
}

// A value that turns round at look after look, about zero or near it, has more turns between them than can be told.
void EventWatch::look_for_haste(std::size_t i, double t, EventHits& hits) {
  State& before = before_[i];
  const double change = now_[i] - before.value, size = std::max(std::fabs(now_[i]), std::fabs(before.value));
  const bool turns = change * before.change < 0 && std::fabs(change) > kTurning * size && std::fabs(before.change) > kTurning * size &&
                     std::min(std::fabs(now_[i]), std::fabs(before.value)) < std::fabs(change);
  before.turns = turns ? before.turns + 1 : 0;
  if (before.turns == kHastyTurns) call_hasty(i, t, hits);
}

void EventWatch::call_hasty(std::size_t i, double t, EventHits& hits) {
  const auto known = [&](const EventHits::Hasty& one) { return one.event == int(i); };
  if (std::none_of(hits.hasty.begin(), hits.hasty.end(), known)) hits.hasty.push_back({int(i), t});
}

void EventWatch::probe_between(Integrator& integrator, double a, double b, EventHits& hits) {
  constexpr double kTurn = 0.6180339887498949;  // of a part: no two probes lie alike
  const double share = std::fmod(double(++probes_) * kTurn, 1.0), t = a + share * (b - a);
  integrator.interpolate(t, q_, qd_);
  set_probe(t, q_, qd_);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const double value = events_.list[i].value.evaluate(probe_.values());
    Course& course = courses_[i];
    if (!std::isfinite(value) || !std::isfinite(now_[i]) || !std::isfinite(before_[i].value)) continue;
    for (const double one : {now_[i], value}) course.low = std::min(course.low, one), course.high = std::max(course.high, one);
    const double range = course.high - course.low, off = std::fabs(value - before_[i].value - share * (now_[i] - before_[i].value));
    // A part whose ends differ by as much holds a jump that the looks see.
    const bool is_jump = std::fabs(now_[i] - before_[i].value) > kStray * range;
    const bool strays = !is_jump && off > kStray * range && range > kTurning * std::max(std::fabs(course.low), std::fabs(course.high)) && range > kNoRange;
    if (strays && ++course.strays == kHastyTurns) call_hasty(i, t, hits);
  }
}

bool EventWatch::check_step(Integrator& integrator, EventHits& hits) {
  const double begin = integrator.begin_time(), end = integrator.time();
  // Of steps that are longer than those of methods that choose them more.
  const double parts = longest_part_ > 0 ? std::ceil((end - begin) / longest_part_ * (1 - 1e-9)) : 0;
  const int looks = int(std::clamp(parts, double(kLooksPerStep), double(kMostLooks)));
  const auto instant = [&](int look) { return begin + (end - begin) * look / looks; };
  for (int look = 1; look <= looks; ++look) {
    const bool last = look == looks;
    const double t = last ? end : instant(look);
    if (!last) integrator.interpolate(t, q_, qd_);
    if (!(last ? read(t, integrator.q(), integrator.v()) : read(t, q_, qd_))) return false;
    pending_.clear();
    for (std::size_t i = 0; i < now_.size(); ++i) {
      look_within(integrator, i, instant(look - 1), t);
      look_for_haste(i, t, hits);
    }
    if (look % kLooksPerStep == 0) probe_between(integrator, instant(look - 1), t, hits);
    std::sort(pending_.begin(), pending_.end(),
              [](const Pending& x, const Pending& y) { return x.t != y.t ? x.t < y.t : x.event < y.event; });
    for (const Pending& hit : pending_) {
      record(integrator, hit, hits);
      ended_ = ends_the_run(events_.list[std::size_t(hit.event)].kind);
      if (ended_) return true;
    }
    for (std::size_t i = 0; i < now_.size(); ++i)
      before_[i] = {now_[i], holds(events_.list[i].test, now_[i]), sign_of(now_[i]), now_[i] - before_[i].value, before_[i].turns};
  }
  return true;
}

}  // namespace chainreel

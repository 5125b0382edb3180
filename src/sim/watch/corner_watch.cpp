#include "sim/watch/corner_watch.hpp"

#include <algorithm>
#include <cmath>

#include "sim/watch/dip.hpp"
#include "sim/watch/events.hpp"
#include "sim/watch/first_instant.hpp"

namespace chainreel {
namespace {

constexpr double kTouch = 1e-13;                           // of 1 + |g|: closer to zero than this is at zero
constexpr double kLeastSlack = 1e-12, kMostSlack = 1e-10;  // of a corner that starts at zero
constexpr double kAhead = 1e-5;                            // s: a look ahead where a rate says nothing
constexpr std::size_t kRush = 100;                         // changes of sides that are looked at together,
constexpr double kRushTime = 0.01;    // s, and within how short a time they come to no end
constexpr double kSameBend = 1e-6, kMostRest = 1e-6;  // accelerations that are the same; g that is as good as zero where they are
constexpr double kLeaving = 1e-6;     // of 1: a side that a crossing found there is beyond it
constexpr std::size_t kMostOpen = 5;  // corners at zero at once: 4^5 combinations
// How far behind an instant what jumps there is looked at: more than steps may end beside it.
constexpr double kBehind = 16 * kInstantTolerance, kBehindInUnits = 0x1p-46;  // s; of t
constexpr double kPole = 1e-3;  // a function is larger beside its pole
constexpr int kMostLooksAtDip = 48;
constexpr double kEnd =
    1e-3;  // of a look's part of the step: where it is looked at whether a margin rises at its end
// What may become of a corner at zero: it is held, the text decides as long as nothing drives it (so what
// stands still where the text says so stays there), or it goes to one side. Tried in this order.
constexpr int kHold = 0, kText = 2;
constexpr int kChoices[] = {kHold, kText, 1, -1};

}  // namespace

CornerWatch::CornerWatch(ChainSystem& system, double duration, bool straight)
    : system_(system),
      corners_(*system.corners()),
      ws_(system.chain()),
      straight_(straight),
      rush_(std::min(kRushTime, 1e-3 * duration)),
      watched_(std::size_t(corners_.count())),
      margins_(watched_.size()),
      g_(watched_.size()),
      g_ahead_(watched_.size()),
      last_g_(watched_.size()),
      touch_(watched_.size()),
      q_(std::size_t(system.nq())),
      qd_(std::size_t(system.nv())),
      ahead_q_(q_),
      ahead_qd_(qd_),
      looks_(watched_.size() * (kLooksPerStep + 1)),
      change_times_(kRush) {}

void CornerWatch::read(double t, ConstVec q, ConstVec qd) {
  if (is_holding()) system_.find_holding_sides(t, q, qd);
  corners_.values(system_.chain(), ws_, t, q, qd, g_);
  for (std::size_t k = 0; k < margins_.size(); ++k)
    margins_[k] = watched_[k].as_written ? kTouch * (1 + std::fabs(g_[k])) - std::fabs(g_[k])
                                         : corners_.side(int(k)) * g_[k];
  for (const int k : system_.held()) margins_[std::size_t(k)] = 1 - std::fabs(corners_.side(k));
  for (std::size_t k = 0; k < margins_.size(); ++k)
    if (watched_[k].is_free) margins_[k] = 1;
}

void CornerWatch::look(Integrator& integrator, double t) {
  if (!straight_) return integrator.interpolate(t, q_, qd_);
  const double s = (t - integrator.begin_time()) / (integrator.time() - integrator.begin_time());
  const ConstVec q1 = integrator.q(), qd1 = integrator.v();
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q0_[i] + s * (q1[i] - q0_[i]);
  for (std::size_t i = 0; i < qd_.size(); ++i) qd_[i] = qd0_[i] + s * (qd1[i] - qd0_[i]);
  system_.normalize(q_);
}

double CornerWatch::margin_at(Integrator& integrator, int k, double t) {
  look(integrator, t);
  read(t, q_, qd_);
  return margins_[std::size_t(k)];
}

std::optional<double> CornerWatch::crossing(Integrator& integrator, int k, double from, double to) {
  const double slack = watched_[std::size_t(k)].slack;
  const double a = margin_at(integrator, k, from), b = margin_at(integrator, k, to);
  if (b >= -slack) return {};
  if (a < -slack) return from;
  const double there = first_instant(
      {from, a + slack}, {to, b + slack}, [&](double t) { return margin_at(integrator, k, t) + slack; },
      [](double margin) { return margin < 0; });
  crossed_pole_ = !(std::fabs(margin_at(integrator, k, there)) <= std::max(a, -b) + slack);
  return there;
}

std::optional<double> CornerWatch::crossing_at_dip(Integrator& integrator, int k, double from, double to) {
  const auto there = below_in_dip(from, to, -watched_[std::size_t(k)].slack, kMostLooksAtDip, [&](double t) { return margin_at(integrator, k, t); });
  return there ? crossing(integrator, k, from, there->t) : std::nullopt;
}

// Dips in the first and the last part of the step: between looks that only rise there, or only fall.
std::optional<double> CornerWatch::crossing_at_ends(Integrator& integrator, int k) {
  const double begin = integrator.begin_time(), end = integrator.time();
  const double part = (end - begin) / kLooksPerStep;
  const auto at = [&](int look) { return looks_[std::size_t(look) * watched_.size() + std::size_t(k)]; };
  const double rise = at(1) - at(0), fall = at(kLooksPerStep - 1) - at(kLooksPerStep);
  std::optional<double> found;
  if (rise > std::fabs(at(0)) && margin_at(integrator, k, begin + kEnd * part) < at(0))
    found = crossing_at_dip(integrator, k, begin, begin + part);
  if (!found && fall > std::fabs(at(kLooksPerStep)) &&
      margin_at(integrator, k, end - kEnd * part) < at(kLooksPerStep))
    found = crossing_at_dip(integrator, k, end - part, end);
  return found;
}

std::optional<double> CornerWatch::first_crossing(Integrator& integrator, ConstVec q0, ConstVec qd0) {
  q0_ = q0;
  qd0_ = qd0;
  const double begin = integrator.begin_time(), end = integrator.time();
  const std::size_t n = watched_.size();
  const auto instant = [&](int look) {
    return look == kLooksPerStep ? end : begin + (end - begin) * look / kLooksPerStep;
  };
  std::optional<double> first;
  const auto take = [&](std::size_t k, std::optional<double> t) {
    if (!t || (first && *first <= *t)) return;
    first = t;
    crossed_ = int(k);
  };
  for (int look = 0; look <= kLooksPerStep && !first; ++look) {
    this->look(integrator, instant(look));
    read(instant(look), q_, qd_);
    std::copy(margins_.begin(), margins_.end(), looks_.begin() + std::ptrdiff_t(std::size_t(look) * n));
    if (look == 0) continue;
    for (std::size_t k = 0; k < n; ++k) {
      const double now = looks_[std::size_t(look) * n + k], before = looks_[std::size_t(look - 1) * n + k];
      if (now < -watched_[k].slack) {
        take(k, crossing(integrator, int(k), instant(look - 1), instant(look)));
        continue;
      }
      if (now > watched_[k].slack) watched_[k].slack = 0;
      if (look < 2) continue;
      // A dip between two looks: where the parabola through three of them has its lowest point.
      const double earlier = looks_[std::size_t(look - 2) * n + k], bend = earlier - 2 * before + now;
      if (!(before < earlier && before <= now && bend > 0)) continue;
      const double lowest = std::clamp(0.5 * (earlier - now) / bend, -1.0, 1.0);
      std::optional<double> dip;
      if (!(before - 0.125 * (earlier - now) * (earlier - now) / bend > 0.5 * before))
        dip = crossing(integrator, int(k), instant(look - 2),
                       instant(look - 1) + lowest * (end - begin) / kLooksPerStep);
      if (!dip && before < std::max(earlier, now) - before)
        dip = crossing_at_dip(integrator, int(k), instant(look - 2), instant(look));
      take(k, dip);
    }
  }
  if (!first)
    for (std::size_t k = 0; k < n; ++k) take(k, crossing_at_ends(integrator, int(k)));
  if (first) culprit_ = crossed_;
  return first;
}

double CornerWatch::off_by(double t, ConstVec q, ConstVec qd) {
  const auto k = std::size_t(crossed_);
  // The side of a corner that is held is known by dense output alone.
  if (watched_[k].as_written || std::fabs(corners_.side(crossed_)) != 1) return 0;
  corners_.values(system_.chain(), ws_, t, q, qd, g_);
  // At a pole it is the reciprocal that crosses zero.
  const double off = (crossed_pole_ ? g_[k] : -g_[k]) / system_.corner_rates(t, q, qd)[k];
  return std::isfinite(off) ? off : 0;
}

// The switching functions at the sides that stand, after dt along the last acceleration, into g_ahead_.
void CornerWatch::look_ahead(double t, ConstVec q, ConstVec qd, double dt) {
  const ConstVec qdd = system_.last_acceleration();
  for (std::size_t i = 0; i < qd.size(); ++i) ahead_qd_[i] = qd[i] + 0.5 * dt * qdd[i];
  std::copy(q.begin(), q.end(), ahead_q_.begin());
  system_.advance(ahead_q_, ahead_qd_, dt);
  for (std::size_t i = 0; i < qd.size(); ++i) ahead_qd_[i] = qd[i] + dt * qdd[i];
  corners_.values(system_.chain(), ws_, t + dt, ahead_q_, ahead_qd_, g_ahead_);
}

// Which way the switching function goes from here, at the sides that stand: its rate, or, where that is zero,
// a look ahead along the acceleration.
int CornerWatch::direction(int k, double t, ConstVec q, ConstVec qd) {
  const ConstVec rates = system_.corner_rates(t, q, qd);
  const double rate = rates[std::size_t(k)];
  if (std::isfinite(rate) && std::fabs(rate) > 1e-9) return rate > 0 ? 1 : -1;
  corners_.values(system_.chain(), ws_, t, q, qd, g_);
  look_ahead(t, q, qd, kAhead);
  const double change = g_ahead_[std::size_t(k)] - g_[std::size_t(k)];
  return change > 1e-15 ? 1 : change < -1e-15 ? -1 : 0;
}

// Whether the motion at this choice for the open corners stays on them.
bool CornerWatch::is_consistent(const std::vector<int>& open, const std::vector<int>& choice, double t,
                                ConstVec q, ConstVec qd) {
  std::vector<int> held;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (choice[i] == kHold)
      held.push_back(open[i]);
    else
      corners_.set_side(open[i], choice[i] == kText ? kAsWritten : choice[i]);
  }
  system_.hold(held);
  let_followers_follow(held);
  if (!held.empty()) {
    if (!system_.find_holding_sides(t, q, qd)) return false;
    for (const int k : held) {
      const double side = corners_.side(k);
      if (std::fabs(side) > 1) return false;
      // Both branches must lead to it.
      corners_.set_side(k, side + 1);
      const double above = system_.corner_rates(t, q, qd)[std::size_t(k)];
      corners_.set_side(k, side);
      if (!(above < 0)) return false;
    }
  }
  for (std::size_t i = 0; i < open.size(); ++i)
    if (choice[i] != kHold && !agrees(open[i], choice[i], open, t, q, qd)) return false;
  return true;
}

// Whether a corner at zero that is not held goes where it was chosen to, at the sides that stand.
bool CornerWatch::agrees(int k, int choice, const std::vector<int>& open, double t, ConstVec q, ConstVec qd) {
  if (reads_any(k, system_.held())) return choice == kText;
  if (reads_any(k, open)) {  // it may stand elsewhere now
    corners_.values(system_.chain(), ws_, t, q, qd, g_);
    const double g = g_[std::size_t(k)];
    if (std::fabs(g) > touch_[std::size_t(k)]) return choice == (g > 0 ? 1 : -1);
  }
  return direction(k, t, q, qd) == (choice == kText ? 0 : choice);
}

bool CornerWatch::reads_any(int k, const std::vector<int>& others) const {
  return std::any_of(others.begin(), others.end(), [&](int other) { return corners_.reads(k, other); });
}

// At the sides that are chosen for corners at zero, those that read them stand where they do just behind, on
// the way that led here.
void CornerWatch::let_followers_follow(const std::vector<int>& held) {
  for (const int k : followers_) corners_.set_side(k, kAsWritten);
  for (const int k : followers_) {
    Watched& one = watched_[std::size_t(k)];
    one.is_free = reads_any(k, held);
    if (one.is_free) continue;
    corners_.values(system_.chain(), ws_, t_behind_, q_behind_, qd_behind_, g_ahead_);
    const double g = g_ahead_[std::size_t(k)];
    one.as_written = !(g > 0 || g < 0);
    if (!one.as_written) corners_.set_side(k, g > 0 ? 1 : -1);
  }
}

bool CornerWatch::choose_sides(const std::vector<int>& open, double t, ConstVec q, ConstVec qd) {
  if (open.empty()) {
    let_followers_follow({});
    return true;
  }
  if (open.size() > kMostOpen) return false;
  std::vector<int> choice(open.size());
  int combinations = 1;
  for (std::size_t i = 0; i < open.size(); ++i) combinations *= 4;
  for (int number = 0; number < combinations; ++number) {
    int rest = number;
    for (int& one : choice) {
      one = kChoices[rest % 4];
      rest /= 4;
    }
    if (!is_consistent(open, choice, t, q, qd)) continue;
    for (std::size_t i = 0; i < open.size(); ++i) {
      Watched& one = watched_[std::size_t(open[i])];
      one.is_free = choice[i] == kText && reads_any(open[i], system_.held());
      one.as_written = choice[i] == kText && !one.is_free;
    }
    return true;
  }
  follow_text(open, t, q, qd);
  return true;
}

// Where no choice agrees with the motion that it makes, each corner goes where the text leads it.
void CornerWatch::follow_text(const std::vector<int>& open, double t, ConstVec q, ConstVec qd) {
  system_.hold({});
  for (const int k : open) corners_.set_side(k, kAsWritten);
  for (const int k : followers_) corners_.set_side(k, kAsWritten);
  for (const int k : open) {
    const int way = direction(k, t, q, qd);
    watched_[std::size_t(k)].as_written = way == 0;
    if (way != 0) corners_.set_side(k, way);
  }
  let_followers_follow({});
}

// Those that are held, that stand at zero, or that have just left their side.
std::vector<int> CornerWatch::near_ones(double t, ConstVec q, ConstVec qd) {
  std::vector<int> open = system_.held();
  left_.clear();
  if (!open.empty() && system_.find_holding_sides(t, q, qd)) {
    const auto is_left = [&](int k) { return std::fabs(std::fabs(corners_.side(k)) - 1) < kLeaving; };
    std::copy_if(open.begin(), open.end(), std::back_inserter(left_), is_left);
  }
  return open;
}

// Which corners are at zero here, added to those that are held in `open`; which follow them; the others have
// the side on which they are.
void CornerWatch::sort_corners(std::vector<int>& open, double t, ConstVec q, ConstVec qd) {
  for (Watched& one : watched_) one.as_written = one.is_free = false;
  followers_.clear();
  corners_.values(system_.chain(), ws_, t, q, qd, last_g_);
  // At sides from which no rate is told, the text's own branch is.
  system_.hold({});
  const ConstVec now = system_.corner_rates(t, q, qd);
  const std::vector<double> rates(now.begin(), now.end());
  const double behind = kBehind + kBehindInUnits * t;
  look_ahead(t, q, qd, behind);
  t_behind_ = t + behind;
  q_behind_ = ahead_q_;
  qd_behind_ = ahead_qd_;
  // What cannot be held any longer goes where its side has gone.
  for (const int k : left_) {
    corners_.set_side(k, corners_.side(k) > 0 ? 1 : -1);
    std::erase(open, k);
  }
  const std::vector<int> held = open;
  std::vector<int> moved = left_;
  const auto is_in = [](const std::vector<int>& list, int k) {
    return std::find(list.begin(), list.end(), k) != list.end();
  };
  for (int k = 0; k < corners_.count(); ++k) {
    const auto i = std::size_t(k);
    const double rate = std::isfinite(rates[i]) ? rates[i] : 0;
    const double g = last_g_[i];
    touch_[i] = std::max(kTouch * (1 + std::fabs(g)) + 4 * kInstantTolerance * std::fabs(rate),
                         2 * std::max(watched_[i].slack, watched_[i].rest));
    if (is_in(held, k) || is_in(left_, k)) continue;
    watched_[i].slack = watched_[i].rest;
    // At a pole rates are large, and lead nowhere near where it is next.
    const double next = g + rate * behind;
    const double most = 0.5 * (std::fabs(g) + std::fabs(rate) * behind);
    const bool at_pole =
        !std::isfinite(g) || (std::fabs(g) > kPole && !(std::fabs(g_ahead_[i] - next) <= most));
    if (!at_pole && std::fabs(g) <= touch_[i]) {
      open.push_back(k);
    } else if (reads_any(k, open) || reads_any(k, moved)) {
      followers_.push_back(k);
      moved.push_back(k);
    } else {
      const double side = (at_pole ? g_ahead_[i] : g) > 0 ? 1 : -1;
      if (side != corners_.side(k)) moved.push_back(k);
      corners_.set_side(k, side);
    }
  }
}

bool CornerWatch::settle(double t, ConstVec q, ConstVec qd) {
  std::vector<double> sides(watched_.size());
  for (std::size_t k = 0; k < sides.size(); ++k) sides[k] = corners_.side(int(k));
  const std::vector<int> was_held = system_.held();
  std::vector<int> open = near_ones(t, q, qd);
  sort_corners(open, t, q, qd);
  const bool settled = choose_sides(open, t, q, qd);
  system_.forget_bad_torque();  // of sides that were only tried
  if (!settled) {
    culprit_ = open.front();
    return false;
  }
  const auto give_slack = [&](int k) {
    watched_[std::size_t(k)].slack =
        std::max(std::clamp(4 * std::fabs(last_g_[std::size_t(k)]), kLeastSlack, kMostSlack), watched_[std::size_t(k)].rest);
  };
  for (const int k : open) give_slack(k);
  for (const int k : left_) give_slack(k);
  // Followers only follow; NaN is the text's side before and after.
  const auto has_changed = [&](int k, double before) {
    const double side = corners_.side(k);
    const bool same = side == before || (std::isnan(side) && std::isnan(before));
    return !same && std::find(followers_.begin(), followers_.end(), k) == followers_.end();
  };
  std::vector<int> changed;
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (started_ && has_changed(int(k), sides[k]) &&
        !(std::count(was_held.begin(), was_held.end(), int(k)) &&
          std::count(system_.held().begin(), system_.held().end(), int(k))))
      changed.push_back(int(k));
  started_ = true;
  return !jumps_without_end(t, q, qd, changed);
}

bool CornerWatch::changed_before(double t) const {
  return changes_ > 0 && t - change_times_[(changes_ - 1) % kRush] <= 1e-3 * rush_;
}

// Whether the accelerations are the same on both sides here, but for what bends by so little as g is off zero.
bool CornerWatch::bends_only(int k, double t, ConstVec q, ConstVec qd) {
  const double side = corners_.side(k);
  std::vector<double> both[2] = {std::vector<double>(qd.size()), std::vector<double>(qd.size())};
  for (const int way : {0, 1}) {
    corners_.set_side(k, way == 0 ? 1 : -1);
    system_.acceleration(t, q, qd, both[way]);
  }
  corners_.set_side(k, side);
  system_.forget_bad_torque();
  for (std::size_t i = 0; i < qd.size(); ++i)
    if (!(std::fabs(both[0][i] - both[1][i]) <= kSameBend * (1 + std::fabs(both[0][i])))) return false;
  return true;
}

bool CornerWatch::rests_at_bends(double t, ConstVec q, ConstVec qd) {
  bool any = false;
  corners_.values(system_.chain(), ws_, t, q, qd, last_g_);
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    Watched& one = watched_[k];
    const double g = std::fabs(last_g_[k]);
    if (!(g <= kMostRest) || one.rest >= kMostRest || !bends_only(int(k), t, q, qd)) continue;
    one.rest = std::clamp(10 * std::max(one.rest, g), kMostSlack, kMostRest);
    one.slack = std::max(one.slack, one.rest);
    any = true;
  }
  return any;
}

bool CornerWatch::jumps_without_end(double t, ConstVec q, ConstVec qd, const std::vector<int>& changed) {
  for (const int k : changed) {
    const std::size_t slot = changes_++ % kRush;
    const double earlier = change_times_[slot];
    change_times_[slot] = t;
    culprit_ = k;
    if (!(changes_ > kRush && t - earlier < rush_)) continue;
    if (!rests_at_bends(t, q, qd)) return true;
    changes_ = 0;
  }
  return false;
}

}  // namespace chainreel

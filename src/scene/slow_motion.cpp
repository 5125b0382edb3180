#include "scene/slow_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/format.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kLongestBrief = 6;  // s: longer motions are seen without; asked for 8 s, a film of 10 s is a surprise
constexpr double kAdded = 2;         // s, up to the motion's own length
constexpr double kAround = 0.2;             // s of the motion
constexpr double kAroundOfMotion = 0.1;     // at most: short motions have short events
constexpr double kEase = 0.5, kApart = 2;   // of `around`
constexpr double kLeastOfFast = 0.5;        // of all that is fast, where any of it is shown slowly
constexpr int kHalvings = 50;               // of the end of what is cut

// What is found, widened by what is shown around it.
struct Window : Haste {
  Window(const Haste& haste, double around) : Haste(haste) {
    from -= around;
    until += around;
  }
};

// Both as one, its events in the order of time.
Window together(const Window& a, const Window& b) {
  if (b.from < a.from) return together(b, a);
  Window all = a;
  all.until = std::max(a.until, b.until);
  all.is_turn = a.is_turn || b.is_turn;
  for (const std::string& event : b.events)
    if (std::find(all.events.begin(), all.events.end(), event) == all.events.end()) all.events.push_back(event);
  return all;
}

std::string cause_of(const Window& window, double turn) {
  std::vector<std::string> causes;
  for (const std::string& event : window.events) causes.push_back("'" + event + "'");
  if (window.is_turn) causes.push_back("a link turns more than " + format_significant(turn * 180 / std::numbers::pi, 3) + " degrees a frame");
  return joined(causes);
}

// Windows that are apart from one another, in the order of time.
class Windows {
 public:
  Windows(const SlowMotionRule& rule, double end, double around) : rule_(rule), end_(end), around_(around) {}

  void add(Window one) {
    std::vector<Window> apart;
    for (const Window& other : list_) {
      if (other.from < one.until + kApart * around_ && one.from < other.until + kApart * around_)
        one = together(one, other);
      else
        apart.push_back(other);
    }
    apart.push_back(std::move(one));
    std::sort(apart.begin(), apart.end(), [](const Window& a, const Window& b) { return a.from < b.from; });
    list_ = std::move(apart);
  }

  bool add_where_it_fits(const Window& one) {
    Windows with = *this;
    with.add(one);
    if (!(FilmClock(end_, {}, with.stretches()).film_seconds() <= longest_film(end_, rule_.is_asked))) return false;
    list_ = std::move(with.list_);
    return true;
  }

  const std::vector<Window>& list() const { return list_; }
  // s of the motion that lie in both.
  double shared_with(const Windows& others) const {
    double sum = 0;
    for (const Window& one : list_)
      for (const Window& other : others.list_) sum += std::max(0.0, std::min({one.until, other.until, end_}) - std::max({one.from, other.from, 0.0}));
    return sum;
  }

  std::vector<Stretch> stretches() const {
    std::vector<Stretch> all;
    // Behind the end the film is no faster again, also where an event ended the motion.
    for (const Window& one : list_)
      all.push_back({std::max(0.0, one.from), one.until < end_ ? one.until : std::numeric_limits<double>::infinity(), rule_.speed,
                     kEase * around_, cause_of(one, rule_.turn)});
    return all;
  }

 private:
  const SlowMotionRule& rule_;
  double end_, around_;
  std::vector<Window> list_;
};

// As much of a window from its beginning as there is room for; nothing where that is too short to be seen.
void add_beginning(Windows& windows, const Window& whole, double around) {
  Window cut = whole;
  double fits = whole.from, over = whole.until;
  for (int i = 0; i < kHalvings; ++i) {
    cut.until = (fits + over) / 2;
    Windows tried = windows;
    (tried.add_where_it_fits(cut) ? fits : over) = cut.until;
  }
  cut.until = fits;
  if (cut.until - cut.from >= 2 * around) windows.add_where_it_fits(cut);
}

}  // namespace

double longest_film(double motion, bool is_asked) {
  if (is_asked) return 2 * motion;
  return motion > kLongestBrief ? motion : motion + std::min(kAdded, motion);
}

bool may_be_hasty(const Scene& scene, const Chain& chain) {
  const auto turns = [](const Body& body) { return body.joint.kind != JointKind::prismatic; };
  return !scene.events.empty() || !scene.push.empty() || !scene.constraints.empty() || scene.limit == LimitPolicy::stop || std::any_of(chain.bodies.begin() + 1, chain.bodies.end(), turns);
}

std::vector<Haste> fast_turns(const Chain& chain, const Trajectory& run, double turn, FrameRate fps) {
  std::vector<Haste> all;
  if (!is_complete(run.status)) return all;
  Workspace ws(chain);
  int last = -2;
  for (int k = 0; k < run.size(); ++k) {
    compute_kinematics(chain, ws, run.q_at(k), run.qd_at(k));
    double rate = 0;
    for (const Eigen::Vector3d& w : ws.w_WB) rate = std::max(rate, w.norm());
    if (!(rate / fps.value() > turn)) continue;
    const double t = run.t[std::size_t(k)];
    if (k != last + 1) all.push_back({t, t, true, {}});
    last = k;
    all.back().until = t;
  }
  return all;
}

std::vector<Haste> notable_instants(const Scene& scene, const Trajectory& run, const std::vector<double>& change_points) {
  constexpr double kBriefPush = 0.5;  // s: longer ones are seen as they are
  std::vector<Haste> all;
  if (!is_complete(run.status)) return all;
  std::set<int> seen;
  for (int k = 0; k < run.events.size(); ++k) {
    const int event = run.events.event[std::size_t(k)];
    const double t = run.events.t[std::size_t(k)];
    if (seen.insert(event).second) all.push_back({t, t, false, {scene.events[std::size_t(event)].title()}});
  }
  if (!change_points.empty()) all.push_back({change_points.front(), change_points.front(), false, {"constraints lose rank"}});
  if (run.status == RunStatus::stopped && run.ending_event < 0 && !run.limits.empty())
    all.push_back({run.end_time, run.end_time, false, {"limit of " + run.limits.back().joint}});
  for (const PushEntry& push : scene.push)
    if (push.until - push.from < kBriefPush && push.from < run.end_time) all.push_back({push.from, std::min(push.until, run.end_time), false, {"push"}});
  return all;
}

std::vector<Stretch> stretches_by(const SlowMotionRule& rule, double end, const std::vector<Haste>& events,
                                  const std::vector<Haste>& turns) {
  const double around = rule.around.value_or(std::min(kAround, kAroundOfMotion * end));
  const auto by_time = [](std::vector<Haste> list) {
    std::stable_sort(list.begin(), list.end(), [](const Haste& a, const Haste& b) { return a.from < b.from; });
    return list;
  };
  Windows windows(rule, end, around);
  std::vector<Haste> in_turn = by_time(events);
  std::stable_partition(in_turn.begin(), in_turn.end(), [&](const Haste& one) { return one.until >= end; });
  for (const Haste& one : in_turn) windows.add_where_it_fits({one, around});
  Windows fast(rule, end, around);
  for (const Haste& one : turns) fast.add({one, around});
  // A crank that turns as fast all along, from the start on, would be seen to speed up where the room ends: rather all of it at its own speed.
  const Windows without = windows;
  for (const Window& one : fast.list())
    if (!windows.add_where_it_fits(one)) {
      add_beginning(windows, one, around);
      break;
    }
  const bool begins_fast = !fast.list().empty() && std::ranges::any_of(turns, [](const Haste& one) { return one.from <= 0; });
  return (begins_fast && windows.shared_with(fast) < kLeastOfFast * fast.shared_with(fast) ? without : windows).stretches();
}

}  // namespace chainreel

#include "draw/page/panel.hpp"

#include <algorithm>
#include <cmath>

#include "draw/page/sheet.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {

void TipPath::reserve(std::size_t frames) {
  t_.reserve(frames);
  place_.reserve(frames);
  speed_.reserve(frames);
  gap_.reserve(frames);
}

void TipPath::add(double t, Point place, Point speed) {
  const bool gap = !(is_drawable(place) && std::isfinite(speed.x) &&
                     std::isfinite(speed.y));
  t_.push_back(t);
  place_.push_back(gap ? Point{} : place);
  speed_.push_back(gap ? Point{} : speed);
  gap_.push_back(gap);
}

Point TipPath::at(double t, int frame) const {
  if (t >= t_.back()) return place_.back();
  const std::size_t i = std::size_t(frame);
  const double h = t_[i + 1] - t_[i];
  if (!(h > 0)) return place_[i];  // a pause
  const double s = (t - t_[i]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * place_[i] + ((s3 - 2 * s2 + s) * h) * speed_[i] +
         (3 * s2 - 2 * s3) * place_[i + 1] + ((s3 - s2) * h) * speed_[i + 1];
}

int TipPath::frame_at(double t) const {
  return std::max(0, int(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()) - 1);
}

int TipPath::pieces(int k, double length, int most) const {
  const std::size_t i = std::size_t(k);
  // A turn between two frames shows in the speeds, not in the distance.
  const double way = std::max(norm(place_[i + 1] - place_[i]),
                              std::max(norm(speed_[i]), norm(speed_[i + 1])) * (t_[i + 1] - t_[i]));
  return int(std::clamp(std::ceil(way / length), 1.0, double(most)));
}

double TipPath::gapless_since(int k, double t) const {
  for (int i = k; i >= 0; --i) {
    if (i < k && t_[std::size_t(i) + 1] - t_[std::size_t(i)] > kLongestTrailStep + 1e-9) return t_[std::size_t(i) + 1];
    if (gap_[std::size_t(i)]) return i == k ? t_[std::size_t(k)] : t_[std::size_t(i) + 1];
    if (t_[std::size_t(i)] <= t) return t;
  }
  return t_.front();
}

Panel::Panel(const StagedRun& motion, const PanelView& view, const Theme& theme)
    : motion_(&motion),
      view_(view),
      skeleton_(motion.skeleton()),
      look_(look_of(skeleton_, view_.camera, theme, 1, view_.marks)),
      last_(motion.samples() - 1) {
  if (motion.may_freeze()) {
    find_last_inside();
    motion.let_rails_reach(skeleton_, last_ + 1);
  }
  follow_tip();
}

void Panel::let_rails_reach(const std::vector<Rail>& others) {
  for (Rail& rail : skeleton_.rails)
    for (const Rail& its : others) {
      if (its.body != rail.body || !its.used || !rail.used) continue;
      rail.lower = std::min(rail.lower, its.lower);
      rail.upper = std::max(rail.upper, its.upper);
    }
}

ChainDrawing Panel::drawing(const ChainLook& look) const {
  return {chain(), skeleton_, view_.camera, look, motion_->shapes()};
}

bool Panel::is_inside(const Workspace& ws) const {
  const double edge = look_.marks * kLargestMark;
  const auto holds = [&](const Eigen::Vector3d& place) {
    const Point p = camera().project(place);
    // False for NaN, too.
    return p.x - edge >= area().x0 && p.x + edge <= area().x1 && p.y - edge >= area().y0 &&
           p.y + edge <= area().y1;
  };
  for (int b = 1; b < int(chain().bodies.size()); ++b) {
    if (!holds(pose_of(ws, b).translation())) return false;
  }
  for (const LinkSegment& link : skeleton_.links) {
    if (!holds(pose_of(ws, link.body) * link.from) || !holds(pose_of(ws, link.body) * link.to)) return false;
  }
  return chain().end_effector < 0 || holds(tip_position(chain(), ws));
}

void Panel::find_last_inside() {
  for (int k = 0; k < motion_->samples(); ++k) {
    if (is_inside(motion_->pose_at(k))) continue;
    left_ = true;
    last_ = std::max(0, k - 1);
    return;
  }
}

void Panel::follow_tip() {
  const bool is_center = is_followed_by_center(chain());
  if (chain().end_effector < 0 && !is_center) return;
  tip_.reserve(std::size_t(last_) + 1);
  for (int k = 0; k <= last_; ++k) {
    const Workspace& ws = motion_->pose_at(k);
    const Eigen::Vector3d tip = is_center ? center_of_mass(chain(), ws) : tip_position(chain(), ws);
    const Eigen::Vector3d speed = is_center ? center_velocity(chain(), ws) : frame_velocity(chain(), ws, chain().end_effector);
    tip_.add(motion_->trajectory().t[std::size_t(k)], camera().project(tip), camera().project_vector(speed, tip));
  }
}

std::optional<double> Panel::left_at() const {
  if (!motion_->may_freeze()) return std::nullopt;
  const Trajectory& run = motion_->trajectory();
  if (!left_) return run.end_time;
  return run.t[std::size_t(std::min(last_ + 1, motion_->samples() - 1))];
}

// The last events up to this frame, as many as a line holds.
std::string Panel::event_note(int k, int events) const {
  const Trajectory& run = motion_->trajectory();
  const double now = k < run.size() ? run.t[std::size_t(k)] : HUGE_VAL;
  struct Happening {
    double t;
    std::string what;
  };
  std::vector<Happening> so_far;
  const auto behind = std::size_t(std::ranges::upper_bound(run.events.t, now) - run.events.t.begin());
  for (std::size_t i = behind - std::min(behind, std::size_t(std::max(events, 1))); i < behind; ++i)
    so_far.push_back({run.events.t[i], scene().events[std::size_t(run.events.event[i])].title()});
  // Of poses that come again and again the last one is enough.
  const std::vector<double>& lost = motion_->change_points();
  if (const auto next = std::ranges::upper_bound(lost, now); next != lost.begin()) so_far.push_back({next[-1], kRankLost});
  if (const std::optional<LimitEvent> limit = motion_->stopping_limit(); limit && run.end_time <= now + 1e-9) so_far.push_back({run.end_time, words_of_stop(*limit)});
  std::ranges::stable_sort(so_far, {}, &Happening::t);
  if (events == 0) return so_far.empty() ? "" : so_far.back().what;
  std::string text;
  for (std::size_t i = so_far.size() - std::min(so_far.size(), std::size_t(events)); i < so_far.size(); ++i)
    text += (text.empty() ? "" : kBetweenEvents) + time_text(so_far[i].t) + ": " + so_far[i].what;
  return text;
}

std::string Panel::note(int k, int events) const {
  const std::optional<double> left = left_at();
  if (!left || k <= last_) return event_note(k, events);
  const bool diverged = motion_->trajectory().status == RunStatus::diverged, gone = left_ || diverged;
  // A chain on a pin grows wild in its place.
  const std::string text = (left_ ? kLeftThePicture : diverged ? "diverged at " : "ended at ") + time_text(*left);
  return gone && events > 0 ? text + away_note() : text;
}

Eigen::Vector3d Panel::farthest_place(const Workspace& ws) const {
  Eigen::Vector3d far = chain().end_effector < 0 ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : tip_position(chain(), ws);
  for (int b = 1; b < int(chain().bodies.size()); ++b)
    if (const Eigen::Vector3d& place = pose_of(ws, b).translation(); !(place.norm() <= far.norm())) far = place;  // so of what is no number, too
  return far;
}

Point Panel::far_point(int k) const {
  return camera().project(farthest_place(motion_->pose_at(std::min(k, motion_->samples() - 1))));
}

// How far off it comes to be, where that is far beyond the picture: ", up to 3\u00D710\u2075 m away". It is the number that plots tell, which
// see it between frames, and the same from the instant on at which it left: on its way from one side to the other it passes near.
std::string Panel::away_note() const {
  constexpr double kFar = 10;  // times the picture's height
  if (!farthest_) {
    farthest_ = 0;
    for (int i = 0; i < motion_->curve_samples(); ++i)
      if (const double there = farthest_place(motion_->curve_pose_at(i)).norm(); !(there <= *farthest_)) farthest_ = there;  // so what is no number, too
  }
  const double height = area().height() / camera().scale;
  return std::isfinite(*farthest_) && *farthest_ > kFar * height ? kBeforeAway + format_power(*farthest_) + " m away" : "";
}

}  // namespace chainreel

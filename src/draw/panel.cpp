#include "draw/panel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/chain.hpp"
#include "draw/chain_fit.hpp"
#include "draw/joints.hpp"
#include "draw/sheet.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kWild =
    100;  // lengths of the chain: beyond, a run that did not finish is left out of the fit
constexpr double kLargestMark = size::kCarriageLength / 2;  // around a place of the chain, half of its size
constexpr int kScaleSamples = 200;                          // of a clip decide on the scale of its ellipses

}  // namespace

Layers layers_of(const Scene& scene) {
  const auto named = [&](const char* name) {
    return std::find(scene.draw.begin(), scene.draw.end(), name) != scene.draw.end();
  };
  return {named("chain"),        named("trail"),   named("time"),      named("title"),
          named("torque_label"), named("ellipse"), named("scale_bar"), named("legend")};
}

Panel::Panel(const PanelRun& run, const Layers& layers, int samples, WildEnd wild_end)
    : run_(run),
      layers_(layers),
      theme_(light_theme()),
      wild_end_(wild_end),
      wild_(!is_complete(run.trajectory.status)),
      samples_(samples),
      last_(samples - 1),
      skeleton_(skeleton_of(run.chain)),
      ws_(std::make_unique<Workspace>(run.chain)) {
  // A run that finished is drawn wherever it went: a free fall may be long.
  limit_ = run.trajectory.status == RunStatus::finished ? std::numeric_limits<double>::max()
                                                        : kWild * skeleton_.reach;
}

void Panel::pose_at(int k) const {
  compute_kinematics(run_.chain, *ws_, run_.trajectory.q_at(k), run_.trajectory.qd_at(k));
}

std::vector<double> Panel::smaller_masses() const {
  std::vector<double> smaller;
  const int count = std::min(samples_, kScaleSamples);
  for (int i = 0; i < count; ++i) {
    const int k = int(std::int64_t(i) * samples_ / count);
    const auto mass = smallest_mass(mass_axes(
        effective_mass_of(run_.chain, *ws_, run_.trajectory.q_at(k), run_.chain.end_effector, Task::linear)));
    if (mass) smaller.push_back(*mass);
  }
  return smaller;
}

void Panel::find_rails(int samples) {
  for (int k = 0; k < samples; ++k) widen_rails(skeleton_, run_.chain, run_.trajectory.q_at(k), limit_);
}

FitBox Panel::fit_box(const Camera& view, double marks, bool with_wild) {
  // Where a run begins is in the picture however it ends.
  const int counted = wild_ && !with_wild ? 1 : samples_;
  find_rails(counted);
  ChainFit fit(run_.chain, skeleton_, view, marks);
  for (int k = 0; k < counted; ++k) {
    pose_at(k);
    fit.add_pose(*ws_, limit_);
  }
  return fit.box();
}

void Panel::settle(const Camera& camera, const Rect& scene, int clip, double marks) {
  camera_ = camera;
  area_ = scene;
  clip_ = clip;
  look_ = look_of(skeleton_, camera_, theme_, 1, marks);
  if (may_freeze()) {
    find_last_inside();
    find_rails(last_ + 1);
  }
  follow_tip();
}

bool Panel::is_inside() const {
  const double edge = look_.marks * kLargestMark;
  const auto holds = [&](const Eigen::Vector3d& place) {
    const Point p = camera_.project(place);
    // False for NaN, too.
    return p.x - edge >= area_.x0 && p.x + edge <= area_.x1 && p.y - edge >= area_.y0 &&
           p.y + edge <= area_.y1;
  };
  for (int b = 1; b < int(run_.chain.bodies.size()); ++b) {
    if (!holds(pose_of(*ws_, b).translation())) return false;
  }
  for (const LinkSegment& link : skeleton_.links) {
    if (!holds(pose_of(*ws_, link.body) * link.from) || !holds(pose_of(*ws_, link.body) * link.to))
      return false;
  }
  return holds(tip_position(run_.chain, *ws_));
}

void Panel::find_last_inside() {
  for (int k = 0; k < samples_; ++k) {
    pose_at(k);
    if (is_inside()) continue;
    left_ = true;
    last_ = std::max(0, k - 1);
    return;
  }
}

void Panel::follow_tip() {
  for (int k = 0; k <= last_; ++k) {
    pose_at(k);
    tip_.add(run_.trajectory.t[std::size_t(k)], camera_.project(tip_position(run_.chain, *ws_)),
             camera_.project_vector(frame_velocity(run_.chain, *ws_, run_.chain.end_effector)));
  }
}

void Panel::draw_static(Picture& picture) const {
  if (layers_.chain) draw_base(picture, {run_.chain, skeleton_, camera_, look_}, clip_);
}

void Panel::draw_frame(Picture& picture, int k, const MassScale& scale, const Fonts& fonts) const {
  k = std::clamp(k, 0, last_);
  pose_at(k);
  const Color trail = theme_.curve[std::size_t(std::max(run_.chain.nv, 1) - 1) % theme_.curve.size()];
  const ChainDrawing drawing{run_.chain, skeleton_, camera_, look_};
  if (layers_.chain) draw_rails(picture, drawing, *ws_, clip_);
  if (layers_.trail) draw_trail(picture, tip_, k, trail, clip_);
  if (layers_.chain) draw_links(picture, drawing, *ws_, clip_);
  const Point tip = tip_.place(k);
  if (layers_.ellipse) {
    const EllipseStyle style{&theme_, &fonts, run_.scene.text_scale, scale.per_kg(), area_};
    draw_mass_ellipse(picture,
                      mass_axes(effective_mass_of(run_.chain, *ws_, run_.trajectory.q_at(k),
                                                  run_.chain.end_effector, Task::linear)),
                      tip, camera_, style, clip_);
  }
  if (layers_.chain) draw_end_effector(picture, tip, look_, clip_);
}

std::optional<double> Panel::left_at() const {
  if (!may_freeze()) return std::nullopt;
  if (!left_) return run_.trajectory.end_time;
  return run_.trajectory.t[std::size_t(std::min(last_ + 1, samples_ - 1))];
}

std::string Panel::note(int k) const {
  const std::optional<double> left = left_at();
  if (!left || k <= last_) return "";
  const bool gone = left_ || run_.trajectory.status == RunStatus::diverged;
  return (gone ? "left the picture at " : "ended at ") + time_text(*left);
}

}  // namespace chainreel

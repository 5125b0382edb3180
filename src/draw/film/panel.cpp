#include "draw/film/panel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/layers/ellipse.hpp"
#include "draw/layers/ghosts.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/crba.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "scene/fall.hpp"

namespace chainreel {
namespace {

constexpr double kWild =
    100;  // lengths of the chain: beyond, a run that did not finish is left out of the fit
constexpr double kLargestMark = size::kCarriageLength / 2;  // around a place of the chain, half of its size
constexpr int kScaleSamples = 200;                          // of a clip decide on the scale of its ellipses
constexpr double kAir = 0.010;                              // around a part of the page that is left free

}  // namespace

Layers layers_of(const Scene& scene) {
  const auto named = [&](const char* name) {
    return std::find(scene.draw.begin(), scene.draw.end(), name) != scene.draw.end();
  };
  Layers layers;
  layers.chain = named("chain"), layers.trail = named("trail"), layers.ghosts = named("ghosts");
  layers.frames = named("frames"), layers.com = named("com"), layers.ellipse = named("ellipse");
  layers.ground = named("ground"), layers.shadow = named("shadow");
  layers.acting = {named("torque"), named("velocity"), named("gravity"), named("constraint_force")};
  layers.mass_matrix = named("mass_matrix"), layers.equation = named("equation"), layers.time = named("time");
  layers.title = named("title"), layers.torque_label = named("torque_label");
  layers.scale_bar = named("scale_bar"), layers.legend = named("legend");
  layers.reading = reading_named(scene.ellipse.reading);
  layers.section = scene.ellipse.shape == "section";
  if (is_transparent(scene)) {
    layers.time = layers.title = layers.torque_label = layers.legend = layers.equation = false;
    layers.scale_bar = false;
  }
  return layers;
}

Panel::Panel(const PanelRun& run, const Layers& layers, int samples, WildEnd wild_end, const Theme& theme)
    : run_(run),
      layers_(layers),
      theme_(theme),
      wild_end_(wild_end),
      wild_(!is_complete(run.trajectory.status)),
      samples_(samples),
      last_(samples - 1),
      skeleton_(skeleton_of(run.chain)),
      ws_(std::make_unique<Workspace>(run.chain)) {
  // A run that finished is drawn wherever it went: a free fall may be long.
  limit_ = run.trajectory.status == RunStatus::finished ? std::numeric_limits<double>::max()
                                                        : kWild * skeleton_.reach;
  if (run.simulation && run.simulation->events && run.simulation->events->foot)
    foot_.emplace(*run.simulation, run.trajectory, samples);
  if (layers_.ellipse) tip_mass_.emplace(run.chain, run.simulation ? run.simulation->constraints : ConstraintPlan{});
  if (layers_.acting.any()) acting_.emplace(run.chain, run.simulation, run.trajectory, layers_.acting);
}

void Panel::pose_at(int k) const {
  compute_kinematics(run_.chain, *ws_, run_.trajectory.q_at(k), run_.trajectory.qd_at(k));
}

std::vector<MassAxis> Panel::ellipse_axes(int k) const {
  const EffectiveMass effective = tip_mass_->at(*ws_, run_.trajectory.q_at(k));
  if (!layers_.section) return mass_axes(effective);
  pose_at(k);
  return section_axes(effective, tip_plane(run_.chain, *ws_), layers_.reading);
}

std::vector<double> Panel::bounded_semi_axes() const {
  std::vector<double> bounded;
  const int count = std::min(samples_, kScaleSamples);
  for (int i = 0; i < count; ++i) {
    const int k = int(std::int64_t(i) * samples_ / count);
    const auto axes = ellipse_axes(k);
    if (const auto length = bounded_semi_axis(axes, layers_.reading)) bounded.push_back(*length);
  }
  return bounded;
}

VectorPeaks Panel::peaks() {
  VectorPeaks peaks;
  for (int k = 0; acting_ && k < samples_; ++k) {
    pose_at(k);
    // Where a run goes wild its forces say nothing.
    if (run_.chain.end_effector >= 0 && !(tip_position(run_.chain, *ws_).norm() <= limit_)) break;
    for (const WorldVector& vector : acting_->at(*ws_, k)) peaks.add(vector);
  }
  return peaks;
}

double Panel::largest_mass_entry() const {
  double largest = 0;
  const int count = std::min(samples_, kScaleSamples);
  for (int i = 0; i < count; ++i) {
    const int k = int(std::int64_t(i) * samples_ / count);
    compute_mass_matrix(run_.chain, *ws_, run_.trajectory.q_at(k));
    const double entry = ws_->M.cwiseAbs().maxCoeff();
    if (std::isfinite(entry)) largest = std::max(largest, entry);
  }
  return largest;
}

void Panel::set_pens(const Fonts& fonts, const VectorScales& scales, double marks) {
  const double text_scale = run_.scene.text_scale;
  if (layers_.acting.any()) pen_.emplace(theme_, fonts, text_scale, scales, marks);
  if (layers_.frames) axes_.emplace(run_.chain, theme_, fonts, text_scale, marks);
}

void Panel::find_rails(int samples) {
  for (int k = 0; k < samples; ++k) widen_rails(skeleton_, run_.chain, run_.trajectory.q_at(k), limit_);
}

StripRun Panel::strip_run() const {
  StripRun run{title(), wild_, {}, {}};
  run.times.assign(run_.trajectory.t.begin(), run_.trajectory.t.begin() + samples_);
  if (run_.simulation) run.plots = plot_curves(*run_.simulation, run_.trajectory, samples_);
  return run;
}

MotionBox Panel::motion(bool with_wild) const {
  MotionBox box(up_of(run_.chain));
  const int samples = counted(with_wild), count = std::min(samples, kScaleSamples);
  for (int i = 0; i < count; ++i) {
    pose_at(int(std::int64_t(i) * samples / count));
    extend(box, run_.chain, skeleton_, run_.shapes, *ws_, limit_);
  }
  return box;
}

FitBox Panel::fit_box(const Camera& view, double marks, bool with_wild) {
  // Where a run begins is in the picture however it ends.
  find_rails(counted(with_wild));
  ChainFit fit(run_.chain, skeleton_, view, marks, run_.shapes);
  FitBox marked;  // what is drawn over the chain
  std::map<int, int> kinds;
  const int axes = marked.add_kind(room_around(axes_ ? axes_->reach() : 0));
  const int com = marked.add_kind(room_around(marks * size::kCenterOfMass / 2));
  const auto add = [&](int kind, const Eigen::Vector3d& place) {
    marked.add(kind, view.flat(place));
  };
  if (is_constrained()) {
    const double half = marks * size::kGroundLength / 2;
    const int pin = marked.add_kind({half, half, marks * pin_depth(), 0});
    for (const Eigen::Vector3d& place : closure_pins(run_.chain, run_.simulation->constraints)) add(pin, place);
  }
  for (int k = 0; k < counted(with_wild); ++k) {
    pose_at(k);
    if (!fit.add_pose(*ws_, limit_)) continue;
    if (axes_)
      for (const Eigen::Isometry3d& X_WF : axes_->poses(*ws_)) add(axes, X_WF.translation());
    if (layers_.com) add(com, center_of_mass(run_.chain, *ws_));
    if (!acting_ || !pen_) continue;
    for (const WorldVector& vector : acting_->at(*ws_, k)) pen_->add_to(marked, kinds, vector, view);
  }
  FitBox box = fit.box();
  box.add(marked);
  return box;
}

bool Panel::covers(const Camera& camera, const Rect& part, int k) const {
  const auto near = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
    Point a = camera.project(from), b = camera.project(to);
    return cut_segment(widened(part, radius + kAir), a, b);
  };
  pose_at(k);
  for (const LinkSegment& link : skeleton_.links) {
    const Eigen::Isometry3d X_WB = pose_of(*ws_, link.body);
    if (near(X_WB * link.from, X_WB * link.to, size::kLinkWidth / 2)) return true;
  }
  if (run_.shapes)
    for (const BodyShape& shape : run_.shapes->shapes)
      if (overlap(widened(part, kAir), extent_of(shape, *ws_, camera))) return true;
  for (const Rail& rail : skeleton_.rails)
    if (near(rail_point(run_.chain, *ws_, rail.body, rail.lower),
             rail_point(run_.chain, *ws_, rail.body, rail.upper), rail_overhang(rail.carrier)))
      return true;
  const Eigen::Vector3d root = root_place(run_.chain);
  if (near(root, root, size::kGroundLength / 2)) return true;
  if (run_.chain.end_effector >= 0) {
    const Eigen::Vector3d tip = tip_position(run_.chain, *ws_);
    if (near(tip, tip, kLargestMark)) return true;
  }
  if (axes_)
    for (const Eigen::Isometry3d& X_WF : axes_->poses(*ws_))
      if (near(X_WF.translation(), X_WF.translation(), axes_->reach())) return true;
  if (!acting_ || !pen_) return false;
  for (const WorldVector& vector : acting_->at(*ws_, k)) {
    const Rect extent = pen_->extent(vector, camera);
    const Point place = camera.project(vector.place);
    if (overlap(widened(part, kAir), {extent.x0 + place.x, extent.y0 + place.y, extent.x1 + place.x,
                                      extent.y1 + place.y}))
      return true;
  }
  return false;
}

bool Panel::leaves_free(const Camera& camera, const Rect& part) {
  for (int k = 0; k < counted(false); ++k)
    if (covers(camera, part, k)) return false;
  return true;
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
  return run_.chain.end_effector < 0 || holds(tip_position(run_.chain, *ws_));
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
  if (run_.chain.end_effector < 0) return;
  for (int k = 0; k <= last_; ++k) {
    pose_at(k);
    const Eigen::Vector3d tip = tip_position(run_.chain, *ws_);
    tip_.add(run_.trajectory.t[std::size_t(k)], camera_.project(tip),
             camera_.project_vector(frame_velocity(run_.chain, *ws_, run_.chain.end_effector), tip));
  }
}

void Panel::draw_static(Picture& picture) const {
  if (outline_) return;
  if (ground_ && layers_.ground) draw_ground_plane(picture, *ground_, camera_, theme_, clip_);
  if (layers_.chain && !foot_) draw_base(picture, {run_.chain, skeleton_, camera_, look_, run_.shapes}, clip_);
  if (layers_.chain && is_constrained())
    draw_closure_pins(picture, {run_.chain, skeleton_, camera_, look_}, run_.simulation->constraints, clip_);
  if (layers_.chain && foot_) foot_->draw_foot(picture, camera_, look_, clip_);
}

void Panel::draw_ghosts(Picture& picture, int k) const {
  for (const Ghost& ghost : ghosts_at(run_.trajectory.t, k, run_.scene.video.fps)) {
    pose_at(ghost.frame);
    ChainLook look = look_;
    look.strength = ghost.strength;
    look.filled = ghost.filled;
    const ChainDrawing drawing{run_.chain, skeleton_, camera_, look, run_.shapes};
    draw_rails(picture, drawing, *ws_, clip_);
    draw_links(picture, drawing, *ws_, clip_);
  }
}


// Marks and vectors, below the end effector's disc.
void Panel::draw_overlays(Picture& picture, const std::vector<WorldVector>& vectors, MarkLabels& labels) const {
  if (axes_) axes_->draw(picture, camera_, *ws_, clip_, labels);
  if (layers_.com)
    draw_center_of_mass(picture, camera_.project(center_of_mass(run_.chain, *ws_)), look_, clip_);
  for (const WorldVector& vector : vectors) pen_->draw(picture, vector, camera_, clip_, labels);
  labels.draw(picture, area_, theme_.background, clip_);
}

void Panel::draw_frame(Picture& picture, int k, const EllipseScale& scale, const Fonts& fonts) const {
  if (outline_) return draw_outline(picture, k, fonts);
  k = std::clamp(k, 0, last_);
  if (layers_.ghosts) draw_ghosts(picture, k);
  pose_at(k);
  const std::vector<WorldVector> vectors = acting_ ? acting_->at(*ws_, k) : std::vector<WorldVector>{};
  const Color trail = trail_color_ ? *trail_color_ : theme_.curve[std::size_t(std::max(run_.chain.nv, 1) - 1) % theme_.curve.size()];
  const ChainDrawing drawing{run_.chain, skeleton_, camera_, look_, run_.shapes};
  if (ground_ && layers_.shadow) draw_shadow(picture, drawing, *ws_, clip_);
  if (layers_.chain) draw_rails(picture, drawing, *ws_, clip_);
  if (layers_.trail) draw_trail(picture, tip_, k, trail, clip_);
  if (layers_.chain) draw_links(picture, drawing, *ws_, clip_);
  if (layers_.chain && is_constrained())
    draw_closure_joints(picture, drawing, *ws_, run_.simulation->constraints, clip_);
  MarkLabels labels;
  if (layers_.ellipse) {
    const Point tip = tip_.place(k);
    EllipseStyle style{&theme_, &fonts, run_.scene.text_scale, scale.per_unit(), area_, layers_.reading};
    style.labels = &labels;
    const Camera seen = camera_.seen_at(tip_position(run_.chain, *ws_));
    draw_mass_ellipse(picture, ellipse_axes(k), tip, seen, style, clip_);
  }
  if (layers_.chain && foot_) foot_->draw_pressure(picture, camera_, look_, k, clip_);
  draw_overlays(picture, vectors, labels);
  if (layers_.chain && !run_.shapes && run_.chain.end_effector >= 0)
    draw_end_effector(picture, tip_.place(k), look_, clip_);
  if (!map_) return;
  compute_mass_matrix(run_.chain, *ws_, run_.trajectory.q_at(k));
  map_->draw(picture, ws_->M, map_corner_);
}

std::optional<double> Panel::left_at() const {
  if (!may_freeze()) return std::nullopt;
  if (!left_) return run_.trajectory.end_time;
  return run_.trajectory.t[std::size_t(std::min(last_ + 1, samples_ - 1))];
}

std::string Panel::title() const {
  return title_of(run_.scene, run_.trajectory);
}

// The last events up to this frame, as many as a line holds.
std::string Panel::event_note(int k) const {
  constexpr int kInALine = 2;
  const EventHits& hits = run_.trajectory.events;
  const auto begin = hits.t.begin();
  const auto end = k < run_.trajectory.size()
                       ? std::upper_bound(begin, hits.t.end(), run_.trajectory.t[std::size_t(k)])
                       : hits.t.end();
  std::string text;
  for (int i = std::max(0, int(end - begin) - kInALine); i < int(end - begin); ++i) {
    const EventEntry& event = run_.scene.events[std::size_t(hits.event[std::size_t(i)])];
    text += (text.empty() ? "" : ";  ") + event.title() + " at " + time_text(hits.t[std::size_t(i)]);
  }
  return text;
}

std::string Panel::note(int k) const {
  const std::optional<double> left = left_at();
  if (!left || k <= last_) return event_note(k);
  const bool gone = left_ || run_.trajectory.status == RunStatus::diverged;
  return (gone ? "left the picture at " : "ended at ") + time_text(*left);
}

}  // namespace chainreel

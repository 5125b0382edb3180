// The layers `target`: the pose that feedback follows, in outline below the chain, and what proportional feedback pulls with:
// a coil from each joint's target to where it is, over bodies, which would hide it; or the place that feedback in the space of the task pulls a frame to, with the coil
// between both.
#include <algorithm>
#include <cmath>
#include <map>

#include "draw/layers/devices.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/coils.hpp"
#include "draw/robot/chain.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kTargetShown = 0.55;      // strength of the outline
constexpr double kTargetBodies = 0.3;      // ... of bodies
constexpr double kTargetStroke = 0.8;      // of an outline's width
constexpr double kCoilAbout = 0.078;       // radius of coils about joints, units of H
constexpr double kPlace = 0.013, kPlaceLine = 0.0025;  // of a place that a frame is pulled to: radius of its ring, width of its lines
constexpr double kShortestCoil = 0.004;    // units of H

class Target : public Layer {
 public:
  // `is_over`: what lies over bodies.
  Target(const Stage& stage, bool is_over) : is_over_(is_over) {
    for (const StagedRun& motion : stage.motions) {
      if (motion.is_outlined() || motion.simulation() == nullptr || (is_over && !motion.shapes())) continue;
      if (std::vector<TaskTarget> places = task_targets_along(*motion.simulation(), motion.trajectory()); !places.empty() && !is_over)
        places_.emplace(&motion, std::move(places));
      if (!shows_drives(stage, motion)) continue;
      std::vector<double> q = references_along(*motion.simulation(), motion.trajectory());
      if (q.empty()) continue;
      followed_.emplace(&motion, followed_by(motion, std::move(q)));
    }
  }

  UnderWords under_words() const override { return UnderWords::never; }

  void measure(const Sight& sight, FitBox& box) const override {
    if (const auto places = places_.find(&sight.motion); places != places_.end() && sight.k < int(places->second.size()))
      add_place(sight, places->second[std::size_t(sight.k)], box);
    const auto found = followed_.find(&sight.motion);
    if (found == followed_.end() || is_over_) return;
    pose(found->second, sight.motion.chain(), sight.k);
    const Workspace& ws = *found->second.ws;
    for (const LinkSegment& link : sight.motion.skeleton().links)
      if (found->second.is_driven[std::size_t(link.body)]) box.add(room_around(size::kLinkWidth / 2), sight.camera.flat(pose_of(ws, link.body) * link.to));
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    if (const auto places = places_.find(&panel.motion()); places != places_.end() && shot.k < int(places->second.size()))
      draw_place(picture, shot, places->second[std::size_t(shot.k)]);
    const auto found = followed_.find(&panel.motion());
    if (found == followed_.end()) return;
    const Followed& followed = found->second;
    const ConstVec target = pose(followed, panel.chain(), shot.k);
    if (!is_over_) draw_pose(picture, panel, followed);
    if (is_over_ == (panel.motion().shapes() != nullptr))
      for (const LinearDrive& drive : followed.springs) draw_pull(picture, shot, drive, target);
  }

 private:
  struct Followed {
    std::vector<double> q;              // nv a sample
    std::vector<LinearDrive> springs;   // that pull there
    std::unique_ptr<Workspace> ws;      // of the target; a film is drawn by one thread at a time
    std::vector<double> at_rest;
    std::vector<bool> is_driven;        // bodies whose joint follows, by feedback that has gains or a model
  };

  // In outline; of bodies pale, as earlier poses are.
  static void draw_pose(Picture& picture, const Panel& panel, const Followed& followed) {
    ChainLook look = panel.look();
    Theme theme = *look.theme;
    theme.ink = theme.torque;
    look.theme = &theme;
    look.filled = false;
    look.strength = panel.motion().shapes() ? kTargetBodies : kTargetShown;
    look.stroke = kTargetStroke;
    ChainDrawing drawing = panel.drawing(look);
    drawing.only = &followed.is_driven;
    draw_rails(picture, drawing, *followed.ws, panel.clip());
    draw_links(picture, drawing, *followed.ws, panel.clip());
  }

  // What follows nothing has no target, and stands as it stands.
  static Followed followed_by(const StagedRun& motion, std::vector<double> q) {
    const Chain& chain = motion.chain();
    const auto n = std::size_t(chain.nv);
    Followed followed{std::move(q), {}, std::make_unique<Workspace>(chain), std::vector<double>(n), {}};
    for (const LinearDrive& drive : linear_drives(*motion.simulation()))
      if (drive.follows && drive.is_spring()) followed.springs.push_back(drive);
    for (const Body& body : chain.bodies)
      followed.is_driven.push_back(&body != &chain.bodies.front() && motion.simulation()->torque->follows(std::size_t(body.joint.v_index)));
    return followed;
  }

  // Lets the workspace stand as the target does at sample k; its coordinates.
  static ConstVec pose(const Followed& followed, const Chain& chain, int k) {
    const auto n = std::size_t(chain.nv);
    const ConstVec target(followed.q.data() + std::size_t(k) * n, n);
    compute_kinematics(chain, *followed.ws, target, followed.at_rest);
    return target;
  }

  static void draw_pull(Picture& picture, const Shot& shot, const LinearDrive& drive, ConstVec target) {
    const Panel& panel = shot.panel;
    const int body = body_of_freedom(panel.chain(), drive.freedom);
    const Joint& joint = panel.chain().bodies[std::size_t(body)].joint;
    const double q = panel.motion().trajectory().q_at(shot.k)[std::size_t(joint.q_index)];
    const double wanted = target[std::size_t(drive.freedom)];
    const Color color = toned(panel.look().theme->torque, panel.look());
    const Vector3d place = pose_of(shot.ws, body).translation();
    const Camera& camera = panel.camera();
    const Point at = camera.project(place);
    if (!is_drawable(at) || !std::isfinite(q + wanted)) return;
    if (joint.kind == JointKind::prismatic) {
      const Point from = camera.project(rail_point(panel.chain(), shot.ws, body, wanted));
      if (is_drawable(from) && norm(at - from) > kShortestCoil)
        draw_coil(picture, from, at, panel.look().rails, color, panel.clip());
      return;
    }
    const double radius = panel.marks() * kCoilAbout;
    if (std::abs(q - wanted) * radius < kShortestCoil) return;
    const JointZero zero = joint_zero(panel.chain(), panel.motion().skeleton(), shot.ws, body);
    const Camera seen = camera.seen_at(place);
    const PageTurn turn{at,
                        {seen.right.dot(zero.along), seen.up.dot(zero.along)},
                        {seen.right.dot(zero.quarter), seen.up.dot(zero.quarter)}};
    draw_round_coil(picture, turn, radius, wanted, q, panel.marks(), color, panel.clip(), casing_over(panel));
  }

  static void add_place(const Sight& sight, const TaskTarget& target, FitBox& box) {
    box.add(room_around(kPlace), sight.camera.flat(target.wished(frame_position(sight.motion.chain(), sight.ws, target.frame))));
  }

  // A ring with a cross at the place, and the coil from there to the frame; of springs that are not the same along all axes one along
  // each, as they pull.
  static void draw_place(Picture& picture, const Shot& shot, const TaskTarget& target) {
    const Panel& panel = shot.panel;
    const Color color = toned(panel.look().theme->torque, panel.look());
    const Vector3d tip = frame_position(panel.chain(), shot.ws, target.frame);
    const Vector3d place = target.wished(tip);
    const Point at = panel.camera().project(place), from = panel.camera().project(tip);
    if (!is_drawable(at) || !is_drawable(from)) return;
    const auto draw_pull_from = [&](const Vector3d& anchor) {
      const Point held = panel.camera().project(anchor);
      if (is_drawable(held) && norm(from - held) > kPlace) draw_coil(picture, held, from, panel.look().rails, color, panel.clip());
    };
    // What pushes away is no spring.
    if (target.is_one_spring() && target.pulls.front().kp > 0) draw_pull_from(place);
    if (!target.is_one_spring())
      for (const TaskTarget::Pull& pull : target.pulls)
        if (pull.kp > 0) draw_pull_from(tip + pull.axis.dot(place - tip) * pull.axis);
    const double radius = panel.marks() * kPlace;
    // Of a place that is reached the link would leave the ends of the cross.
    const Color mark = color.faded(std::clamp(norm(from - at) / link_end(panel.look()) - 0.5, 0.0, 1.0));
    const Paint line{{}, mark, panel.marks() * kPlaceLine};
    picture.add(Ellipse{at, {radius, 0}, {0, radius}, line}, panel.clip());
    for (const Point way : {Point{1, 0}, Point{0, 1}})
      picture.add(Capsule{at - 1.5 * radius * way, at + 1.5 * radius * way, panel.marks() * kPlaceLine / 2, {mark, {}, 0}}, panel.clip());
  }

  bool is_over_;
  std::map<const StagedRun*, Followed> followed_;
  std::map<const StagedRun*, std::vector<TaskTarget>> places_;  // a sample each
};

}  // namespace

std::unique_ptr<const Layer> make_layer_target(const Stage& stage) {
  return std::make_unique<Target>(stage, false);
}

std::unique_ptr<const Layer> make_layer_target_pulls(const Stage& stage) {
  return std::make_unique<Target>(stage, true);
}

}  // namespace chainreel

// The layer `target`: the pose that feedback follows, in outline below the chain, and what proportional feedback pulls with:
// a coil from each joint's target to where it is.
#include <algorithm>
#include <cmath>
#include <map>

#include "draw/layers/coils.hpp"
#include "draw/layers/devices.hpp"
#include "draw/layers/layer.hpp"
#include "draw/robot/chain.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kTargetShown = 0.55;      // strength of the outline
constexpr double kTargetStroke = 0.8;      // of an outline's width
constexpr double kCoilAbout = 0.078;       // radius of coils about joints, units of H
constexpr double kShortestCoil = 0.004;    // units of H

class Target : public Layer {
 public:
  explicit Target(const Stage& stage) {
    for (const StagedRun& motion : stage.motions) {
      if (motion.is_outlined() || motion.shapes() || motion.simulation() == nullptr) continue;
      std::vector<double> q = references_along(*motion.simulation(), motion.trajectory());
      if (q.empty()) continue;
      Followed followed{std::move(q), {}, std::make_unique<Workspace>(motion.chain()),
                        std::vector<double>(std::size_t(motion.chain().nv))};
      for (const LinearDrive& drive : linear_drives(*motion.simulation()))
        if (drive.follows && drive.is_spring()) followed.springs.push_back(drive);
      followed_.emplace(&motion, std::move(followed));
    }
  }

  UnderWords under_words() const override { return UnderWords::never; }

  void measure(const Sight& sight, FitBox& box) const override {
    const auto found = followed_.find(&sight.motion);
    if (found == followed_.end()) return;
    pose(found->second, sight.motion.chain(), sight.k);
    const Workspace& ws = *found->second.ws;
    for (const LinkSegment& link : sight.motion.skeleton().links)
      box.add(room_around(size::kLinkWidth / 2), sight.camera.flat(pose_of(ws, link.body) * link.to));
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    const auto found = followed_.find(&panel.motion());
    if (found == followed_.end()) return;
    const Followed& followed = found->second;
    const ConstVec target = pose(followed, panel.chain(), shot.k);
    ChainLook look = panel.look();
    Theme theme = *look.theme;
    theme.ink = theme.torque;
    look.theme = &theme;
    look.filled = false;
    look.strength = kTargetShown;
    look.stroke = kTargetStroke;
    const ChainDrawing drawing = panel.drawing(look);
    draw_rails(picture, drawing, *followed.ws, panel.clip());
    draw_links(picture, drawing, *followed.ws, panel.clip());
    for (const LinearDrive& drive : followed.springs) draw_pull(picture, shot, drive, target);
  }

 private:
  struct Followed {
    std::vector<double> q;              // nv a sample
    std::vector<LinearDrive> springs;   // that pull there
    std::unique_ptr<Workspace> ws;      // of the target; a film is drawn by one thread at a time
    std::vector<double> at_rest;
  };

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
    draw_round_coil(picture, turn, radius, wanted, q, panel.marks(), color, panel.clip());
  }

  std::map<const StagedRun*, Followed> followed_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_target(const Stage& stage) {
  return std::make_unique<Target>(stage);
}

}  // namespace chainreel

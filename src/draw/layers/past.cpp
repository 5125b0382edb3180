#include "draw/layers/past.hpp"

#include <algorithm>
#include <cmath>

#include "draw/layers/layer.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

constexpr double kPiece =
    0.006;  // H: a piece this long of a turn of radius 0.03 H misses it by a sixth of a pixel
constexpr int kMostPieces = 24;  // between two frames

// 1 at the head, 0 at the end of the trail; one without end keeps its whole way as it is.
double freshness(double age, double length) {
  if (std::isinf(length)) return 1;
  return std::clamp(1 - age / length, 0.0, 1.0);
}

// The instant, not before `since`, from which on the way to frame k is no longer than `longest`.
double way_begins(const TipPath& path, int k, double since, double longest) {
  double way = 0;
  for (int i = k - 1; i >= 0 && path.time(i + 1) > since; --i) {
    const int pieces = path.pieces(i, kPiece, kMostPieces);
    const double step = (path.time(i + 1) - path.time(i)) / pieces;
    Point end = path.place(i + 1);
    for (int j = pieces; j > 0; --j) {
      const double to = path.time(i) + j * step;
      const Point begin = path.at(to - step, i);
      const double piece = norm(end - begin);
      if (way + piece > longest) return std::max(since, to - (longest - way) / piece * step);
      way += piece;
      end = begin;
    }
  }
  return since;
}

TrailPoint trail_point(const TipPath& path, double t, int frame, double now, double lines, double length, double opacity) {
  const double fresh = freshness(now - t, length);
  return {path.at(t, frame), lines * (size::kTrailTail + fresh * (size::kTrailHead - size::kTrailTail)),
          opacity * fresh};
}

bool stays_on_rail(const StagedRun& motion) {
  constexpr double kStill = 1e-6;   // rad or m: no such way is seen
  constexpr double kBeside = 1e-6;  // m, of the end effector: round-off of places
  const Chain& chain = motion.chain();
  if (chain.end_effector < 0) return false;
  const auto moves = [&](const Joint& joint) {
    const double start = motion.trajectory().q_at(0)[std::size_t(joint.q_index)];
    for (int k = 1; k < motion.samples(); ++k)
      if (!(std::abs(motion.trajectory().q_at(k)[std::size_t(joint.q_index)] - start) <= kStill)) return true;
    return false;
  };
  int slider = 0;
  for (int b = chain.frames[std::size_t(chain.end_effector)].body; b > 0; b = chain.bodies[std::size_t(b)].parent) {
    const Joint& joint = chain.bodies[std::size_t(b)].joint;
    if (joint.kind == JointKind::floating) return false;
    if (!moves(joint)) continue;
    if (joint.kind != JointKind::prismatic || slider > 0) return false;
    slider = b;
  }
  if (slider == 0) return false;
  const Workspace& ws = motion.pose_at(0);
  const Eigen::Isometry3d pose = pose_of(ws, slider);
  const Eigen::Vector3d off = pose.inverse() * tip_position(chain, ws);
  return off.cross(chain.bodies[std::size_t(slider)].joint.axis).norm() <= kBeside;
}

class TrailLayer : public Layer {
 public:
  explicit TrailLayer(const Stage& stage) : theme_(&stage.theme), on_rails_(runs_on_rails(stage)) {}

  // Its newest part is seen through letters.
  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw(Picture& picture, const Shot& shot) const override {
    if (on_rails_.contains(&shot.panel.motion())) return;
    draw_trail(picture, shot.panel.tip(), shot.k, color_of(shot.panel.motion()), shot.panel.clip(), theme_->lines, theme_->trail, trail_opacity(*theme_), longest_trail(shot.panel));
  }

 private:
  Color color_of(const StagedRun& motion) const {
    if (motion.variant()) return motion.variant()->color;
    // Of the link that carries it, which a closed loop has among others.
    const Chain& chain = motion.chain();
    if (is_followed_by_center(chain)) return theme_->ink;
    const int body = chain.end_effector < 0 ? chain.nv : chain.frames[std::size_t(chain.end_effector)].body;
    return theme_->curve[std::size_t(std::max(body, 1) - 1) % theme_->curve.size()];
  }

  const Theme* theme_;
  std::set<const StagedRun*> on_rails_;
};

class GhostsLayer : public Layer {
 public:
  explicit GhostsLayer(const Stage& stage) : shows_chain_(stage.shows("chain")) {}

  // A word on an earlier pose is taken for its name.
  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    for (const Ghost& ghost : ghosts_at(panel.motion().trajectory().t, shot.k, panel.scene().video.fps)) {
      const Workspace& then = panel.motion().pose_at(ghost.frame);
      ChainLook look = panel.look();
      look.strength = ghost.strength;
      look.filled = ghost.filled;
      const ChainDrawing drawing = panel.drawing(look);
      draw_rails(picture, drawing, then, panel.clip());
      draw_links(picture, drawing, then, panel.clip());
    }
    panel.motion().pose_at(shot.k);  // as it stands for what lies above
    if (shows_chain_ && !panel.motion().has_foot()) draw_base(picture, panel.drawing(), panel.clip());  // which they would hide
  }

 private:
  bool shows_chain_;
};

// The pose in which a run's constraints first depend on each other, behind the chain: a picture of another instant shows what its film is about. It
// fades where the chain itself comes there.
class ChangePointLayer : public Layer {
 public:
  explicit ChangePointLayer(const Stage&) {}

  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    const StagedRun& motion = panel.motion();
    if (motion.change_points().empty()) return;
    const std::vector<Point> now = joints_on_page(panel, shot.ws);
    const Workspace& then = motion.curve_pose_at(nearest_sample(motion.curve_run().t, motion.change_points().front()));
    const std::vector<Point> there = joints_on_page(panel, then);
    double apart = 0;
    for (std::size_t i = 0; i < now.size(); ++i) apart = std::max(apart, norm(there[i] - now[i]));
    ChainLook look = panel.look();
    look.strength = kStrongestGhost * std::clamp((apart - kSamePose) / (kOtherPose - kSamePose), 0.0, 1.0);
    if (look.strength > 0) {
      const ChainDrawing drawing = panel.drawing(look);
      draw_rails(picture, drawing, then, panel.clip());
      draw_links(picture, drawing, then, panel.clip());
    }
    motion.pose_at(shot.k);  // as it stands for what lies above
  }

 private:
  static constexpr double kSamePose = 0.02, kOtherPose = 0.08;  // units of H, of the joint that is farthest from its place there: half of a link's width, twice a link's

  static std::vector<Point> joints_on_page(const Panel& panel, const Workspace& ws) {
    std::vector<Point> places;
    for (std::size_t b = 1; b < panel.chain().bodies.size(); ++b) places.push_back(panel.camera().project(pose_of(ws, int(b)).translation()));
    for (std::size_t f = 0; f < panel.chain().frames.size(); ++f) places.push_back(panel.camera().project(frame_position(panel.chain(), ws, int(f))));
    return places;
  }

  static int nearest_sample(const std::vector<double>& times, double t) {
    const auto next = std::lower_bound(times.begin(), times.end(), t);
    if (next == times.begin()) return 0;
    if (next == times.end()) return int(times.size()) - 1;
    return int(next - times.begin()) - (t - next[-1] < *next - t ? 1 : 0);
  }
};

}  // namespace

std::unique_ptr<const Layer> make_layer_change_point(const Stage& stage) {
  return std::make_unique<ChangePointLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_trail(const Stage& stage) {
  return std::make_unique<TrailLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_ghosts(const Stage& stage) {
  return std::make_unique<GhostsLayer>(stage);
}

std::set<const StagedRun*> runs_on_rails(const Stage& stage) {
  std::set<const StagedRun*> found;
  if (!stage.shows("chain")) return found;
  for (const StagedRun& motion : stage.motions)
    if (stays_on_rail(motion)) found.insert(&motion);
  return found;
}

double trail_opacity(const Theme& theme) {
  return is_dark(theme) ? kTrailOpacityOnDark : kTrailOpacity;
}

double longest_trail(const Panel& panel) {
  return panel.look().theme->trail > kTrailSeconds || panel.chain().has_floating ? HUGE_VAL : kTrailReaches * panel.skeleton().reach * panel.camera().scale;
}

void draw_trail(Picture& picture, const TipPath& path, int k, Color color, int clip, double lines, double length, double opacity, double longest) {
  const double now = path.time(k);
  double since = path.gapless_since(k, now - length);
  if (!(since < now)) return;
  if (const double begin = std::isinf(longest) ? since : way_begins(path, k, since, longest); begin > since) {
    since = begin;
    length = now - begin;
  }
  Trail trail;
  trail.color = color;
  for (int i = path.frame_at(since); i < k; ++i) {
    const double from = std::max(since, path.time(i)), to = path.time(i + 1);
    const int pieces = path.pieces(i, kPiece, kMostPieces);
    for (int j = 0; j < pieces; ++j)
      trail.points.push_back(trail_point(path, from + j * ((to - from) / pieces), i, now, lines, length, opacity));
  }
  trail.points.push_back(trail_point(path, now, k, now, lines, length, opacity));
  picture.add(std::move(trail), clip);

  // The dots stand still while the trail moves on: they belong to whole tenths of a second of the film.
  const double r = lines * size::kTrailDot / 2;
  for (int i = int(std::ceil(since * kTrailDotsPerSecond)); double(i) / kTrailDotsPerSecond <= now; ++i) {
    const double t = double(i) / kTrailDotsPerSecond;
    const TrailPoint at = trail_point(path, t, path.frame_at(t), now, lines, length, opacity);
    if (at.alpha > 0) picture.add(Ellipse{at.p, {r, 0}, {0, r}, {color.faded(at.alpha), {}, 0}}, clip);
  }
}

int ghost_spacing(FrameRate fps) {
  return std::max(1, int(std::lround(fps.value() * kGhostSeconds / kMostGhosts)));
}

std::vector<Ghost> ghosts_at(const std::vector<double>& times, int frame, FrameRate fps) {
  const double spacing = frame_time(ghost_spacing(fps), fps), half_frame = 0.5 / fps.value();
  std::vector<Ghost> ghosts;
  for (int age = kMostGhosts; age >= 1; --age) {
    const double t = times[std::size_t(frame)] - age * spacing;
    if (t < times.front() - 1e-9) continue;
    const auto after = std::lower_bound(times.begin(), times.end(), t - half_frame / 2);
    int nearest = int(after - times.begin());
    while (nearest + 1 < frame &&
           std::abs(times[std::size_t(nearest) + 1] - t) < std::abs(times[std::size_t(nearest)] - t))
      ++nearest;
    const double fade = double(age - 1) / (kMostGhosts - 1);
    ghosts.push_back(
        {nearest, kStrongestGhost + fade * (kFaintestGhost - kStrongestGhost), age <= kFilledGhosts});
  }
  return ghosts;
}

}  // namespace chainreel

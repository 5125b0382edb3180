// The layers `angles` and `limits`: the coordinates as the model counts them, from where each is zero on, and where they
// must not go.
#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <set>
#include <span>

#include "draw/layers/devices.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/coils.hpp"
#include "draw/robot/chain.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kAngleRadius = 0.085, kZeroReach = 0.120;  // units of H
constexpr double kAngleLine = 0.0026, kAngleGap = 0.016;
constexpr double kAngleHead = 0.014, kAngleHeadWidth = 0.010;
constexpr double kAnglePiece = 0.08;    // rad
constexpr double kSmallestAngle = 0.06; // rad: with less the symbol stands alone
constexpr double kBesideCarriage = 0.058;  // units of H, of a slider's length

constexpr double kBesideBody = 1.25;    // of the body's half thickness
constexpr double kMostGrown = 2.2;      // thicker bodies have it on them
constexpr double kOnePlace = 0.02;      // of the reach: joints that near have one place
constexpr double kApartInWrist = 0.25;  // of a radius
constexpr double kCasingOfMarks = 0.0016;  // units of H, beside a line over bodies

constexpr double kNearLimit = 20 * std::numbers::pi / 180;  // rad: a run that comes as near has the limit in all its pictures
constexpr double kNearOfRange = 0.25;   // ... and no more of the range
constexpr double kNearEnd = 0.10;       // of a slider's range, the same
constexpr double kFarLimit = 0.4;       // strength of a limit while nothing is near
constexpr double kWayToLimit = 2;       // times as near: from there on an arc leads from the link to the limit, ever stronger
constexpr double kLimitArc = 25 * std::numbers::pi / 180;  // of the arc beyond the limit
constexpr double kLimitFrom = 0.032, kLimitRadius = 0.062, kLimitLine = 0.0045, kLimitWay = 0.0022;

// The joints that have a coordinate of their own, not shared by mimicry: of those that go the same way the first.
template <class Do>
void for_each_joint(const Chain& chain, JointKind kind, Do&& act) {
  for (int b = 1; b < int(chain.bodies.size()); ++b) {
    const Joint& joint = chain.bodies[std::size_t(b)].joint;
    const auto before = std::span(chain.bodies).subspan(1, std::size_t(b - 1));
    const bool follows = std::ranges::any_of(before, [&](const Body& one) { return one.joint.ratio == 1 && one.joint.offset == 0 && one.joint.q_index == joint.q_index; });
    if (joint.kind == kind && joint.ratio == 1 && joint.offset == 0 && !follows) act(b, joint);
  }
}

PageTurn turn_about(const Panel& panel, const Workspace& ws, int body) {
  const Vector3d place = pose_of(ws, body).translation();
  const JointZero zero = joint_zero(panel.chain(), panel.motion().skeleton(), ws, body);
  const Camera seen = panel.camera().seen_at(place);
  return {panel.camera().project(place),
          {seen.right.dot(zero.along), seen.up.dot(zero.along)},
          {seen.right.dot(zero.quarter), seen.up.dot(zero.quarter)}};
}

// How many times as large as on bars a mark about a joint must be to lie beside the body that it moves, whose shape is as thick as that across
// its link and the axis.
double grown_beside_body(const Panel& panel, const Workspace& ws, int body, double q, double radius) {
  const BodyShapes* shapes = panel.motion().shapes();
  if (!shapes) return 1;
  const Vector3d place = pose_of(ws, body).translation();
  const JointZero zero = joint_zero(panel.chain(), panel.motion().skeleton(), ws, body);
  const Vector3d across = std::cos(q) * zero.quarter - std::sin(q) * zero.along;
  double thick = 0;
  for (const BodyShape& shape : shapes->shapes) {
    if (shape.body != body) continue;
    for (const Vector3d& corner : shape.corners) {
      const Vector3d from = pose_of(ws, body) * corner - place;
      thick = std::max(thick, std::abs(from.dot(across)));
    }
  }
  const Camera seen = panel.camera().seen_at(place);
  const double scale = norm(panel.camera().project_vector(seen.right, place));
  return std::clamp(kBesideBody * thick * scale / radius, 1.0, kMostGrown);
}

// Over bodies set off from them by a wider line.
void draw_arc(Picture& picture, const PageTurn& turn, double radius, double from, double to, double width, Color color,
              int clip, Color casing) {
  const int pieces = std::max(2, int(std::ceil(std::abs(to - from) / kAnglePiece)));
  Trail path;
  path.color = color;
  for (int i = 0; i <= pieces; ++i) path.points.push_back({turn.at(radius, from + (to - from) * i / pieces), width, 1});
  if (casing.a > 0) {
    Trail below = path;
    below.color = casing;
    for (TrailPoint& point : below.points) point.width += 2 * kCasingOfMarks;
    picture.add(std::move(below), clip);
  }
  picture.add(std::move(path), clip);
}

void draw_cased_line(Picture& picture, const PageLine& line, double width, Color color, int clip, Color casing) {
  if (casing.a > 0) draw_line(picture, line, width + 2 * kCasingOfMarks, casing, clip);
  draw_line(picture, line, width, color, clip);
}

double coordinate(const Shot& shot, const Joint& joint) {
  return shot.panel.motion().trajectory().q_at(shot.k)[std::size_t(joint.q_index)];
}

class Angles : public Layer {
 public:
  explicit Angles(const Stage& stage) : stage_(&stage) {}

  bool has_words() const override { return true; }

  void measure(const Sight& sight, FitBox& box) const override {
    for_each_joint(sight.motion.chain(), JointKind::revolute, [&](int body, const Joint&) {
      box.add(room_around(sight.marks * kZeroReach), sight.camera.flat(pose_of(sight.ws, body).translation()));
    });
  }

  void draw(Picture& picture, const Shot& shot) const override {
    for_each_joint(shot.panel.chain(), JointKind::revolute,
                   [&](int body, const Joint& joint) { draw_angle(picture, shot, body, joint); });
    for_each_joint(shot.panel.chain(), JointKind::prismatic,
                   [&](int body, const Joint& joint) { draw_length(picture, shot, body, joint); });
  }

 private:
  Color color() const { return stage_->theme.ink; }

  void add_label(const Shot& shot, const Joint& joint, Point near, Point away, Point anchor) const {
    const double em = scaled(std::max(size::kAxis * std::sqrt(shot.panel.marks()), kSmallestText), stage_->page.text_scale);
    TextLine text = lay_out_math(stage_->fonts, "q_{" + std::to_string(joint.v_index + 1) + "}",
                                 {Face::math, em, color(), Align::left});
    const Rect box = place_beyond(text, near, kAngleGap, away);
    shot.labels.add("angle " + std::to_string(joint.v_index + 1), std::move(text), box, anchor);
  }

  void draw_head(Picture& picture, Point tip, Point along, double size, int clip) const {
    const Point base = tip - (size * kAngleHead) * along, half = (size * kAngleHeadWidth / 2) * normal_to(along);
    picture.add(Polygon{{tip, base + half, base - half}, 3, {color(), {}, 0}}, clip);
  }

  // From the direction of the joint's link where its value is zero to where it is; whole turns are left out.
  void draw_angle(Picture& picture, const Shot& shot, int body, const Joint& joint) const {
    const PageTurn turn = turn_about(shot.panel, shot.ws, body);
    const double whole = 2 * std::numbers::pi, q = coordinate(shot, joint);
    if (!is_drawable(turn.center) || !std::isfinite(q)) return;
    const double angle = q - whole * std::trunc(q / whole), sign = angle < 0 ? -1 : 1;
    const double marks = shot.panel.marks(), grown_to = apart_of(shot, body) * grown_beside_body(shot.panel, shot.ws, body, q, marks * kAngleRadius), radius = grown_to * marks * kAngleRadius;
    const int clip = shot.panel.clip();
    const Color casing = casing_over(shot.panel);
    const PageLine zero{turn.center, turn.at(grown_to * marks * kZeroReach, 0)};
    if (casing.a > 0) draw_line(picture, zero, kAngleLine + 2 * kCasingOfMarks, casing, clip);
    draw_dashed_line(picture, zero, kAngleLine, color(), clip);
    const double head = std::min(marks * kAngleHead / radius, std::abs(angle));
    if (std::abs(angle) > 0) draw_arc(picture, turn, radius, 0, angle - 0.8 * sign * head, kAngleLine, color(), clip, casing);
    const Point tip = turn.at(radius, angle), base = turn.at(radius, angle - sign * head);
    const double grown = std::min(1.0, std::abs(angle) * radius / (marks * kAngleHead));
    if (norm(tip - base) > 1e-6) draw_head(picture, tip, unit(tip - base), marks * grown, clip);
    const double middle = std::abs(angle) < kSmallestAngle ? 0 : angle / 2;
    const Point near = turn.at(radius, middle);
    add_label(shot, joint, near, unit(near - turn.center), turn.center);
  }

  // Of joints whose axes cross, as in a wrist, each has an arc of its own size.
  static double apart_of(const Shot& shot, int body) {
    const Chain& chain = shot.panel.chain();
    const double near = kOnePlace * shot.panel.motion().skeleton().reach;
    int before = 0;
    for (int b = 1; b < body; ++b)
      before += chain.bodies[std::size_t(b)].joint.kind == JointKind::revolute && (pose_of(shot.ws, b).translation() - pose_of(shot.ws, body).translation()).norm() < near &&
                is_ancestor(chain, b, body);
    return 1 + kApartInWrist * before;
  }

  static bool is_ancestor(const Chain& chain, int of, int body) {
    while (body > of) body = chain.bodies[std::size_t(body)].parent;
    return body == of;
  }

  // Beside the rail, from the carriage's zero on.
  void draw_length(Picture& picture, const Shot& shot, int body, const Joint& joint) const {
    const Camera& camera = shot.panel.camera();
    const Point zero = camera.project(rail_point(shot.panel.chain(), shot.ws, body, 0));
    const Point at = camera.project(pose_of(shot.ws, body).translation());
    const Point way = camera.project_vector(pose_of(shot.ws, body).linear() * joint.axis, pose_of(shot.ws, body).translation());
    if (!is_drawable(zero) || !is_drawable(at) || !(norm(way) > 0)) return;
    Point side = normal_to(unit(way));
    // On the other side than forces.
    if (side.y > 1e-9 || (std::abs(side.y) <= 1e-9 && side.x > 0)) side = -1 * side;
    const double marks = shot.panel.marks();
    const Point shift = (marks * kBesideCarriage) * side, a = zero + shift, b = at + shift;
    const int clip = shot.panel.clip();
    const Point tick = (marks * kAngleGap) * side;
    draw_line(picture, {a - tick, a + tick}, kAngleLine, color(), clip);
    const double length = norm(b - a), head = std::min(marks * kAngleHead, length);
    if (length > 1e-6) {
      const Point along = unit(b - a);
      draw_line(picture, {a, b - 0.8 * head * along}, kAngleLine, color(), clip);
      draw_head(picture, b, along, head / kAngleHead, clip);
    }
    add_label(shot, joint, 0.5 * (a + b), side, 0.5 * (a + b));
  }

  const Stage* stage_;
};

class Limits : public Layer {
 public:
  explicit Limits(const Stage& stage) : theme_(&stage.theme) {
    for (const StagedRun& motion : stage.motions) {
      if (!is_of(motion) || !shows_drives(stage, motion)) continue;
      for (const JointKind kind : {JointKind::revolute, JointKind::prismatic})
        for_each_joint(motion.chain(), kind, [&](int body, const Joint& joint) {
          const double near = near_limit(joint);
          if (rests(motion, joint)) return;
          for (const bool is_upper : {false, true})
            for (int k = 0; near > 0 && k < motion.counted(); ++k)
              if (left_to(joint, is_upper, motion.trajectory().q_at(k)[std::size_t(joint.q_index)]) < near) {
                approached_.insert({&motion, body, is_upper});
                break;
              }
        });
    }
  }

  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw(Picture& picture, const Shot& shot) const override {
    for (const JointKind kind : {JointKind::revolute, JointKind::prismatic})
      for_each_joint(shot.panel.chain(), kind, [&](int body, const Joint& joint) {
        const double q = coordinate(shot, joint);
        for (const bool is_upper : {false, true}) {
          if (!approached_.contains({&shot.panel.motion(), body, is_upper}) || !std::isfinite(q)) continue;
          const double nearness = std::clamp(kWayToLimit - left_to(joint, is_upper, q) / near_limit(joint), 0.0, 1.0);
          const double limit = is_upper ? joint.limit.upper : joint.limit.lower, sign = is_upper ? 1 : -1;
          if (kind == JointKind::revolute && sign * (limit - q) > 0) draw_way(picture, shot, body, q, limit, nearness);
          draw_limit(picture, shot, body, kind, q, limit, sign, kFarLimit + nearness * (1 - kFarLimit));
        }
      });
  }

 private:
  // How near a run comes to a limit for that to be shown; 0 where the joint has none.
  static double near_limit(const Joint& joint) {
    const double range = joint.limit.upper - joint.limit.lower;
    if (!std::isfinite(range) || !(range > 0)) return 0;
    return joint.kind == JointKind::revolute ? std::min(kNearLimit, kNearOfRange * range) : kNearEnd * range;
  }
  // A joint that stays where it began comes near to nothing, but where its limit holds it.
  static bool rests(const StagedRun& motion, const Joint& joint) {
    constexpr double kNoWay = 1e-6;  // rad or m
    if (motion.scene().limit != LimitPolicy::report) return false;
    const auto i = std::size_t(joint.q_index);
    for (int k = 1; k < motion.counted(); ++k)
      if (!(std::abs(motion.trajectory().q_at(k)[i] - motion.trajectory().q_at(0)[i]) <= kNoWay)) return false;
    return true;
  }
  // Below zero beyond it.
  static double left_to(const Joint& joint, bool is_upper, double q) { return is_upper ? joint.limit.upper - q : q - joint.limit.lower; }

  // What is left until there.
  void draw_way(Picture& picture, const Shot& shot, int body, double q, double limit, double shown) const {
    const PageTurn turn = turn_about(shot.panel, shot.ws, body);
    if (!(shown > 0) || !is_drawable(turn.center)) return;
    const double radius = shot.panel.marks() * kLimitRadius;
    draw_arc(picture, turn, radius * grown_beside_body(shot.panel, shot.ws, body, q, radius), q, limit, kLimitWay, theme_->base.faded(shown), shot.panel.clip(),
             casing_over(shot.panel).faded(shown));
  }

  void draw_limit(Picture& picture, const Shot& shot, int body, JointKind kind, double q, double limit, double sign,
                  double shown) const {
    const Panel& panel = shot.panel;
    const double marks = panel.marks();
    const Color color = theme_->base.faded(shown), casing = casing_over(panel).faded(shown);
    if (kind == JointKind::prismatic) {
      const Point at = panel.camera().project(rail_point(panel.chain(), shot.ws, body, limit));
      const Point way = panel.camera().project_vector(
          pose_of(shot.ws, body).linear() * panel.chain().bodies[std::size_t(body)].joint.axis,
          pose_of(shot.ws, body).translation());
      if (!is_drawable(at) || !(norm(way) > 0)) return;
      const Point stop = at + (sign * panel.look().rails * size::kCarriageLength / 2) * unit(way);
      const Point half = (panel.look().rails * size::kRailGap) * normal_to(unit(way));
      draw_cased_line(picture, {stop - half, stop + half}, 1.5 * kLimitLine, color, panel.clip(), casing);
      return;
    }
    const PageTurn turn = turn_about(panel, shot.ws, body);
    if (!is_drawable(turn.center)) return;
    const double radius = marks * kLimitRadius * grown_beside_body(panel, shot.ws, body, q, marks * kLimitRadius), end = radius + marks * kLimitFrom / 2;
    draw_cased_line(picture, {turn.at(marks * kLimitFrom, limit), turn.at(end, limit)}, kLimitLine, color, panel.clip(), casing);
    draw_arc(picture, turn, radius, limit, limit + sign * kLimitArc, kLimitLine, color, panel.clip(), casing);
    for (int i = 1; i <= 4; ++i) {
      const double angle = limit + sign * kLimitArc * i / 4.5;
      draw_line(picture, {turn.at(radius, angle), turn.at(end, angle + sign * 0.12)},
                size::kGroundHatch, color, panel.clip());
    }
  }

  // Which limits a run comes near to: of a body's joint the lower or the upper one.
  struct Approached {
    const StagedRun* motion;
    int body;
    bool is_upper;
    auto operator<=>(const Approached&) const = default;
  };

  const Theme* theme_;
  std::set<Approached> approached_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_angles(const Stage& stage) {
  return std::make_unique<Angles>(stage);
}

std::unique_ptr<const Layer> make_layer_limits(const Stage& stage) {
  return std::make_unique<Limits>(stage);
}

}  // namespace chainreel

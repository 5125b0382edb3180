#include "draw/layers/marks.hpp"

#include <cmath>
#include <numbers>

#include "draw/page/sheet.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kLetterGap =
    0.008;                       // between an axis' tip and the middle of its letter's ink, less half of that
constexpr double kTick = 0.016;  // length of a cross tick
constexpr double kTickPitch = 0.010;    // between the two of z
constexpr double kShortestAxis = 0.30;  // of its length: shorter on the page, it points at the viewer or away
constexpr double kAxisRing = 0.011;         // radius
constexpr double kHeadWidth = 0.75;     // of the head's length, as arrows have it

}  // namespace

FrameAxes::FrameAxes(const Chain& chain, const Theme& theme, const Fonts& fonts, double text_scale,
                     double marks)
    : chain_(&chain), theme_(&theme), marks_(marks) {
  const char* const names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    letters_[i] = lay_out_math(fonts, names[i],
                               {Face::math, scaled(size::kTick, text_scale), theme.axis[i], Align::left});
  if (chain.end_effector < 0) return;
  const Frame& tip = chain.frames[std::size_t(chain.end_effector)];
  at_tip_ = tip.body == 0 || tip.X_BF.translation().norm() > 0;
}

std::vector<Eigen::Isometry3d> FrameAxes::poses(const Workspace& ws) const {
  std::vector<Eigen::Isometry3d> all;
  for (std::size_t b = 1; b < chain_->bodies.size(); ++b) all.push_back(pose_of(ws, int(b)));
  if (at_tip_) all.push_back(frame_pose(*chain_, ws, chain_->end_effector));
  return all;
}

double FrameAxes::reach() const {
  double letter = 0;
  for (const TextLine& line : letters_) letter = std::max({letter, line.box.width(), line.box.height()});
  return marks_ * size::kAxisLength + kLetterGap + letter;
}

void FrameAxes::draw_axis(Picture& picture, Point origin, Point v, double away, int axis, int clip,
                          MarkLabels& labels) const {
  const Color color = theme_->axis[std::size_t(axis)];
  const double width = marks_ * size::kAxisShaft;
  Point along{-std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2}, tip = origin;
  if (norm(v) < kShortestAxis * marks_ * size::kAxisLength) {
    const double r = marks_ * kAxisRing;
    picture.add(Ellipse{origin, {r, 0}, {0, r}, {theme_->background, color, width / 2}}, clip);
    if (away < 0) {
      picture.add(Ellipse{origin, {width / 2, 0}, {0, width / 2}, {color, {}, 0}}, clip);
    } else {
      const Point a = (0.7 * r) * along, b = normal_to(a);
      draw_line(picture, {origin - a, origin + a}, width / 2, color, clip);
      draw_line(picture, {origin - b, origin + b}, width / 2, color, clip);
    }
    tip = origin + r * along;
  } else {
    along = unit(v);
    tip = origin + v;
    const double head = std::min(marks_ * size::kAxisHead, 0.7 * norm(v));
    const Point base = tip - head * along, side = normal_to(along);
    draw_line(picture, {origin, base + 0.2 * head * along}, width, color, clip);
    const Point half = (kHeadWidth * head / 2) * side;
    picture.add(Polygon{{tip, base + half, base - half}, 3, {color, {}, 0}}, clip);
    for (int tick = 0; tick < axis; ++tick) {
      const Point middle =
          origin + (0.5 + 0.5 * marks_ * kTickPitch / norm(v) * (2 * tick - axis + 1)) * v;
      const Point reach = (marks_ * kTick / 2) * side;
      draw_line(picture, {middle - reach, middle + reach}, width / 2, color, clip);
    }
  }
  const TextLine& letter = letters_[std::size_t(axis)];
  const Point half{letter.box.width() / 2, letter.box.height() / 2};
  const Point middle = tip + (kLetterGap + std::abs(along.x) * half.x + std::abs(along.y) * half.y) * along;
  labels.add(letter, {middle.x - half.x, middle.y - half.y, middle.x + half.x, middle.y + half.y}, false);
}

void FrameAxes::draw(Picture& picture, const Camera& camera, const Workspace& ws, int clip,
                     MarkLabels& labels) const {
  for (const Eigen::Isometry3d& X_WF : poses(ws)) {
    const Point origin = camera.project(X_WF.translation());
    if (!std::isfinite(origin.x) || !std::isfinite(origin.y)) continue;
    const Camera seen = camera.seen_at(X_WF.translation());
    // Axes that point away from the viewer first.
    for (const bool away : {true, false}) {
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d direction = X_WF.linear().col(axis);
        const double depth = -seen.toward_viewer.dot(direction);
        if ((depth > 0) != away) continue;
        const double length = marks_ * size::kAxisLength;
        draw_axis(picture, origin, {length * seen.right.dot(direction), length * seen.up.dot(direction)},
                  depth, axis, clip, labels);
      }
    }
  }
}

Vector3d center_of_mass(const Chain& chain, const Workspace& ws) {
  Vector3d moment = Vector3d::Zero();
  double mass = 0;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Inertia& inertia = chain.bodies[b].inertia;
    moment += inertia.mass * (pose_of(ws, int(b)) * inertia.com);
    mass += inertia.mass;
  }
  if (mass > 0) moment /= mass;
  return moment;
}

}  // namespace chainreel

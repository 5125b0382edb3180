// Marks that say where something is: axes of frames and the centre of mass.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "draw/layers/layer.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"

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

// x solid, y with one cross tick, z with two, letters at the tips. An axis that points at the viewer is a ring with a
// dot, one that points away a ring with a cross.
class FrameAxes : public Layer {
 public:
  explicit FrameAxes(const Stage& stage) : theme_(&stage.theme) {
    const char* const names[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i)
      letters_[i] = lay_out_math(stage.fonts, names[i],
                                 {Face::math, scaled(size::kTick, stage.page.text_scale), theme_->axis[i], Align::left});
  }

  bool has_words() const override { return true; }

  void measure(const Sight& sight, FitBox& box) const override {
    for (const Eigen::Isometry3d& X_WF : poses(sight.motion.chain(), sight.ws))
      box.add(room_around(reach(sight.marks)), sight.camera.flat(X_WF.translation()));
  }

  bool covers(const Sight& sight, const Rect& part, bool) const override {
    for (const Eigen::Isometry3d& X_WF : poses(sight.motion.chain(), sight.ws)) {
      Point a = sight.camera.project(X_WF.translation()), b = a;
      if (cut_segment(widened(part, reach(sight.marks)), a, b)) return true;
    }
    return false;
  }

  void draw(Picture& picture, const Shot& shot) const override;

 private:
  // Every moving link has axes, and the end effector where that is elsewhere: their poses in W.
  static std::vector<Eigen::Isometry3d> poses(const Chain& chain, const Workspace& ws) {
    std::vector<Eigen::Isometry3d> all;
    for (std::size_t b = 1; b < chain.bodies.size(); ++b) all.push_back(pose_of(ws, int(b)));
    if (chain.end_effector < 0) return all;
    const Frame& tip = chain.frames[std::size_t(chain.end_effector)];
    if (tip.body == 0 || tip.X_BF.translation().norm() > 0) all.push_back(frame_pose(chain, ws, chain.end_effector));
    return all;
  }

  // How far from a frame's origin its axes and letters reach, units of H.
  double reach(double marks) const {
    double letter = 0;
    for (const TextLine& line : letters_) letter = std::max({letter, line.box.width(), line.box.height()});
    return marks * size::kAxisLength + kLetterGap + letter;
  }

  void draw_axis(Picture& picture, const Panel& panel, Point origin, Point v, double away, int axis, int frame,
                 MarkLabels& labels) const;

  const Theme* theme_;
  std::array<TextLine, 3> letters_;
};

void FrameAxes::draw_axis(Picture& picture, const Panel& panel, Point origin, Point v, double away, int axis,
                          int frame, MarkLabels& labels) const {
  const double marks = panel.marks();
  const int clip = panel.clip();
  const Color color = theme_->axis[std::size_t(axis)];
  const double width = marks * size::kAxisShaft;
  Point along{-std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2}, tip = origin;
  if (norm(v) < kShortestAxis * marks * size::kAxisLength) {
    const double r = marks * kAxisRing;
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
    const double head = std::min(marks * size::kAxisHead, 0.7 * norm(v));
    const Point base = tip - head * along, side = normal_to(along);
    draw_line(picture, {origin, base + 0.2 * head * along}, width, color, clip);
    const Point half = (kHeadWidth * head / 2) * side;
    picture.add(Polygon{{tip, base + half, base - half}, 3, {color, {}, 0}}, clip);
    for (int tick = 0; tick < axis; ++tick) {
      const Point middle =
          origin + (0.5 + 0.5 * marks * kTickPitch / norm(v) * (2 * tick - axis + 1)) * v;
      const Point reach = (marks * kTick / 2) * side;
      draw_line(picture, {middle - reach, middle + reach}, width / 2, color, clip);
    }
  }
  const TextLine& letter = letters_[std::size_t(axis)];
  MarkWord word{"axis " + std::to_string(3 * frame + axis), letter, places_about(letter, tip, kLetterGap, along)};
  word.anchor = tip;
  labels.add(std::move(word));
}

void FrameAxes::draw(Picture& picture, const Shot& shot) const {
  const Panel& panel = shot.panel;
  const double length = panel.marks() * size::kAxisLength;
  int frame = 0;
  for (const Eigen::Isometry3d& X_WF : poses(panel.chain(), shot.ws)) {
    ++frame;
    const Point origin = panel.camera().project(X_WF.translation());
    if (!std::isfinite(origin.x) || !std::isfinite(origin.y)) continue;
    const Camera seen = panel.camera().seen_at(X_WF.translation());
    // Axes that point away from the viewer first.
    for (const bool away : {true, false}) {
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d direction = X_WF.linear().col(axis);
        const double depth = -seen.toward_viewer.dot(direction);
        if ((depth > 0) != away) continue;
        draw_axis(picture, panel, origin, {length * seen.right.dot(direction), length * seen.up.dot(direction)},
                  depth, axis, frame, shot.labels);
      }
    }
  }
}

class CenterOfMass : public Layer {
 public:
  explicit CenterOfMass(const Stage& stage) : is_named_(stage.shows("legend")), ink_(stage.theme.ink) {}

  void write(SheetText& text) const override {
    if (is_named_)
      text.scales.push_back({ScaleEntry::Mark::center_of_mass, 0, ink_, "centre of mass", kAfterScales});
  }

  void measure(const Sight& sight, FitBox& box) const override {
    box.add(room_around(sight.marks * size::kCenterOfMass / 2),
            sight.camera.flat(center_of_mass(sight.motion.chain(), sight.ws)));
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    draw_center_of_mass(picture, panel.camera().project(center_of_mass(panel.chain(), shot.ws)), panel.look(),
                        panel.clip());
  }

 private:
  bool is_named_;
  Color ink_;
};

// The words of all marks, over them.
class WordsOfMarks : public Layer {
 public:
  explicit WordsOfMarks(const Stage& stage) : background_(stage.theme.background) {}

  UnderWords under_words() const override { return UnderWords::freely; }

  void draw(Picture& picture, const Shot& shot) const override {
    shot.labels.draw(picture, shot.panel.area(), background_, shot.panel.clip());
  }

 private:
  Color background_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_frames(const Stage& stage) {
  return std::make_unique<FrameAxes>(stage);
}

std::unique_ptr<const Layer> make_layer_com(const Stage& stage) {
  return std::make_unique<CenterOfMass>(stage);
}

std::unique_ptr<const Layer> make_layer_mark_labels(const Stage& stage) {
  return std::make_unique<WordsOfMarks>(stage);
}

}  // namespace chainreel

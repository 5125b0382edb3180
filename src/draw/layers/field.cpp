// The layer `g`: which way gravity acts, as a small arrow beside the motion. In the first panel alone: all share it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "draw/layers/layer.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/word_plan.hpp"
#include "draw/robot/chain_fit.hpp"
#include "picture/point.hpp"

namespace chainreel {

std::unique_ptr<const Layer> make_layer_ellipse_inside(const Stage& stage);
std::unique_ptr<const Layer> make_layer_joint_springs(const Stage& stage);
std::unique_ptr<const Layer> make_layer_slider_springs(const Stage& stage);

namespace {

using Eigen::Vector3d;

constexpr double kFieldArrow = 0.072, kFieldBeside = 0.045, kFieldGap = 0.012;  // units of H
constexpr double kFieldSize = 0.8;        // of other arrows' heads and shafts
constexpr double kFieldAir = 0.012;       // units of H, around the arrow and its letter
constexpr double kSeenLeast = 0.2;        // of gravity across the view: along it there is nothing to see
constexpr int kFieldLooks = 120;          // of a clip, at which the place must be free
constexpr int kOnEllipse = 48;            // places on an ellipse at which it is looked at

bool lies_in(const Rect& part, Point p) { return p.x > part.x0 && p.x < part.x1 && p.y > part.y0 && p.y < part.y1; }

// Whether ellipses, and the bands that open ones are, come into this part of the page.
struct MeetsPart {
  const Rect& part;

  bool operator()(const Ellipse& e) const {
    const Point d = center_of(part) - e.center;
    const double u = dot(e.u, e.u), v = dot(e.v, e.v);
    if (u > 0 && v > 0 && std::hypot(dot(d, e.u) / u, dot(d, e.v) / v) < 1) return true;
    for (int i = 0; i < kOnEllipse; ++i) {
      const double angle = 2 * std::numbers::pi * i / kOnEllipse;
      if (lies_in(part, e.center + std::cos(angle) * e.u + std::sin(angle) * e.v)) return true;
    }
    return false;
  }
  bool operator()(const Polygon& p) const {
    bool left = true, right = true;
    for (int i = 0; i < p.count; ++i) {
      Point a = p.corners[std::size_t(i)], b = p.corners[std::size_t((i + 1) % p.count)];
      const double side = cross(b - a, center_of(part) - a);
      left = left && side > 0;
      right = right && side < 0;
      if (cut_segment(part, a, b)) return true;
    }
    return left || right;
  }
  template <class Other>
  bool operator()(const Other&) const { return false; }
};

class Field : public Layer {
 public:
  explicit Field(const Stage& stage)
      : stage_(&stage),
        text_(lay_out_math(stage.fonts, "g",
                           {Face::math, scaled(size::kAxis, stage.page.text_scale), stage.theme.force, Align::left})) {
    if (stage.shows("ellipse")) ellipse_ = make_layer_ellipse_inside(stage);
    if (!stage.shows("springs")) return;
    springs_.push_back(make_layer_slider_springs(stage));
    springs_.push_back(make_layer_joint_springs(stage));
  }

  void draw_once(Picture& picture, const Panel& panel) const override {
    const Vector3d g = panel.chain().gravity;
    if (!(g.norm() > 0) || !stands_in(panel)) return;
    const Camera& camera = panel.camera();
    const Point seen{camera.right.dot(g) / g.norm(), camera.up.dot(g) / g.norm()};
    if (norm(seen) < kSeenLeast) return;
    const double marks = panel.marks();
    const Point v = (marks * kFieldArrow) * seen;
    // The letter stands beside the arrow, to its right.
    Point side = normal_to(unit(v));
    if (side.x < 0 || (side.x == 0 && side.y < 0)) side = -1 * side;
    const double half_width = text_.box.width() / 2, half_height = text_.box.height() / 2;
    const double off = kFieldGap + std::abs(side.x) * half_width + std::abs(side.y) * half_height;
    const Point letter = 0.5 * v + off * side;
    const double head = marks * kFieldSize * size::kArrowHeadWidth / 2;
    const Rect ink = around({std::min(0.0, v.x) - head, std::min(0.0, v.y) - head, std::max(0.0, v.x) + head,
                             std::max(0.0, v.y) + head},
                            {letter.x - half_width, letter.y - half_height, letter.x + half_width, letter.y + half_height});
    const std::optional<Point> tail = free_place(panel, ink);
    if (!tail) return;
    draw_arrow(picture, *tail, v, {stage_->theme.force, marks * kFieldSize, false, 0, stage_->theme.lines}, panel.clip());
    const Point middle{(text_.box.x0 + text_.box.x1) / 2, (text_.box.y0 + text_.box.y1) / 2};
    draw_text(picture, text_, *tail + letter - middle, panel.clip());
  }

 private:
  // One arrow stands for all panels that have its gravity; where they differ each has its own, and chains that lie over one another none.
  bool stands_in(const Panel& panel) const {
    const Vector3d& first = stage_->motions.front().chain().gravity;
    const bool is_one = std::ranges::all_of(stage_->motions, [&](const StagedRun& motion) { return motion.chain().gravity == first; });
    return is_one ? &panel.motion() == &stage_->motions.front() : !stage_->is_ghost();
  }

  // Where the arrow begins, so that no pose and no spring comes near `ink` about there: beside the motion, on a level with its upper part,
  // else in a corner of the panel; off ellipses, if it can; nothing where the motion fills it all.
  std::optional<Point> free_place(const Panel& panel, const Rect& ink) const {
    const Rect& area = panel.area();
    const Rect motion = extent_of_motion(panel);
    const double top = std::min(motion.y1, area.y1 - kFieldAir) - ink.y1, middle = (motion.y0 + motion.y1) / 2 - (ink.y0 + ink.y1) / 2;
    const double left = motion.x0 - kFieldBeside - ink.x1, right = motion.x1 + kFieldBeside - ink.x0;
    const double first = area.x0 + kFieldAir - ink.x0, last = area.x1 - kFieldAir - ink.x1;
    const double high = area.y1 - kFieldAir - ink.y1, low = area.y0 + kFieldAir - ink.y0;
    const std::array<Point, 8> places{{{left, top}, {right, top}, {left, middle}, {right, middle},
                                       {first, high}, {last, high}, {last, low}, {first, low}}};
    std::optional<Point> beside_chain;
    for (const Point& place : places) {
      const Rect covered{place.x + ink.x0, place.y + ink.y0, place.x + ink.x1, place.y + ink.y1};
      if (!holds(area, widened(covered, kFieldAir / 2)) || !is_free(panel, widened(covered, kFieldAir))) continue;
      if (!meets_ellipse(panel, widened(covered, kFieldAir))) return place;
      if (!beside_chain) beside_chain = place;
    }
    return beside_chain;
  }

  bool meets_ellipse(const Panel& panel, const Rect& part) const {
    for (int i = 0; ellipse_ && i < looks(panel); ++i) {
      const int k = look_at(panel, i);
      Picture picture;
      MarkLabels labels;
      ellipse_->draw(picture, {panel, panel.motion().pose_at(k), k, false, {}, labels});
      for (const Item& item : picture.items)
        if (std::visit(MeetsPart{part}, item.shape)) return true;
    }
    return false;
  }

  static int looks(const Panel& panel) { return std::min(panel.last() + 1, kFieldLooks); }
  static int look_at(const Panel& panel, int i) { return int(std::int64_t(i) * (panel.last() + 1) / looks(panel)); }

  static Rect extent_of_motion(const Panel& panel) {
    std::optional<Rect> extent;
    const auto add = [&](const Vector3d& place, double about = 0) {
      const Point p = panel.camera().project(place);
      if (!is_drawable(p)) return;
      const Rect point{p.x - about, p.y - about, p.x + about, p.y + about};
      extent = extent ? around(*extent, point) : point;
    };
    for (int i = 0; i < looks(panel); ++i) {
      const Workspace& ws = panel.motion().pose_at(look_at(panel, i));
      const Skeleton& skeleton = panel.motion().skeleton();
      for (const LinkSegment& link : skeleton.links) {
        add(pose_of(ws, link.body) * link.from);
        add(pose_of(ws, link.body) * link.to);
      }
      for (const Rail& rail : skeleton.rails) {
        add(rail_point(panel.chain(), ws, rail.body, rail.lower), rail_overhang(rail.carrier));
        add(rail_point(panel.chain(), ws, rail.body, rail.upper), rail_overhang(rail.carrier));
      }
      for (std::size_t b = 1; b < panel.chain().bodies.size(); ++b) add(pose_of(ws, int(b)).translation());
    }
    return extent.value_or(panel.area());
  }

  bool is_free(const Panel& panel, const Rect& part) const {
    if (panel.room() && overlap(part, *panel.room())) return false;
    for (int i = 0; i < looks(panel); ++i) {
      const int k = look_at(panel, i);
      const Workspace& ws = panel.motion().pose_at(k);
      if (chainreel::covers(panel.chain(), panel.motion().skeleton(), panel.motion().shapes(), ws, panel.camera(), part)) return false;
      Picture springs;
      MarkLabels labels;
      for (const auto& layer : springs_) layer->draw(springs, {panel, ws, k, false, {}, labels});
      if (lies_on(part, obstacles_of(springs))) return false;
    }
    return true;
  }

  const Stage* stage_;
  TextLine text_;
  std::unique_ptr<const Layer> ellipse_;  // null: none is shown
  Layers springs_;                        // of sliders and of joints; empty: none are shown
};

}  // namespace

std::unique_ptr<const Layer> make_layer_g(const Stage& stage) {
  return std::make_unique<Field>(stage);
}

}  // namespace chainreel

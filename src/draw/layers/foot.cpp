// A foot on the ground and what the ground answers: an arrow that ends at the centre of pressure, which is marked, as long as
// the force. It stands below the ground, along the line on which the force acts, where no leg hides it. The force that presses never
// leaves the foot. Where it would have to, no centre of pressure is marked, and the foot is held by a pull at its other end, which is a dashed arrow with words that it does so,
// and that a real foot would tip. A plumb line from the centre of mass shows where that stands beside the foot.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/format.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/joints.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

constexpr double kWeightArrow = 0.09;  // units of H: as long is the force that bears the weight, which the robot stands above
constexpr double kBesideOthers = 0.8;  // ... of that, where panels or plots share the page: the robot is what one looks at
constexpr double kMostRoom = 1.5;      // weights: the camera holds arrows of so much, longer ones are no longer and have a break
constexpr double kBrokenOver = 0.1;    // weights beyond that, over which the break opens
constexpr double kDepths[] = {0.05, 0.08, 0.12};  // units of H, below the ground: of words that the foot is held
constexpr double kBesideArrow = 0.03;  // units of H
constexpr double kShortestTie = 0.01;  // ... of a line from there to the words
constexpr double kPressure = 0.0075;   // units of H: radius of the centre of pressure
constexpr double kCrowdedBeyond = 1.3;  // text_scale: that of pages of less than 320 rows of pixels
constexpr double kPlumbLine = 0.0025;  // units of H

// A run's foot, and what the ground answers at its samples.
struct FootRun {
  explicit FootRun(const StagedRun& motion);
  const FootHold& answer(int k) const { return answers[std::size_t(std::clamp(k, 0, int(answers.size()) - 1))]; }
  Eigen::Vector3d on_ground(double place) const { return place * ground.along + foot.height * ground.up; }

  double weight = 0;  // N
  Foot foot;
  GroundAxes ground;
  std::vector<Eigen::Vector3d> ankles;  // joints on the world
  std::vector<FootHold> answers;        // a sample; forces in weights
  int held_from = std::numeric_limits<int>::max();  // the sample: a real foot turns from there on
};

FootRun::FootRun(const StagedRun& motion)
    : weight(mass_of(motion.chain()) * motion.chain().gravity.norm()),
      foot(*motion.simulation()->events->foot),
      ground(motion.simulation()->events->ground) {
  const Chain& chain = motion.chain();
  const Trajectory& trajectory = motion.trajectory();
  for (const Body& body : chain.bodies)
    if (&body != &chain.bodies[0] && body.parent == 0) ankles.push_back(body.joint.X_PJ.translation());
  Workspace ws(chain);
  ChainSystem system(*motion.simulation());
  std::vector<double> qdd(std::size_t(chain.nv));
  for (int k = 0; k < motion.samples(); ++k) {
    const auto q = trajectory.q_at(k), qd = trajectory.qd_at(k);
    const double t = trajectory.t[std::size_t(k)];
    hold_as_then(system, *motion.simulation(), trajectory, t);
    const GroundLoad load = ground_load(system, ws, ground, foot.height, t, q, qd, qdd);
    if (!bears(load, foot)) held_from = std::min(held_from, k);
    FootHold hold = hold_of(load, foot, ground);
    hold.force /= weight;
    hold.pull /= weight;
    answers.push_back(hold);
  }
  motion.simulation()->torque->leave_pieces();
}

// The line through two places from one side of a part of the page to the other; from left to right.
PageLine across(const Rect& area, Point a, Point b) {
  if (a.x > b.x) std::swap(a, b);
  const Point along = unit(b - a);
  if (!(along.x > 0.1)) return {a, b};
  return {a + ((area.x0 - a.x) / along.x) * along, a + ((area.x1 - a.x) / along.x) * along};
}

class FootLayer : public Layer {
 public:
  explicit FootLayer(const Stage& stage)
      : theme_(&stage.theme),
        page_(&stage.page),
        held_(words(stage, "holds the foot: a real one would tip")),
        tips_(words(stage, "a real foot would tip")),
        short_(words(stage, "holds the foot")),
        turned_(words(stage, "a real foot has tipped")),
        names_center_(stage.shows("com") && stage.shows("legend")),
        arrow_(kWeightArrow * (stage.has_cells() || !stage.page.plot.empty() ? kBesideOthers : 1)) {
    for (const StagedRun& motion : stage.motions)
      if (is_of(motion) && motion.has_foot()) runs_.emplace(&motion, motion);
    const auto first = runs_.find(&stage.motions.front());
    if (first != runs_.end()) weight_ = first->second.weight;
  }

  bool has_words() const override { return !runs_.empty(); }

  void write(SheetText& text) const override {
    constexpr double kDashedInLegend = 0.06;  // units of H: two dashes and a head; its entry has no number, which would be a scale
    constexpr double kLegend = 0.045;  // units of H, at most
    if (!weight_) return;
    // On few pixels words take more than what they speak of: marks that are known, or named in the scene, have none below it.
    const bool is_crowded = !(page_->video.least_text > 0) && page_->text_scale > kCrowdedBeyond;
    if (!names_center_ && !is_crowded) text.scales.push_back({ScaleEntry::Mark::center_of_mass, 0, theme_->ink, "centre of mass", kAfterVectors});
    const double force = round_length(kLegend / arrow_ * *weight_);
    text.scales.push_back({ScaleEntry::Mark::arrow, arrow_ * force / *weight_, theme_->constraint,
                           "ground reaction " + format_shortest(force) + " N", kAfterScales});
    text.scales.push_back({ScaleEntry::Mark::disc, 2 * kPressure, theme_->constraint, "centre of pressure", kAfterScales + 1});
    const bool is_pulled = std::ranges::any_of(runs_, [](const auto& one) { return std::ranges::any_of(one.second.answers, [](const FootHold& hold) { return hold.pull > 0; }); });
    if (is_pulled && !is_crowded) text.scales.push_back({ScaleEntry::Mark::dashed_arrow, kDashedInLegend, theme_->constraint, "holds the foot", kAfterScales + 2});
  }

  void measure(const Sight& sight, FitBox& box) const override {
    const auto known = runs_.find(&sight.motion);
    if (known == runs_.end()) return;
    const FootRun& run = known->second;
    const FootHold& hold = run.answer(sight.k);
    const auto hold_below = [&](double place, double weights) {
      Room below{0, 0, arrow_ * std::min(kMostRoom, weights), 0};
      below.in_margin = true;  // the robot is as large as without them
      box.add(below, sight.camera.flat(run.on_ground(place)));
    };
    hold_below(hold.place, hold.force.dot(run.ground.up));
    if (hold.pull > 0) hold_below(hold.pull_place, hold.pull);
  }

  void draw_once(Picture& picture, const Panel& panel) const override {
    const auto known = runs_.find(&panel.motion());
    if (known == runs_.end()) return;
    const FootRun& run = known->second;
    const ChainLook& look = panel.look();
    const auto at = [&](double place) { return panel.camera().project(run.on_ground(place)); };
    const Point heel = at(run.foot.heel), toe = at(run.foot.toe);
    draw_ground(picture, across(panel.area(), heel, toe), {0, -1}, look, panel.clip());
    const Paint paint{tinted(look.theme->base, 0.35, look), toned(look.theme->base, look), size::kLinkOutline};
    for (const Eigen::Vector3d& ankle : run.ankles)
      picture.add(Polygon{{heel, toe, panel.camera().project(ankle)}, 3, paint}, panel.clip());
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    const auto known = runs_.find(&panel.motion());
    if (known == runs_.end()) return;
    const FootRun& run = known->second;
    const FootHold& hold = run.answer(shot.k);
    draw_plumb_line(picture, run, shot);
    if (shot.k >= run.held_from && !is_transparent(*page_)) add_held(run, panel.camera(), hold, shot.labels);
    const ChainLook& look = panel.look();
    ArrowStyle style{look.theme->constraint, look.marks, false, 0, look.theme->lines, look.theme->background};
    const Point pressure = panel.camera().project(run.on_ground(hold.place)), force = on_page(hold.force, panel.camera());
    style.broken = broken(hold.force.norm());
    draw_arrow(picture, pressure - force, force, style, panel.clip());
    if (hold.pull == 0 && hold.force.dot(run.ground.up) > 0) {
      const double radius = look.marks * kPressure;
      picture.add(Ellipse{pressure, {radius, 0}, {0, radius}, {look.theme->constraint, look.theme->constraint, size::kLinkOutline}}, panel.clip());
    }
    style.dashed = true;
    style.broken = broken(hold.pull);
    draw_arrow(picture, panel.camera().project(run.on_ground(hold.pull_place)), pull_on_page(run, hold, panel.camera()), style, panel.clip());
  }

 private:
  static TextLine words(const Stage& stage, const char* text) {
    return lay_out_text(stage.fonts, text, {Face::label, scaled(size::kAxis, stage.page.text_scale), stage.theme.muted, Align::left});
  }

  static void draw_plumb_line(Picture& picture, const FootRun& run, const Shot& shot) {
    const Panel& panel = shot.panel;
    const Eigen::Vector3d center = center_of_mass(panel.chain(), shot.ws);
    const Eigen::Vector3d below = center - (center.dot(run.ground.up) - run.foot.height) * run.ground.up;
    const ChainLook& look = panel.look();
    draw_dashed_line(picture, {panel.camera().project(center), panel.camera().project(below)}, look.marks * kPlumbLine, look.theme->ink, panel.clip());
  }

  static double broken(double weights) { return std::clamp((weights - kMostRoom) / kBrokenOver, 0.0, 1.0); }
  Point on_page(const Eigen::Vector3d& weights, const Camera& camera) const {
    const double size = weights.norm(), drawn = size > kMostRoom ? kMostRoom / size : 1;
    return (arrow_ * drawn / camera.scale) * camera.project_vector(weights, camera.focus);
  }
  Point pull_on_page(const FootRun& run, const FootHold& hold, const Camera& camera) const { return on_page(-hold.pull * run.ground.up, camera); }

  // Below the ground, beside the pull that holds the foot, away from where it presses, with a line to it. Where none does any more a real foot has turned all the same.
  void add_held(const FootRun& run, const Camera& camera, const FootHold& hold, MarkLabels& labels) const {
    const bool is_pulled = hold.pull > 0;
    const double from = is_pulled ? hold.pull_place : run.foot.heel;
    const Point pulled = camera.project(run.on_ground(from)), away = pulled - camera.project(run.on_ground((run.foot.heel + run.foot.toe) / 2));
    const TextLine& line = is_pulled ? held_ : turned_;
    std::vector<Rect> places;
    const Point pressed = camera.project(run.on_ground(hold.place)), force = on_page(hold.force, camera);
    const auto add_below = [&](const TextLine& words) {
      const Point half{words.box.width() / 2, words.box.height() / 2};
      for (const double depth : kDepths)
        for (const double side : {std::copysign(1.0, away.x), -std::copysign(1.0, away.x)}) {
          const Point center = pulled + Point{side * (half.x + kBesideArrow), -depth};
          places.push_back({center.x - half.x, center.y - half.y, center.x + half.x, center.y + half.y});
        }
      // Else beyond the arrow of what presses, which may be long.
      const double right = std::max({pulled.x, pressed.x, pressed.x - force.x}) + kBesideArrow + half.x;
      for (const double depth : kDepths) places.push_back({right - half.x, pulled.y - depth - half.y, right + half.x, pulled.y - depth + half.y});
    };
    add_below(line);
    // Where there is no room for all, what of it matters most.
    std::vector<TextLine> shorter{tips_};
    if (is_pulled) shorter.push_back(short_);
    for (const TextLine& words : shorter) add_below(words);
    const Point middle = pulled + 0.5 * pull_on_page(run, hold, camera);
    labels.add({"foot held", line, std::move(places), {}, Tie{middle, kBesideArrow / 2, theme_->muted, {}, kShortestTie}, std::move(shorter)});
  }

  const Theme* theme_;
  const Scene* page_;
  TextLine held_, tips_, short_, turned_;
  bool names_center_;  // another layer does
  double arrow_;  // units of H: the weight's
  std::map<const StagedRun*, FootRun> runs_;
  std::optional<double> weight_;  // N, of the first run
};

// Where the plumb line begins: over arcs and arrows, which the line lies below.
class CenterOverFoot : public Layer {
 public:
  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    if (panel.motion().has_foot()) draw_center_of_mass(picture, panel.camera().project(center_of_mass(panel.chain(), shot.ws)), panel.look(), panel.clip());
  }
};

}  // namespace

std::unique_ptr<const Layer> make_layer_foot(const Stage& stage) {
  return std::make_unique<FootLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_center_over_foot(const Stage&) {
  return std::make_unique<CenterOverFoot>();
}

}  // namespace chainreel

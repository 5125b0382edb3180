// What counts as a fall, where that is a height: of an event of kind `fall` which says that a frame is lower than so much there is a dashed
// line at that height, as far as the frame goes, with the event's name until that happens, and a ring at the frame, so that one sees the two meet.
#include <algorithm>
#include <cmath>
#include <map>

#include "draw/layers/layer.hpp"
#include "draw/page/wrapped_words.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"
#include "expr/affine.hpp"

namespace chainreel {
namespace {

constexpr double kLevelLine = 0.0025;    // units of H
constexpr double kBeyondFrame = 0.04;    // ... that the line goes on beyond the places of the frame
constexpr double kLevelRing = 0.0085, kLevelRim = 0.0035;  // ... of the frame: radius, and the line around it
constexpr double kLevelGap = 0.012;      // ... from the line to its words
constexpr double kWrapped = 0.6;         // of the width of its words, which a level has room for in any case
constexpr double kUpright = 1e-9;        // an axis of the world is up to rounding

// A height that a frame falls below.
struct FallLevel {
  const Event* event = nullptr;
  int frame = 0;
  double height = 0;  // m against gravity, from the world's origin
  Eigen::Vector3d along = Eigen::Vector3d::Zero(), up = along;
};

// Nothing of events that say more than that, or another thing.
std::optional<FallLevel> level_of(const Chain& chain, const EventSet& events, const Event& event) {
  const std::vector<int>& used = event.value.used_variables();
  if (event.kind != EventKind::fall || !chain.planar || chain.has_floating || used.size() != 1) return {};
  const int slot = used.front();
  if (!events.probe.is_kinematic(slot) || events.probe.is_velocity(slot)) return {};
  std::vector<VariableUse> uses(events.probe.names().size());
  uses[std::size_t(slot)].role = VariableRole::linear;
  const auto form = affine_form_of<double>(event.value, uses);
  if (!form) return {};
  const double weight = form->weights[std::size_t(slot)];
  const bool is_below = event.test == Event::Test::below || event.test == Event::Test::at_or_below;
  const bool is_above = event.test == Event::Test::above || event.test == Event::Test::at_or_above;
  if (!(is_below && weight > 0) && !(is_above && weight < 0)) return {};
  if (!(chain.gravity.norm() > 0)) return {};
  FallLevel level{&event, events.probe.frame_of(chain, slot), -form->powers.front() / weight, {}, -chain.gravity.normalized()};
  level.along = chain.planar->plane.normal.cross(level.up);
  const bool is_height = level.up[events.probe.axis_of(slot)] > 1 - kUpright && level.along.norm() > 1 - kUpright;
  return is_height ? std::optional(level) : std::nullopt;
}

class FallLevelLayer : public Layer {
 public:
  explicit FallLevelLayer(const Stage& stage) : theme_(&stage.theme) {
    for (const StagedRun& motion : stage.motions) {
      if (!is_of(motion) || !motion.simulation() || !motion.simulation()->events) continue;
      const EventSet& events = *motion.simulation()->events;
      for (const Event& event : events.list) {
        const auto level = level_of(motion.chain(), events, event);
        if (!level) continue;
        runs_.emplace(&motion, Shown{*level, way_of(motion, *level), words_of(stage, event, 1), words_of(stage, event, kWrapped)});
        break;
      }
    }
  }

  bool has_words() const override { return !runs_.empty(); }

  void measure(const Sight& sight, FitBox& box) const override {
    const auto known = runs_.find(&sight.motion);
    if (known == runs_.end()) return;
    const FallLevel& level = known->second.level;
    const double along = place(sight.motion.chain(), sight.ws, level).dot(level.along);
    box.add({kBeyondFrame, kBeyondFrame, 0, 0}, sight.camera.flat(on_level(level, along)));
  }

  // Its words stand behind the end of the line.
  void wish(const Sight& sight, FitBox& box) const override {
    const auto known = runs_.find(&sight.motion);
    if (known == runs_.end()) return;
    const auto& [level, way, words, wrapped] = known->second;
    const Point a = sight.camera.flat(on_level(level, way.first)), b = sight.camera.flat(on_level(level, way.second));
    box.add({0, kBeyondFrame + kLevelGap + wrapped.box.width(), wrapped.box.height(), wrapped.box.height()}, a.x > b.x ? a : b);
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    const auto known = runs_.find(&panel.motion());
    if (known == runs_.end()) return;
    const auto& [level, way, words, wrapped] = known->second;
    Point a = panel.camera().project(on_level(level, way.first)), b = panel.camera().project(on_level(level, way.second));
    if (a.x > b.x) std::swap(a, b);
    const Point beyond = kBeyondFrame * (norm(b - a) > 0 ? unit(b - a) : Point{1, 0});
    const PageLine line{a - beyond, b + beyond};
    draw_dashed_line(picture, line, panel.look().marks * kLevelLine, theme_->muted, panel.clip());
    const double radius = panel.look().marks * kLevelRing;
    picture.add(Ellipse{panel.camera().project(place(panel.chain(), shot.ws, level)), {radius, 0}, {0, radius}, {theme_->background, theme_->ink, panel.look().marks * kLevelRim}},
                panel.clip());
    if (is_noted(panel, level, shot.k)) return;
    std::vector<Rect> places;
    for (const TextLine* shape : {&words, &wrapped}) {
      places.push_back(place_beyond(*shape, line.b, kLevelGap, {1, 0}));
      places.push_back(place_beyond(*shape, line.a, kLevelGap, {-1, 0}));
      // Else below it or above it, where what falls has come to its height.
      for (const double end : {1.0, -1.0})
        for (const double side : {-1.0, 1.0}) {
          const Point half{shape->box.width() / 2, shape->box.height() / 2};
          const Point middle = (end > 0 ? line.b : line.a) + Point{end * (half.x + kLevelGap), side * (half.y + kLevelGap)};
          places.push_back({middle.x - half.x, middle.y - half.y, middle.x + half.x, middle.y + half.y});
        }
    }
    shot.labels.add({"fall level", words, std::move(places), {}, {}, {wrapped}});
  }

 private:
  struct Shown {
    FallLevel level;
    std::pair<double, double> way;  // m along the ground, between which the frame is
    TextLine words, wrapped;  // where there is no room for one line
  };

  // From the instant on the note below the scene says the name.
  static bool is_noted(const Panel& panel, const FallLevel& level, int k) {
    const Trajectory& run = panel.motion().trajectory();
    const auto place = std::size_t(level.event - panel.motion().simulation()->events->list.data());
    for (std::size_t hit = 0; hit < run.events.t.size(); ++hit)
      if (std::size_t(run.events.event[hit]) == place && (k >= run.size() || run.events.t[hit] <= run.t[std::size_t(k)])) return true;
    return false;
  }

  static Eigen::Vector3d place(const Chain& chain, const Workspace& ws, const FallLevel& level) {
    return frame_pose(chain, ws, level.frame).translation();
  }

  // In the plane in which the world's origin lies, as the ground of a foot.
  static Eigen::Vector3d on_level(const FallLevel& level, double along) { return along * level.along + level.height * level.up; }

  static std::pair<double, double> way_of(const StagedRun& motion, const FallLevel& level) {
    std::pair<double, double> way{HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < motion.counted(); ++k) {
      const double along = place(motion.chain(), motion.pose_at(k), level).dot(level.along);
      way = {std::min(way.first, along), std::max(way.second, along)};
    }
    return way;
  }

  static TextLine words_of(const Stage& stage, const Event& event, double share) {
    const TextStyle style{Face::label, scaled(size::kTick, stage.page.text_scale), stage.theme.muted, Align::left};
    return lay_out_within(stage.fonts, event.name, style, share * lay_out_words(stage.fonts, event.name, style).advance);
  }

  const Theme* theme_;
  std::map<const StagedRun*, Shown> runs_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_fall_level(const Stage& stage) {
  return std::make_unique<FallLevelLayer>(stage);
}

}  // namespace chainreel

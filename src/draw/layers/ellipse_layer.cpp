// The layers `ellipse`: the effective mass of the end effector along a run, at one scale for the whole film.
// Its inside lies below the chain, its lines over it.
#include <algorithm>
#include <cmath>
#include <map>

#include "draw/layers/cut_numbers.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/layers/ellipsoid.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/scales.hpp"
#include "draw/robot/view.hpp"
#include "sim/instant.hpp"

namespace chainreel {
namespace {

constexpr double kEllipseBar = 0.10;  // units of H: the bounded semi-axis measures about as much
constexpr double kSolidAxis = 0.25;   // ... of an ellipsoid, which is to be read in space
constexpr double kLongAxis = 0.30;    // ... at most, of the long semi-axes at most ordinary poses
constexpr double kRoomStep = 0.005;   // units of H: rooms are rounded up, lest the fit have one a frame
constexpr double kMuchRounder = 1.5;  // in the ratio of its axes: then the other pose is worth a ghost
constexpr double kGhost = 0.25;       // opacity of that pose
constexpr double kGhostLine = 0.45;   // ... and of its lines

// How the mass is felt at the samples of the runs that are shown in full.
class MassAlong {
 public:
  explicit MassAlong(const Stage& stage)
      : stage_(&stage),
        reading_(stage.page.ellipse.reading),
        is_section_(stage.page.ellipse.shape == EllipseShape::section) {
    for (const StagedRun& motion : stage.motions)
      if (!motion.is_outlined()) masses_.emplace(&motion, motion);
    for (const auto& [motion, mass] : masses_)
      for (const int k : some_of(motion->samples())) some_axes_[{motion, k}] = axes_at(*motion, k);
    const double share = stage.share_of_lengths();
    scale_ = body() == EllipseBody::solid ? solid_scale(share * kSolidAxis)
                                          : ellipse_scale(bounded_semi_axes(), share * kEllipseBar, reading_);
    scale_ = bounded_scale(scale_, ordinary_long_axes(), share * kLongAxis);
  }

  const EllipseScale& scale() const { return scale_; }
  EllipseReading reading() const { return reading_; }
  EllipseBody body() const {
    return stage_->motions.front().chain().planar ? EllipseBody::flat
           : is_section_                          ? EllipseBody::section
                                                  : EllipseBody::solid;
  }

  std::vector<MassAxis> axes_at(const StagedRun& motion, int k) const {
    const Mass& along = masses_.at(&motion);
    const EffectiveMass effective = along.mass.at(*along.ws, motion.trajectory().q_at(k));
    if (!is_section_) return mass_axes(effective);
    return section_axes(effective, tip_plane(motion.chain(), motion.pose_at(k)), reading_);
  }

  // What the curve takes around the end effector at this sample, of those that decide on the scale.
  std::optional<Room> room_at(const Sight& sight, const Eigen::Vector3d& tip) const {
    const auto known = some_axes_.find({&sight.motion, sight.k});
    if (known == some_axes_.end()) return std::nullopt;
    const Room exact = room_of(known->second, sight.camera.seen_at(tip), scale_, stage_->share_of_lengths() * kLongAxis);
    const double x = std::ceil(exact.right / kRoomStep) * kRoomStep, y = std::ceil(exact.up / kRoomStep) * kRoomStep;
    return Room{x, x, y, y, -1, 0, true};
  }

  void draw(Picture& picture, const Panel& panel, int k, EllipseStyle style) const {
    const Workspace& ws = panel.motion().pose_at(k);
    const Eigen::Vector3d tip = tip_position(panel.chain(), ws);
    if (has_body_shapes(panel)) style.hides = robot_hides(*panel.motion().shapes(), ws, panel.camera(), tip);
    style.outward = last_link(panel.motion().skeleton(), ws, panel.camera());
    const std::vector<MassAxis> axes = axes_at(panel.motion(), k);
    if (has_plot_of_axes()) name_axes(style, axes);
    draw_mass_ellipse(picture, axes, panel.tip().place(k), panel.camera().seen_at(tip),
                      style, panel.clip());
  }

  // What the film says at each frame of each of the axes.
  std::vector<std::vector<CutNumber>> cut_numbers(const Panel& panel, EllipseStyle style) const {
    std::vector<std::vector<CutLength>> lengths;
    const auto frames = std::size_t(panel.last() + 1);
    for (std::size_t k = 0; k < frames && !has_body_shapes(panel); ++k) {
      const Workspace& ws = panel.motion().pose_at(int(k));
      const Camera seen = panel.camera().seen_at(tip_position(panel.chain(), ws));
      style.outward = last_link(panel.motion().skeleton(), ws, panel.camera());
      const std::vector<CutLength> now = cut_lengths(axes_at(panel.motion(), int(k)), panel.tip().place(int(k)), seen, style);
      lengths.resize(std::max(lengths.size(), now.size()), std::vector<CutLength>(frames));
      for (std::size_t i = 0; i < now.size(); ++i) lengths[i][k] = now[i];
    }
    std::vector<std::vector<CutNumber>> numbers;
    for (const std::vector<CutLength>& axis : lengths) numbers.push_back(numbers_along(axis, stage_->page.video.fps.value(), kFarOut / style.per_unit));
    return numbers;
  }

  EllipseStyle style_in(const Panel& panel, EllipsePart part) const {
    EllipseStyle style{&stage_->theme,    &stage_->fonts, stage_->page.text_scale,
                       scale_.per_unit(), panel.area(),   reading_};
    style.part = part;
    style.lines = panel.marks() * stage_->theme.lines;
    if (!panel.motion().shapes()) style.hole = link_end(panel.look());
    return style;
  }

 private:
  // Curves of these axes stand on the page: those that the scene names, or those that layout `auto` chose, whose page has a place for plots.
  bool has_plot_of_axes() const {
    const Scene& page = stage_->page;
    // Of the page's width, of an em: on smaller pages numbers have no room for names. And px, of an em, below which their indices are too faint.
    constexpr double kRoomForNames = 0.016, kIndicesSeen = 20;
    const double em = scaled(size::kTick, page.text_scale);
    if (stage_->is_comparison() || is_section_ || em > kRoomForNames * page.video.width / page.video.height || em * page.video.height < kIndicesSeen) return false;
    if (page.plot.empty()) return page.layout == PageLayout::scene_right || page.layout == PageLayout::scene_below;
    const auto quantity = to_string(reading_ == EllipseReading::energy ? PlotQuantity::energy_speed : PlotQuantity::effective_mass);
    return std::ranges::any_of(page.plot, [&](const auto& entry) { return entry.value == quantity; });
  }

  // As the curves are named: from the longest on.
  void name_axes(EllipseStyle& style, const std::vector<MassAxis>& axes) const {
    const std::string symbol = reading_ == EllipseReading::energy ? "v_" : "Lambda_";
    for (const MassAxis& axis : axes) style.lengths.push_back(semi_axis(axis, reading_).value_or(HUGE_VAL));
    std::ranges::sort(style.lengths, std::ranges::greater{});
    for (std::size_t i = 0; i < axes.size(); ++i) style.names.push_back(symbol + std::to_string(i + 1));
  }

  // Which may hide some of the ellipsoid.
  bool has_body_shapes(const Panel& panel) const { return panel.motion().shapes() && body() == EllipseBody::solid; }

  struct Mass {
    explicit Mass(const StagedRun& motion)
        : mass(motion.chain(), motion.simulation() ? motion.simulation()->constraints : ConstraintPlan{}),
          ws(std::make_unique<Workspace>(motion.chain())) {}
    TipMass mass;
    std::unique_ptr<Workspace> ws;  // its own: the mass needs more than the pose, and spoils it
  };

  // kg or m/s.
  std::vector<double> bounded_semi_axes() const {
    std::vector<double> bounded;
    for (const auto& [at, axes] : some_axes_)
      if (const auto length = bounded_semi_axis(axes, reading_)) bounded.push_back(*length);
    return bounded;
  }
  // Velocities of equal energy are bounded everywhere, and their scale is that of their long axes.
  std::vector<double> ordinary_long_axes() const {
    std::vector<double> longest;
    if (reading_ == EllipseReading::energy) return longest;
    for (const auto& [at, axes] : some_axes_)
      if (is_ordinary(axes)) longest.push_back(*axes.front().mass);
    return longest;
  }

  // The median of the bounded semi-axes is `length` long, the bar round.
  EllipseScale solid_scale(double length) const {
    std::vector<double> bounded = bounded_semi_axes();
    bounded.erase(std::remove_if(bounded.begin(), bounded.end(),
                                 [](double m) { return !(m > 0) || !std::isfinite(m); }),
                  bounded.end());
    if (bounded.empty()) return {1, kEllipseBar, reading_};
    const auto middle = bounded.begin() + std::ptrdiff_t(bounded.size() / 2);
    std::nth_element(bounded.begin(), middle, bounded.end());
    const double bar = round_length(kLongestBar * *middle / length);
    return {bar, bar * length / *middle, reading_};
  }

  const Stage* stage_;
  EllipseReading reading_;
  bool is_section_;
  std::map<const StagedRun*, Mass> masses_;
  std::map<std::pair<const StagedRun*, int>, std::vector<MassAxis>> some_axes_;  // at some of the samples
  EllipseScale scale_;
};

// The inside; and in space the pose at which the ellipsoid is roundest, with its ellipsoid, where it changes
// by much: that the other is longer is then seen, not only said.
class EllipseInside : public Layer {
 public:
  explicit EllipseInside(const Stage& stage) : along_(stage) {}

  UnderWords under_words() const override { return UnderWords::if_need_be; }

  // Velocities of equal energy have a bound everywhere: the picture holds them.
  void measure(const Sight& sight, FitBox& box) const override {
    if (along_.body() != EllipseBody::solid || along_.reading() != EllipseReading::energy) return;
    const Eigen::Vector3d tip = tip_position(sight.motion.chain(), sight.ws);
    const Camera seen = sight.camera.seen_at(tip);
    double x = 0, y = 0;
    for (const MassAxis& axis : along_.axes_at(sight.motion, sight.k)) {
      const double length = semi_axis(axis, along_.reading()).value_or(0) * along_.scale().per_unit();
      x = std::hypot(x, length * seen.right.dot(axis.direction));
      y = std::hypot(y, length * seen.up.dot(axis.direction));
    }
    box.add({x, x, y, y}, sight.camera.flat(tip));
  }

  // Others have none near singular poses.
  void wish(const Sight& sight, FitBox& box) const override {
    const Eigen::Vector3d tip = tip_position(sight.motion.chain(), sight.ws);
    if (const auto room = along_.room_at(sight, tip)) box.add(*room, sight.camera.flat(tip));
  }

  void draw_once(Picture& picture, const Panel& panel) const override {
    if (along_.body() != EllipseBody::solid) return;
    const auto k = roundest(panel.motion());
    if (!k) return;
    const Workspace& then = panel.motion().pose_at(*k);
    ChainLook look = panel.look();
    look.strength = kGhost;
    const ChainDrawing drawing = panel.drawing(look);
    Theme pale = *look.theme;
    pale.ellipse = pale.ellipse.faded(kGhostLine);
    EllipseStyle style = along_.style_in(panel, EllipsePart::below);
    style.theme = &pale;
    style.signs = false;
    along_.draw(picture, panel, *k, style);
    draw_rails(picture, drawing, then, panel.clip());
    draw_links(picture, drawing, then, panel.clip());
    style.part = EllipsePart::above;
    along_.draw(picture, panel, *k, style);
  }

  void draw(Picture& picture, const Shot& shot) const override {
    along_.draw(picture, shot.panel, shot.k, along_.style_in(shot.panel, EllipsePart::below));
  }

 private:
  // The shortest semi-axis over the longest one.
  double roundness(const StagedRun& motion, int k) const {
    const std::vector<MassAxis> axes = along_.axes_at(motion, k);
    if (axes.empty() || !axes.front().mass || !axes.back().mass) return 0;
    return *axes.back().mass / *axes.front().mass;
  }
  std::optional<int> roundest(const StagedRun& motion) const {
    int best = 0;
    double most = 0, least = 1;
    for (const int k : some_of(motion.counted())) {
      const double round = roundness(motion, k);
      if (round > most) most = round, best = k;
      least = std::min(least, round);
    }
    if (!(most > kMuchRounder * kMuchRounder * least)) return std::nullopt;
    return best;
  }

  MassAlong along_;
};

class EllipseLines : public Layer {
 public:
  explicit EllipseLines(const Stage& stage)
      : stage_(&stage), along_(stage), has_legend_(stage.shows("legend")), is_of_hand_(has_eye(stage.motions.front().chain(), stage.page.camera)) {}

  UnderWords under_words() const override { return UnderWords::if_need_be; }
  bool has_words() const override { return true; }

  void write(SheetText& text) const override {
    text.bar = along_.scale().label() + (is_of_hand_ ? " at the hand" : "");
    text.bar_length = along_.scale().bar_length;
    if (has_legend_) text.legend = ellipse_legend(along_.reading(), along_.body());
  }

  void draw(Picture& picture, const Shot& shot) const override {
    EllipseStyle style = along_.style_in(shot.panel, EllipsePart::above);
    style.labels = &shot.labels;
    style.stands = shot.is_still || stage_->stands_still(shot.k);
    if (!shot.is_still) style.cut_numbers = cut_numbers_at(shot, style);
    along_.draw(picture, shot.panel, shot.k, style);
  }

 private:
  std::vector<CutNumber> cut_numbers_at(const Shot& shot, const EllipseStyle& style) const {
    const auto [known, is_new] = cut_numbers_.try_emplace(&shot.panel.motion());
    if (is_new) {
      known->second = along_.cut_numbers(shot.panel, style);
      shot.panel.motion().pose_at(shot.k);  // where the other layers have it
    }
    std::vector<CutNumber> now;
    for (const std::vector<CutNumber>& axis : known->second) now.push_back(axis[std::size_t(shot.k)]);
    return now;
  }

  const Stage* stage_;
  MassAlong along_;
  bool has_legend_;
  mutable std::map<const StagedRun*, std::vector<std::vector<CutNumber>>> cut_numbers_;
  bool is_of_hand_;  // seen in perspective, a bar in the foot would be taken for one of all depths
};

}  // namespace

std::unique_ptr<const Layer> make_layer_ellipse_inside(const Stage& stage) {
  return std::make_unique<EllipseInside>(stage);
}

std::unique_ptr<const Layer> make_layer_ellipse(const Stage& stage) {
  return std::make_unique<EllipseLines>(stage);
}

}  // namespace chainreel

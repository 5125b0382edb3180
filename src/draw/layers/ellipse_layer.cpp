// The layer `ellipse`: the effective mass of the end effector along a run, at one scale for the whole film.
#include <cmath>
#include <map>

#include "draw/layers/ellipse.hpp"
#include "draw/layers/layer.hpp"
#include "sim/tip.hpp"

namespace chainreel {
namespace {

constexpr double kEllipseBar = 0.10;  // units of H: the bounded semi-axis measures about as much

class EllipseLayer : public Layer {
 public:
  explicit EllipseLayer(const Stage& stage)
      : stage_(&stage),
        reading_(stage.page.ellipse.reading),
        is_section_(stage.page.ellipse.shape == EllipseShape::section) {
    for (const StagedRun& motion : stage.motions)
      if (is_of(motion)) masses_.emplace(&motion, motion);
    // Panels share the page, so their sides shrink with the root of their number.
    scale_ = ellipse_scale(bounded_semi_axes(), kEllipseBar / std::sqrt(double(stage.full_panels())), reading_);
  }

  void write(SheetText& text) const override {
    text.bar = scale_.label();
    text.bar_length = scale_.bar_length;
    if (stage_->shows("legend"))
      text.legend = ellipse_legend(reading_, is_section_ && !stage_->motions.front().chain().planar);
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    EllipseStyle style{&stage_->theme,   &stage_->fonts, panel.scene().text_scale,
                       scale_.per_unit(), panel.area(),   reading_};
    style.labels = &shot.labels;
    const Camera seen = panel.camera().seen_at(tip_position(panel.chain(), shot.ws));
    draw_mass_ellipse(picture, axes_at(panel.motion(), shot.k), panel.tip().place(shot.k), seen, style, panel.clip());
  }

 private:
  struct MassAlong {
    explicit MassAlong(const StagedRun& motion)
        : mass(motion.chain(), motion.simulation() ? motion.simulation()->constraints : ConstraintPlan{}),
          ws(std::make_unique<Workspace>(motion.chain())) {}
    TipMass mass;
    std::unique_ptr<Workspace> ws;  // its own: the mass needs more than the pose, and spoils it
  };

  std::vector<MassAxis> axes_at(const StagedRun& motion, int k) const {
    const MassAlong& along = masses_.at(&motion);
    const EffectiveMass effective = along.mass.at(*along.ws, motion.trajectory().q_at(k));
    if (!is_section_) return mass_axes(effective);
    return section_axes(effective, tip_plane(motion.chain(), motion.pose_at(k)), reading_);
  }

  // At some of the frames, kg or m/s.
  std::vector<double> bounded_semi_axes() const {
    std::vector<double> bounded;
    for (const auto& [motion, mass] : masses_)
      for (const int k : some_of(motion->samples()))
        if (const auto length = bounded_semi_axis(axes_at(*motion, k), reading_)) bounded.push_back(*length);
    return bounded;
  }

  const Stage* stage_;
  EllipseReading reading_;
  bool is_section_;
  std::map<const StagedRun*, MassAlong> masses_;
  EllipseScale scale_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_ellipse(const Stage& stage) {
  return std::make_unique<EllipseLayer>(stage);
}

}  // namespace chainreel

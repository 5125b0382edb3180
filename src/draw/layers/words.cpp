// Words and bars around the scene: title, equation of motion, scale of lengths.
#include "draw/layers/layer.hpp"
#include "draw/page/scales.hpp"
#include "scene/run/title.hpp"

namespace chainreel {
namespace {

class TitleLayer : public Layer {
 public:
  explicit TitleLayer(const Stage& stage)
      : title_(stage.is_comparison() ? title_of_page(stage.page) : stage.motions.front().title()) {}
  void write(SheetText& text) const override {
    text.title = title_;
    text.with_panel_titles = true;
  }

 private:
  std::string title_;
};

class EquationLayer : public Layer {
 public:
  explicit EquationLayer(const Stage& stage) {
    for (const StagedRun& motion : stage.motions) {
      constrained_ |= motion.is_constrained();
      pushed_ |= !motion.scene().push.empty();
    }
    // tau and lambda take the colours of their vectors where those are shown.
    if (stage.shows("torque")) colors_.push_back({"tau", stage.theme.torque});
    if (stage.shows("constraint_force")) colors_.push_back({"lambda", stage.theme.constraint});
  }
  void write(SheetText& text) const override {
    text.equation = std::string("M(q) qdd + h(q, qd)") + (constrained_ ? " + J_c^T lambda" : "") + " = tau" + (pushed_ ? " + J^T F" : "");
    text.symbols = colors_;
  }

 private:
  bool constrained_ = false, pushed_ = false;
  std::vector<SymbolColor> colors_;
};

// Names the layers that have a scale: they ask whether it is shown.
class Legend : public Layer {};

class ScaleBar : public Layer {
 public:
  explicit ScaleBar(const Stage& stage)
      : fonts_(&stage.fonts), text_scale_(stage.page.text_scale), is_below_(stage.shows("ellipse")) {}

  // An ellipse may come anywhere in the scene: below it the bar is out of its way.
  double row_below() const override { return is_below_ ? metre_bar_row(text_scale_) : 0; }

  bool covers(const Sight&, const Rect&, bool at_lower_left) const override { return at_lower_left; }
  void draw_page_once(Picture& picture, const SharedPage& page) const override {
    Sheet first = page.sheet;
    first.scene = page.scene;
    draw_metre_bar(picture, page.camera, first, *fonts_);
  }

 private:
  const Fonts* fonts_;
  double text_scale_;
  bool is_below_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_title(const Stage& stage) {
  return std::make_unique<TitleLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_equation(const Stage& stage) {
  return std::make_unique<EquationLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_legend(const Stage&) {
  return std::make_unique<Legend>();
}

std::unique_ptr<const Layer> make_layer_scale_bar(const Stage& stage) {
  return std::make_unique<ScaleBar>(stage);
}

}  // namespace chainreel

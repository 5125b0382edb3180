#include "draw/layers/speed_box.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/layers/layer.hpp"

namespace chainreel {
namespace {

constexpr double kBoxHeight = 1.6;      // of the em
constexpr int kMostDecimals = 6;

}  // namespace

std::string speed_text(double speed) {
  return (speed >= 100 ? format_fixed(speed, 0) : format_significant(speed, 3)) + "\u00D7";
}

int time_decimals(const FilmClock& clock) {
  if (clock.is_plain()) return 2;
  return std::clamp(int(std::ceil(-std::log10(clock.shortest_step()) - 1e-9)), 2, kMostDecimals);
}

namespace {

class TimeLayer : public Layer {
 public:
  explicit TimeLayer(const Stage& stage) : stage_(&stage), decimals_(time_decimals(stage.clock)) {}

  void write(SheetText& text) const override { text.longest_time = time_text(stage_->latest_time(), decimals_); }
  void draw_page(Picture& picture, const SharedPage& page, int k) const override {
    draw_time(picture, page.sheet, stage_->times[std::size_t(k)], stage_->fonts, decimals_);
  }

 private:
  const Stage* stage_;
  int decimals_;
};

// "0.25x" in a rounded box beside the time, for as long as the film shows the motion slower or faster than it was; as
// wide as the widest of the film's speeds asks for, so that nothing moves when they change. Where the speed changes over several
// frames it stands from halfway on, whole, so that no still has it half faded. While the film stands still, two bars are in it.
class SpeedBox : public Layer {
 public:
  explicit SpeedBox(const Stage& stage) : stage_(&stage), text_size_(scaled(size::kAxis, stage.page.text_scale)) {
    if (stage.clock.stretches().empty()) return;
    for (const Stretch& one : stage.clock.stretches())
      width_ = std::max(width_,
                        lay_out_text(stage.fonts, speed_text(one.speed), {Face::label, text_size_}).advance);
    width_ += kBoxHeight * text_size_;  // the round ends
  }

  void write(SheetText& text) const override { text.beside_time = width_; }

  void draw_page(Picture& picture, const SharedPage& page, int k) const override {
    const double t = stage_->times[std::size_t(k)];
    const Stretch* stretch = stage_->clock.stretch_at(t);
    if (stretch == nullptr) return;
    if (!((1 - stage_->clock.speed_at(t)) / (1 - stretch->speed) >= 0.5)) return;
    const Theme& theme = stage_->theme;
    const Point right = page.sheet.time_left;  // its right end, on the base line of the text beside it
    const double r = kBoxHeight * text_size_ / 2, middle = right.y + kCapHeight / 2 * text_size_;
    picture.add(Capsule{{right.x - width_ + r, middle},
                        {right.x - r, middle},
                        r,
                        {theme.background, theme.ink, size::kLinkOutline}});
    if (stage_->stands_still(k)) return draw_pause(picture, {right.x - width_ / 2, middle}, 0.7 * r);
    const TextStyle style{Face::label, text_size_, theme.ink, Align::center};
    draw_text(picture, lay_out_text(stage_->fonts, speed_text(stretch->speed), style), {right.x - width_ / 2, right.y});
  }

 private:
  // Two bars.
  void draw_pause(Picture& picture, Point middle, double half) const {
    const Paint paint{stage_->theme.ink, {}, 0};
    for (const double side : {-1.0, 1.0}) {
      const double x = middle.x + side * half / 2;
      picture.add(Capsule{{x, middle.y - half / 2}, {x, middle.y + half / 2}, half / 5, paint});
    }
  }

  const Stage* stage_;
  double text_size_, width_ = 0;  // units of H
};

}  // namespace

std::unique_ptr<const Layer> make_layer_time(const Stage& stage) {
  return std::make_unique<TimeLayer>(stage);
}

std::unique_ptr<const Layer> make_layer_speed(const Stage& stage) {
  return std::make_unique<SpeedBox>(stage);
}

}  // namespace chainreel

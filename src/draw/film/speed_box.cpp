#include "draw/film/speed_box.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kHeight = 1.6;      // of the em
constexpr int kMostDecimals = 6;

}  // namespace

std::string speed_text(double speed) {
  return (speed >= 100 ? format_fixed(speed, 0) : format_significant(speed, 3)) + "\u00D7";
}

int time_decimals(const FilmClock& clock) {
  if (clock.is_plain()) return 2;
  return std::clamp(int(std::ceil(-std::log10(clock.shortest_step()) - 1e-9)), 2, kMostDecimals);
}

SpeedBox::SpeedBox(const FilmClock& clock, double text_scale, const Theme& theme, const Fonts& fonts)
    : theme_(&theme), fonts_(&fonts), text_size_(scaled(size::kAxis, text_scale)) {
  for (const Stretch& one : clock.stretches())
    width_ = std::max(width_, lay_out_text(fonts, speed_text(one.speed), {Face::label, text_size_}).advance);
  width_ += kHeight * text_size_;  // the round ends
}

void SpeedBox::draw(Picture& picture, Point right, double speed) const {
  if (speed == 1) return;
  const double r = kHeight * text_size_ / 2, middle = right.y + kCapHeight / 2 * text_size_;
  picture.add(Capsule{{right.x - width_ + r, middle},
                      {right.x - r, middle},
                      r,
                      {theme_->background, theme_->ink, size::kLinkOutline}});
  const TextStyle style{Face::label, text_size_, theme_->ink, Align::center};
  draw_text(picture, lay_out_text(*fonts_, speed_text(speed), style), {right.x - width_ / 2, right.y});
}

}  // namespace chainreel

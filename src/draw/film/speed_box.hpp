// "0.25x" in a rounded box in the footer, for as long as the film shows the motion slower or faster than it
// was.
#pragma once

#include <string>

#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/film_clock.hpp"

namespace chainreel {

// The speed with the sign of multiplication.
std::string speed_text(double speed);

// Decimals of the running time that tell any two frames apart: two where the motion is nowhere slowed down.
int time_decimals(const FilmClock& clock);

// As wide as the widest of the film's speeds asks for, so that nothing moves when they change.
class SpeedBox {
 public:
  SpeedBox(const FilmClock& clock, double text_scale, const Theme& theme, const Fonts& fonts);

  double width() const { return width_; }
  // `right`: its right end, on the base line of the text beside it. Nothing at speed 1.
  void draw(Picture& picture, Point right, double speed) const;

 private:
  const Theme* theme_;
  const Fonts* fonts_;
  double text_size_ = 0, width_ = 0;  // units of H
};

}  // namespace chainreel

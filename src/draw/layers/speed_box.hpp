// The running time of a film, and how fast the motion passes.
#pragma once

#include <string>

#include "scene/film_clock.hpp"

namespace chainreel {

// The speed with the sign of multiplication.
std::string speed_text(double speed);

// Decimals of the running time that tell any two frames apart: two where the motion is nowhere slowed down.
int time_decimals(const FilmClock& clock);

}  // namespace chainreel

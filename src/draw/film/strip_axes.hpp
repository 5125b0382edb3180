// The axes of plots beside the scene of a clip, by what they show. Internal.
#pragma once

#include "draw/film/plot_strip.hpp"

namespace chainreel {

// The range of what decides, or of everything where nothing does.
Axis value_axis(const StripData& data);

// Up to the end of the last frame, where that is a round time.
Axis time_axis(double end);

}  // namespace chainreel

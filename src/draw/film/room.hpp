// Whether what a film's page shows is large enough beside its words, which have a least size on paper.
#pragma once

#include <string>

#include "draw/film/compose.hpp"

namespace chainreel {

// What is too small, in words, with its size in units of H: plots lower than kLeastPlot of the page's smallest words or
// narrower than kLeastPlotWidth of them, scenes lower than kLeastScenes of them. Empty where there is room. Throws Error where titles do not fit above their panels.
struct Lack {
  std::string what;  // "" nothing
  double size = 0;  // its height, or its width
  bool is_narrow = false;
};
inline constexpr double kLeastPlot = 5, kLeastPlotWidth = 8, kLeastScenes = 8;
Lack lack_of_room(const Composition& composition);

}  // namespace chainreel

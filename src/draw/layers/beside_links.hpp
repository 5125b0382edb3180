// Arrows that would lie along a link, which is hardly wider than they are, stand beside it instead, tied by a line to the point
// where they act, so that both are seen. They go there and back so slowly that no frame has a jump.
#pragma once

#include <vector>

#include "draw/page/panel.hpp"

namespace chainreel {

// The links of a panel as they lie on the page.
std::vector<PageLine> links_on_page(const Panel& panel, const Workspace& ws);

// How an arrow lies to a link that it hides.
struct LiesAlong {
  double much = 0;   // 0 to 1: how much of it lies along the link
  double leans = 0;  // sine of the angle from the arrow to the link, on whose side the arrow would cross it
};

// `half`: how far the link reaches to both sides of its line.
LiesAlong lies_along(const PageLine& arrow, const PageLine& link, double half);

// How far an arrow stands to the side of one that lies along it, units of H.
double way_beside(const ChainLook& look);

// How far to the left of its own way an arrow stands at each frame, -1 to 1: on the side to which the link does not lean while
// both lie along each other, there in time and for as long; never for a link that only swings past.
std::vector<double> ways_aside(const std::vector<LiesAlong>& along, double fps);

}  // namespace chainreel

// What curves of a work-precision diagram are called, beside them. Internal.
#pragma once

#include "draw/charts/chart.hpp"
#include "draw/charts/obstacles.hpp"

namespace chainreel {

// Of curves in colour, beside one of their points. Returns whether all stand.
bool draw_names_in_colour(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, Obstacles& obstacles,
                          const ChartLook& look);

// With which steps or tolerances curves in colour begin and end.
void draw_settings(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, Obstacles& obstacles,
                   const ChartLook& look);

// Of grey curves, as grey does not tell them apart: beside one of their points where no other curve is near, else a thin line
// away, which crosses no curve and ends in a dot. Names without such a place are left out.
void draw_grey_names(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, Obstacles& obstacles,
                     const ChartLook& look);

}  // namespace chainreel

// What a work-precision diagram draws beside its curves: guides, slopes, failures, the choice of `auto`.
#pragma once

#include "draw/chart.hpp"

namespace chainreel {

double cost_of(const ChartPoint& point, ChartCost cost);

// The least cost for each error, and ten and a hundred times as much.
void draw_best_guides(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                      const ChartLook& look);

// A triangle for each order whose slope some curve really shows, where fewest points are in the way.
void draw_slopes(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 const ChartLook& look);

// A failed run: the method's marker and a cross on the right edge, at its cost.
void draw_failure(Picture& picture, const PlotFrame& frame, double cost, const CurveStyle& style,
                  const ChartLook& look);

void draw_choice(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 const ChartLook& look);

}  // namespace chainreel

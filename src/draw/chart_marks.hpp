// What a work-precision diagram draws beside its curves: guides, slopes, failures, the choice of `auto`.
#pragma once

#include "draw/chart.hpp"

namespace chainreel {

double cost_of(const ChartPoint& point, ChartCost cost);

// What lies behind the curves: the least cost for each error and ten and a hundred times as much, a triangle
// for each order whose slope some curve really shows, a ring around the choice of `auto`. Words and triangles
// stand where no curve crosses them, or are left out; the word of the choice always stands.
void draw_marks(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                const ChartLook& look);

// A failed run: the method's marker and a cross on the right edge, at its cost.
void draw_failure(Picture& picture, const PlotFrame& frame, double cost, const CurveStyle& style,
                  const ChartLook& look);

}  // namespace chainreel

// The work-precision diagram: what accuracy costs with each method. Error grows to the right, cost upward,
// both on log axes, so that better is further down and to the left. The caller has measured everything;
// nothing is computed here but where it goes on the page.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/charts/chart_page.hpp"

namespace chainreel {

// One run: a rung of the ladder of steps or tolerances of a method.
struct ChartPoint {
  double error = 0;        // of the final state against the reference
  double seconds = 0;      // median of the repetitions
  double evaluations = 0;  // of the dynamics
  bool failed = false;     // diverged or gave up: its cost is shown, its error is not
  std::string label;       // "h = 1 ms" or "rk4, step 0.001 s"; drawn at the ends of curves in colour
  bool is_apart = false;   // no rung of the ladder, as a choice of `auto` of another order: a mark by itself beside the curve
};

struct ChartCurve {
  std::string method;
  int order = 0;  // 0: no slope is expected
  std::vector<ChartPoint> points;
  int look = -1;  // of curve_style; -1: the place in the list
  std::string title{};  // what the picture calls it; "": `method`
  bool is_lit = true;  // in colour, with markers and a label; else a grey line, so that the others stand out
};

struct ChartChoice {
  std::string method;
  int point = 0;
};

struct WorkPrecision {
  std::string title, subtitle;
  std::string error_title = "final error";
  std::string error_meaning;         // for the foot; "": nothing to add
  double floor = 0;                  // the problem's amplification x 2^-53; 0: not known
  double reference_uncertainty = 0;  // 0: not known
  double largest_answer = std::numeric_limits<double>::infinity();  // a run that is off by more tells nothing of the motion
  std::vector<ChartCurve> curves;
  std::optional<ChartChoice> choice;  // of `auto`
  std::string machine;                // processor, compiler, revision

  // Below it errors say nothing: of the method or of the reference.
  double least_error() const { return std::max(floor, reference_uncertainty); }
  bool is_least_of_reference() const { return reference_uncertainty > floor; }
};

enum class ChartCost { seconds, evaluations };

// One panel for each cost, side by side.
Picture work_precision_chart(const WorkPrecision& data, std::span<const ChartCost> panels,
                             const ChartLook& look);

// "h = 0.01 s" of "rk4, step 0.01 s": the setting without its method.
std::string setting_of(const std::string& label);

// Lights the curves of these methods, of none named those that are cheapest at some error in one of the panels which
// is an answer, rounding apart, and the choice of `auto`, and no others. Those that are lit have colours of their own, as far as there are so many.
void light_curves(WorkPrecision& data, std::span<const ChartCost> panels, const std::vector<std::string>& methods);

// What a diagram draws beside its curves: guides, slopes, failures, the choice of `auto`. Internal.

double cost_of(const ChartPoint& point, ChartCost cost);

// The least cost at which any curve reaches an error of at most `error`, read between neighbouring points of
// a curve along straight lines of the log-log diagram; nothing where none gets there.
std::optional<double> least_cost(const WorkPrecision& data, ChartCost cost, double error);

// What lies behind the curves: the least cost for each error and ten and a hundred times as much, a triangle
// for each order whose slope some curve really shows, a ring around the choice of `auto`, the settings at the ends of curves in
// colour, the names of grey ones. Words and triangles
// stand where no curve crosses them, or are left out; the word of the choice always stands.
// With `names_inside` the names of curves in colour stand beside them, too.
struct DrawnMarks {
  bool triangles = false;   // there are some
  bool names_stand = true;  // all of those that are wanted inside
};
DrawnMarks draw_marks(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, bool names_inside,
                      const ChartLook& look);

// A failed run: the method's marker and a cross on the right edge, at its cost.
void draw_failure(Picture& picture, const PlotFrame& frame, double cost, const CurveStyle& style,
                  const ChartLook& look);

}  // namespace chainreel

// Plots on the list of shapes: axes, curves, zones, labels at the ends of curves. They stand by themselves in
// charts and beside the scene in clips. Nothing here knows what the numbers mean.
//
// Data points are (x, y) in the units of the axes; a PlotFrame takes them to the page. What is not finite, or
// not positive on a log axis, is a gap. Text is written at the sizes of the style guide times `text_scale`,
// never below 0.022 H.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

enum class Scale {
  linear,
  log,
  angle,  // linear in radians, ticks at multiples of pi/2 where the range allows
};

struct Axis {
  Scale scale = Scale::linear;
  double low = 0, high = 1;
  std::string title{};  // with the unit in brackets, formulas between dollar signs: "$tau$ [N m]"
  std::string last_unit{};  // linear axes: the last number stands at the end, with this unit; "": where it falls
  std::vector<double> at{};  // where ticks stand, as far as they have room; none: at round numbers
};

struct PlotStyle {
  const Fonts* fonts = nullptr;
  const Theme* theme = nullptr;
  double text_scale = 1;
  double pixel = 0;  // of the page, units of H; 0: it has none, or any number

  double text(double size) const;  // a text size of the style guide at this scale
};

namespace size {
inline constexpr double kPlotLine = 0.0035, kPlotLineSecondary = 0.0025, kPlotCursor = 0.0025;
inline constexpr double kPlotFrame = 0.0018, kPlotTick = 0.009, kPlotGrid = 0.0012;
inline constexpr double kMarker = 0.0135;  // across a disc; other markers cover about the same area
}  // namespace size

// --- axes ---

struct Tick {
  double value = 0;
  // Empty for ticks without a number. `superscript` is set above and behind: the exponent of a power of ten.
  std::string label{}, superscript{};
};

// Steps of 1, 2 or 5 x 10^n, at most `most` labels. On log axes decades are labelled, thinned evenly; an axis
// of less than a decade and a half is labelled at 1, 2 and 5.
std::vector<Tick> ticks_of(const Axis& axis, int most);

// The same interval, widened to whole ticks (log: whole decades), so that curves do not end on the frame.
Axis rounded_out(Axis axis);

struct PlotFrame {
  Axis x, y;
  Rect box;  // where the data are drawn

  bool can_show(Point data) const;  // finite, and positive on log axes
  Point at(Point data) const;       // page point, inside the box or not
  Point data_at(Point page) const;
  double at_x(double value) const;
  double at_y(double value) const;
};

// What a tick says, on one line; `at` is its middle in height, and left, centre or right as aligned.
void draw_tick_label(Picture& picture, const Tick& tick, Point at, Align align, const PlotStyle& style);
double tick_label_width(const Tick& tick, const PlotStyle& style);

// Where the base line of the title of a vertical axis stands above the frame: over the highest number and its exponent.
double title_above_frame(const PlotStyle& style);

// What numbers below a frame without a title of its horizontal axis, and the title above it, take of its height.
double height_around_frame(const PlotStyle& style);

// Where the numbers below a frame end, and their base line is.
Point end_of_numbers(const PlotFrame& frame, const PlotStyle& style);

// The frame inside `area` that leaves room for tick labels and axis titles.
PlotFrame lay_out_plot(const Rect& area, const Axis& x, const Axis& y, const PlotStyle& style);

// Grid, zero lines, frame, ticks, labels, titles: x's below at the right end, y's above at the left end, so
// that no text is turned.
void draw_axes(Picture& picture, const PlotFrame& frame, const PlotStyle& style);

// --- curves ---

enum class Dash { solid, dashed, dotted, dash_dot, even };  // even: gaps as long as dashes, which show a curve below
enum class Marker {
  none,
  disc,
  square,
  triangle,
  diamond,
  cross,
  triangle_down,
  plus,
  ring,
  open_square,
  open_triangle,
  open_diamond,
  open_triangle_down,
};

struct CurveStyle {
  Color color;
  double width = size::kPlotLine;
  Dash dash = Dash::solid;
  Marker marker = Marker::none;
  double marker_size = size::kMarker;
};

// Twelve looks that differ in colour and marker; neighbours differ in dash, too. Then they repeat with other
// dashes. Markers grow with the text.
inline constexpr int kCurveLooks = 12;
CurveStyle curve_style(int index, const Theme& theme, double text_scale = 1);

// Cut at the frame. Of more points than the page can show, each column keeps its first, last, lowest and
// highest. Markers of points outside are left out.
void draw_curve(Picture& picture, const PlotFrame& frame, std::span<const Point> data,
                const CurveStyle& style, const Theme& theme);
// A line on the page in the pattern of `style`; no markers.
void draw_path(Picture& picture, std::span<const Point> page_points, const CurveStyle& style, int clip = -1);
void draw_marker(Picture& picture, Point at, Marker marker, double size, Color color, Color background,
                 int clip = -1);
// A short line with its marker, `at` its left end: the key of a legend.
void draw_key(Picture& picture, Point at, double length, const CurveStyle& style, const Theme& theme);

// "Now" in a clip: a vertical line across the frame.
void draw_cursor(Picture& picture, const PlotFrame& frame, double x, Color color);

// --- what explains ---

// Between two data corners, cut at the frame.
void draw_zone(Picture& picture, const PlotFrame& frame, Point low, Point high, Color fill);

// A straight line between two data points, cut at the frame.
void draw_guide(Picture& picture, const PlotFrame& frame, Point from, Point to, const CurveStyle& style);

inline constexpr double kLinePitch = 1.35;  // of the em, between lines of a paragraph

// Words in lines no wider than `width` where spaces and hyphens allow, the first base line at `top_left`;
// returns the height used.
double draw_paragraph(Picture& picture, const Fonts& fonts, const std::string& words, const TextStyle& style,
                      Point top_left, double width);
// What draw_paragraph would draw, line by line.
std::vector<std::string> wrapped(const Fonts& fonts, const std::string& words, const TextStyle& style,
                                 double width);

// Shows the slope of a power law: a right triangle with one leg along each axis and its number beside the
// leg along x, outside of the triangle.
struct SlopeTriangle {
  Point corner;              // page point of the right angle
  double run = 0, rise = 0;  // the legs from there along x and y, page lengths of either sign
  std::string label;
};
void draw_slope_triangle(Picture& picture, const SlopeTriangle& triangle, const PlotStyle& style);

struct EndLabel {
  Point end;  // page point where the curve ends
  std::string text;  // formulas between dollar signs
  CurveStyle curve;
};

// Labels in a column right of the frame that starts at `x`, in the order of their ends, moved apart so that
// none overlaps another; a thin leader ties each to its end. Keys of the curves stand before the words.
void draw_end_labels(Picture& picture, const PlotFrame& frame, std::vector<EndLabel> labels, double x,
                     const PlotStyle& style);
// The width that draw_end_labels will take.
double end_labels_width(std::span<const std::string> texts, const PlotStyle& style);

// Places as near as can be to `wanted` (in rising order), at least `pitch` apart, within [low, high] where
// they fit: least squares, by pooling neighbours (isotonic regression).
std::vector<double> moved_apart(std::vector<double> wanted, double pitch, double low, double high);

}  // namespace chainreel

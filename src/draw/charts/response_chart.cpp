#include "draw/charts/response_chart.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kFlat = 1e-3;   // of its size: the least range that an axis has about curves that do not change
constexpr double kBeside = 0.04; // of the range in x: air beside the first and the last run

Axis y_axis(const ResponseChart& data) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const ResponseCurve& curve : data.curves)
    for (const ResponsePoint& point : curve.points)
      if (point.y) low = std::min(low, *point.y), high = std::max(high, *point.y);
  if (!(low <= high)) low = 0, high = 1;
  if (data.from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(high - low > kFlat * size)) {
    const double half = size > 0 ? kFlat * size : 0.5;
    low -= half, high += half;
  }
  return rounded_out({Scale::linear, low, high, data.y_title});
}

// With air at both ends.
Axis x_axis(Axis axis) {
  if (axis.scale == Scale::log) {
    const double by = std::pow(axis.high / axis.low, kBeside);
    axis.low /= by, axis.high *= by;
  } else {
    const double by = kBeside * (axis.high - axis.low);
    axis.low -= by, axis.high += by;
  }
  return axis;
}

void draw_points(Picture& picture, const PlotFrame& frame, const ResponseCurve& curve, const CurveStyle& style, const Theme& theme) {
  CurveStyle line = style;
  line.marker = Marker::none;
  std::vector<Point> joined;
  const auto draw_joined = [&] {
    if (joined.size() > 1) draw_curve(picture, frame, joined, line, theme);
    joined.clear();
  };
  for (const ResponsePoint& point : curve.points)
    if (point.y)
      joined.push_back({point.x, *point.y});
    else
      draw_joined();
  draw_joined();
  for (const ResponsePoint& point : curve.points)
    if (point.y)
      draw_marker(picture, frame.at({point.x, *point.y}), point.is_doubtful ? Marker::ring : style.marker, style.marker_size, style.color, theme.background);
}

void draw_edges(Picture& picture, const PlotFrame& frame, const ResponseChart& data, const ChartLook& look) {
  constexpr double kBesideLine = 0.008;
  const PlotStyle style = look.plot_style();
  double taken = -HUGE_VAL;
  int line = 0;
  for (const ResponseEdge& edge : data.edges) {
    const double x = frame.at_x(edge.x), em = style.text(size::kTick);
    if (!(x >= frame.box.x0 && x <= frame.box.x1)) continue;
    CurveStyle dashed{look.theme->muted, size::kPlotLineSecondary, Dash::dashed, Marker::none};
    const Point ends[] = {{edge.x, frame.y.low}, {edge.x, frame.y.high}};
    draw_curve(picture, frame, ends, dashed, *look.theme);
    const TextLine word = lay_out_text(*look.fonts, edge.value, {Face::label, em, look.theme->muted, Align::left});
    // To its left where the frame ends; one line lower where the last one's word still stands.
    const double left = x + kBesideLine + word.advance <= frame.box.x1 ? x + kBesideLine : x - kBesideLine - word.advance;
    line = left < taken + kBesideLine ? line + 1 : 0;
    taken = std::max(taken, left + word.advance);
    draw_text(picture, word, {left, frame.box.y1 - (1 + kLinePitch * line) * em - kBesideLine});
  }
}

}  // namespace

Picture response_chart(const ResponseChart& data, const ChartLook& look) {
  Picture picture;
  const Rect area = draw_chart_page(picture, {data.title, data.subtitle, data.footer}, look);
  require_room_for_names(data.curves.size(), area, look);
  const PlotStyle style = look.plot_style();
  std::vector<std::string> names;
  for (const ResponseCurve& curve : data.curves) names.push_back(curve.title);
  const bool has_names = names.size() > 1;
  const double labels = has_names ? end_labels_width(names, style) + kLabelGap : 0;
  const PlotFrame frame = lay_out_plot({area.x0, area.y0, area.x1 - labels, area.y1}, x_axis(data.x), y_axis(data), style);
  require_room_for_axes(frame, look);
  draw_axes(picture, frame, style);
  draw_edges(picture, frame, data, look);
  std::vector<EndLabel> ends;
  for (std::size_t i = 0; i < data.curves.size(); ++i) {
    CurveStyle look_of_curve = curve_style(int(i), *look.theme, look.text_scale);
    if (i < look.theme->curve.size()) look_of_curve.color = look.theme->curve[i];  // a house style's
    draw_points(picture, frame, data.curves[i], look_of_curve, *look.theme);
    const auto& points = data.curves[i].points;
    const auto last = std::find_if(points.rbegin(), points.rend(), [](const ResponsePoint& point) { return point.y.has_value(); });
    if (last != points.rend()) ends.push_back({frame.at({last->x, *last->y}), names[i], look_of_curve});
  }
  if (!data.curves.empty())
    for (const ResponsePoint& point : data.curves.front().points)
      if (!point.y) draw_marker(picture, {frame.at_x(point.x), frame.box.y0}, Marker::cross, size::kMarker * look.text_scale, look.theme->muted, look.theme->background);
  if (has_names) draw_end_labels(picture, frame, ends, frame.box.x1 + kLabelGap, style);
  return as_page(picture, look);
}

}  // namespace chainreel

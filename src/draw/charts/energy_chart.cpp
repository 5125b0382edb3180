#include "draw/charts/energy_chart.hpp"

#include <algorithm>
#include <cmath>

#include "draw/charts/lit_colours.hpp"
#include "picture/formula_words.hpp"

namespace chainreel {
namespace {

constexpr int kColumns = 240;
constexpr double kMostDecadesOfTime = 7;
constexpr double kMostDecadesOfError = 24;
// A run that diverges is shown up to this much beyond the worst of the others.
constexpr double kBeyondOthers = 1e3;
// Energies likewise, in ranges of the others; of one that does not change a share of it is shown.
constexpr double kRangesBeyond = 1, kLeastRange = 1e-3;
constexpr int kMarkers = 5;  // along each curve
constexpr const char* kNote = "each curve shows the largest error until each time";
constexpr const char* kNoteOfEnergies = "kinetic and potential energy, and that of springs, at the ends of steps";

CurveStyle style_of(const EnergyChart& data, std::size_t curve, const ChartLook& look) {
  const int index = data.curves[curve].look;
  CurveStyle style = curve_style(index < 0 ? int(curve) : index, *look.theme, look.text_scale);
  if (data.curves[curve].is_lit) return style;
  style.color = look.theme->base;
  style.width = size::kPlotLineSecondary;
  style.marker = Marker::none;
  style.dash = Dash::solid;  // of a dozen in one colour no dashes can be told apart
  return style;
}

std::size_t samples_of(const EnergyCurve& curve) {
  return std::min(curve.t.size(), curve.error.size());
}

double last_time(const EnergyChart& data) {
  double last = 0;
  for (const EnergyCurve& curve : data.curves)
    for (const double t : curve.t)
      if (std::isfinite(t)) last = std::max(last, t);
  return last;
}

double first_time(const EnergyChart& data, double last) {
  double first = last;
  for (const EnergyCurve& curve : data.curves)
    for (const double t : curve.t)
      if (t > 0) first = std::min(first, t);
  return std::max(first, last * std::pow(10.0, -kMostDecadesOfTime));
}

double worst_of(const std::vector<std::vector<Point>>& curves, const EnergyChart& data, bool whole_runs) {
  double worst = 0;
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const Point& p : curves[i])
      if (data.curves[i].trouble.empty() == whole_runs) worst = std::max(worst, p.y);
  return worst;
}

Axis error_axis(const std::vector<std::vector<Point>>& curves, const EnergyChart& data) {
  const double good = worst_of(curves, data, true), bad = worst_of(curves, data, false);
  double high = good > 0 ? std::max(good, std::min(bad, kBeyondOthers * good)) : bad, low = HUGE_VAL;
  if (!(high > 0)) high = 1;
  for (const std::vector<Point>& curve : curves)
    for (const Point& p : curve) low = std::min(low, p.y);
  low = std::max(std::min(low, high), high * std::pow(10.0, -kMostDecadesOfError));
  return rounded_out({Scale::log, low, high, data.error_title});
}

struct EnergyRange {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(double value) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  bool is_there() const { return low <= high; }
};

// What the whole runs need, and no more than their range again of what runs that came to no end need beyond it.
Axis energy_axis(const EnergyChart& data) {
  EnergyRange good, all;
  for (const EnergyCurve& curve : data.curves)
    for (const double energy : curve.energy) {
      all.add(energy);
      if (curve.trouble.empty()) good.add(energy);
    }
  EnergyRange range = good.is_there() ? good : all;
  if (!range.is_there()) range = {0, 1};
  const double least = kLeastRange * std::max(std::abs(range.low), std::abs(range.high));
  const double span = std::max(range.high - range.low, least > 0 ? least : 1);
  if (good.is_there()) {
    range.low = std::max(std::min(all.low, range.low), range.low - kRangesBeyond * span);
    range.high = std::min(std::max(all.high, range.high), range.high + kRangesBeyond * span);
  }
  if (range.high - range.low < span) range = {range.low - span / 2, range.high + span / 2};
  return rounded_out({Scale::linear, range.low, range.high, "energy [J]"});
}

// Errors that oscillate through zero would lie in one tangle.
std::vector<Point> largest_until(std::vector<Point> points) {
  for (std::size_t i = 1; i < points.size(); ++i) points[i].y = std::max(points[i].y, points[i - 1].y);
  return points;
}

std::vector<Point> energies_of(const EnergyCurve& curve) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < std::min(curve.t.size(), curve.energy.size()); ++i) points.push_back({curve.t[i], curve.energy[i]});
  return points;
}

Axis time_axis(const EnergyChart& data, double first, double last) {
  if (data.shows_energy) return {Scale::linear, 0, last > 0 ? last : 1, "time [s]"};
  return last > first ? Axis{Scale::log, first, last, "time [s]"} : Axis{Scale::log, 0.1, 1, "time [s]"};
}

// Like the key's, but only a few along the curve, and not at the same places as the neighbour's.
void draw_markers(Picture& picture, const PlotFrame& frame, const std::vector<Point>& points,
                  const CurveStyle& style, double shift, const Theme& theme) {
  double next = frame.box.x0 + shift * frame.box.width() / kMarkers;
  for (const Point& p : points) {
    const Point at = frame.at(p);
    if (at.x < next) continue;
    next = at.x + frame.box.width() / kMarkers;
    if (at.y < frame.box.y0 || at.y > frame.box.y1) continue;
    draw_marker(picture, at, style.marker, style.marker_size, style.color, theme.background);
  }
}

// Where the curve ends or leaves the frame.
Point end_of(const PlotFrame& frame, const std::vector<Point>& points) {
  const auto inside = std::find_if(points.rbegin(), points.rend(),
                                   [&](const Point& p) { return p.y <= frame.y.high && p.y >= frame.y.low; });
  const Point p = inside == points.rend() ? points.back() : *inside;
  const Point at = frame.at(p);
  return {at.x, std::clamp(at.y, frame.box.y0, frame.box.y1)};
}

std::string label_of(const EnergyCurve& curve) {
  const std::string name = without_formulas(curve.title.empty() ? curve.method : curve.title);
  return curve.trouble.empty() ? name : name + " (" + curve.trouble + ")";
}

}  // namespace

std::vector<Point> crests(const EnergyCurve& curve, double from, int columns) {
  std::vector<Point> found;
  const std::size_t count = samples_of(curve);
  if (count == 0 || !(curve.t[count - 1] > from) || !(from > 0)) return found;
  const double per_column = std::log10(curve.t[count - 1] / from) / columns;
  long column = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const double error = std::abs(curve.error[i]), t = curve.t[i];
    if (!(t >= from) || !std::isfinite(error) || error == 0) continue;
    const long own = std::min(long(std::log10(t / from) / per_column), long(columns) - 1);
    if (own != column || found.empty())
      found.push_back({t, error});
    else if (error > found.back().y)
      found.back() = {t, error};
    column = own;
  }
  return found;
}

Picture energy_chart(const EnergyChart& data, const ChartLook& look) {
  Picture picture;
  const std::string note = data.shows_energy ? kNoteOfEnergies : kNote;
  const std::string footer = data.footer.empty() ? note : data.footer + "; " + note;
  // On small pages grey curves have no names.
  const auto is_named = [&](const EnergyCurve& curve) { return curve.is_lit || !look.is_small; };
  const auto names = std::size_t(std::ranges::count_if(data.curves, is_named));
  const std::string needed = names < data.curves.size() ? "grey: the other methods" : "";
  const Rect area = draw_chart_page(picture, {.title = data.title, .subtitle = data.subtitle, .footer = footer, .needed = needed, .is_in_caption = true}, look);
  require_room_for_names(names, area, look);
  const PlotStyle style = look.plot_style();
  const double last = last_time(data), first = first_time(data, last);
  std::vector<std::vector<Point>> curves;
  std::vector<std::string> texts;
  for (const EnergyCurve& curve : data.curves) {
    curves.push_back(data.shows_energy ? energies_of(curve) : largest_until(crests(curve, first, kColumns)));
    texts.push_back(is_named(curve) ? label_of(curve) : "");
  }
  const double labels = end_labels_width(texts, style);
  const PlotFrame frame = lay_out_plot({area.x0, area.y0, area.x1 - labels - kLabelGap, area.y1}, time_axis(data, first, last),
                                       data.shows_energy ? energy_axis(data) : error_axis(curves, data), style);
  require_room_for_axes(frame, look);
  draw_axes(picture, frame, style);
  std::vector<EndLabel> ends;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (curves[i].empty() || texts[i].empty()) continue;
    ends.push_back({end_of(frame, curves[i]), texts[i], style_of(data, i, look)});
  }
  draw_end_labels(picture, frame, ends, frame.box.x1 + kLabelGap, style);
  for (const std::size_t i : quiet_first(data.curves)) {
    CurveStyle curve = style_of(data, i, look);
    const Marker marker = curve.marker;
    curve.marker = Marker::none;
    draw_curve(picture, frame, curves[i], curve, *look.theme);
    curve.marker = marker;
    draw_markers(picture, frame, curves[i], curve, 0.3 + 0.7 * double(i) / double(curves.size()),
                 *look.theme);
    if (!data.curves[i].trouble.empty() && !curves[i].empty())
      draw_marker(picture, end_of(frame, curves[i]), Marker::cross, 1.25 * curve.marker_size, curve.color,
                  look.theme->background);
  }
  return as_page(picture, look);
}

}  // namespace chainreel

#include "draw/charts/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.hpp"
#include "draw/charts/lit_colours.hpp"
#include "picture/formula_words.hpp"

namespace chainreel {
namespace {

// A share of the page's width; where it is not enough for all panels, they share the labels of the last.
constexpr double kMostForLabels = 0.30;
constexpr double kQuietMarker = 0.7;
constexpr double kQuietLine = 0.0018, kQuietOpacity = 0.6;  // units of H: so thin and pale are curves without a colour
constexpr double kNarrowestPanel = 20;  // ems of a tick's text, on paper
constexpr double kZonePad = 0.012;
constexpr double kWidestZone = 0.34;  // of the panel
constexpr double kZoneOpacity = 0.14;
// What lies to the left of the least error that says something.
constexpr const char* kGuidesWords = "dotted: 1, 10, 100 times the cheapest";
constexpr const char* kRoundingWords = "under the growth of one rounding";
constexpr const char* kReferenceWords = "under what the reference is known to";

// The longest form that fits.
std::string cost_title(ChartCost cost, double width, const PlotStyle& style) {
  if (cost == ChartCost::seconds) return "time per run [s]";
  const std::string whole = "evaluations of the dynamics";
  const TextStyle text{Face::label, style.text(size::kAxis), style.theme->ink, Align::left};
  return lay_out_text(*style.fonts, whole, text).advance <= width ? whole : "evaluations";
}

CurveStyle style_of(const WorkPrecision& data, std::size_t curve, const ChartLook& look) {
  const int index = data.curves[curve].look;
  CurveStyle style = curve_style(index < 0 ? int(curve) : index, *look.theme, look.text_scale);
  if (data.curves[curve].is_lit) return style;
  style.color = look.theme->base.faded(kQuietOpacity);
  style.width = kQuietLine;
  style.dash = Dash::solid;
  style.marker_size *= kQuietMarker;
  if (data.curves[curve].points.size() > 1) style.marker = Marker::none;
  return style;
}

std::string title_of(const ChartCurve& curve) {
  return without_formulas(curve.title.empty() ? curve.method : curve.title);
}

struct Range {
  double low = HUGE_VAL, high = 0;
  void see(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(high > 0); }
};

Axis log_axis(Range range, const std::string& title) {
  if (range.empty()) range = {0.1, 1};
  return rounded_out({Scale::log, range.low, range.high, title});
}

Axis cost_axis(const WorkPrecision& data, ChartCost cost, double width, const PlotStyle& style) {
  Range range;
  for (const ChartCurve& curve : data.curves)
    for (const ChartPoint& point : curve.points) range.see(cost_of(point, cost));
  return log_axis(range, cost_title(cost, width, style));
}

Range errors_of(const WorkPrecision& data) {
  Range range;
  for (const ChartCurve& curve : data.curves)
    for (const ChartPoint& point : curve.points)
      if (!point.failed) range.see(point.error);
  return range;
}

TextStyle small_text(const ChartLook& look, Align align) {
  return {Face::label, look.plot_style().text(size::kTick), look.theme->muted, align};
}

const char* words_of_zone(const WorkPrecision& data) {
  return data.is_least_of_reference() ? kReferenceWords : kRoundingWords;
}

double zone_width(const WorkPrecision& data, const ChartLook& look) {
  double widest = 0;
  const TextStyle style = small_text(look, Align::center);
  for (const std::string& word : wrapped(*look.fonts, words_of_zone(data), style, 0))
    widest = std::max(widest, lay_out_text(*look.fonts, word, style).advance);
  return widest + 2 * kZonePad;
}

bool any_failed(const WorkPrecision& data) {
  return std::any_of(data.curves.begin(), data.curves.end(), [](const ChartCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(),
                       [](const ChartPoint& p) { return p.failed; });
  });
}

// Left of the smallest error there is as much room as the words in the zone need; right of the largest a
// decade for what failed.
Axis error_axis(const WorkPrecision& data, double panel_width, const ChartLook& look) {
  Axis axis = log_axis(errors_of(data), data.error_title);
  if (any_failed(data)) axis.high *= 10;
  if (!(data.least_error() > 0)) return axis;
  axis.high = std::max(axis.high, rounded_out({Scale::log, data.least_error(), 10 * data.least_error(), ""}).high);
  const double share = std::min(zone_width(data, look) / panel_width, kWidestZone);
  const double floor = std::log10(data.least_error()), high = std::log10(axis.high);
  axis.low = std::min(axis.low, std::pow(10.0, (floor - share * high) / (1 - share)));
  return axis;
}

void draw_floor(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, const ChartLook& look) {
  if (!(data.least_error() > frame.x.low)) return;
  draw_zone(picture, frame, {frame.x.low, frame.y.low}, {data.least_error(), frame.y.high},
            look.theme->base.faded(kZoneOpacity));
}

void draw_floor_words(Picture& picture, const PlotFrame& frame, const WorkPrecision& data,
                      const ChartLook& look) {
  if (!(data.least_error() > frame.x.low)) return;
  const char* const words = words_of_zone(data);
  const TextStyle style = small_text(look, Align::center);
  const double right = std::min(frame.at_x(data.least_error()), frame.box.x1), left = frame.box.x0;
  const double width = right - left - 2 * kZonePad * 0.99;
  const auto lines = double(wrapped(*look.fonts, words, style, width).size());
  if (lines * kLinePitch * style.size + 2 * kZonePad > frame.box.height()) return;
  draw_paragraph(picture, *look.fonts, words, style,
                 {(left + right) / 2, frame.box.y0 + kZonePad + (lines - 0.7) * kLinePitch * style.size},
                 width);
}

void draw_curves(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 const ChartLook& look) {
  for (const std::size_t i : quiet_first(data.curves)) {
    const CurveStyle style = style_of(data, i, look);
    std::vector<Point> points;
    for (const ChartPoint& point : data.curves[i].points) {
      // No error at all is as good as the axis shows.
      const double error = point.failed ? NAN : std::max(point.error, frame.x.low);
      if (point.is_apart && !point.failed) {
        const Point alone[] = {{error, cost_of(point, cost)}};
        draw_curve(picture, frame, alone, style, *look.theme);
        continue;
      }
      points.push_back({error, cost_of(point, cost)});
      if (point.failed) draw_failure(picture, frame, cost_of(point, cost), style, look);
    }
    draw_curve(picture, frame, points, style, *look.theme);
  }
}

std::vector<EndLabel> labels_of(const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                                const ChartLook& look) {
  std::vector<EndLabel> labels;
  for (std::size_t i = 0; i < data.curves.size(); ++i) {
    if (!data.curves[i].is_lit) continue;
    std::optional<Point> end;
    for (const ChartPoint& point : data.curves[i].points) {
      const Point p = {point.failed ? frame.x.high : std::clamp(point.error, frame.x.low, frame.x.high),
                       cost_of(point, cost)};
      if (frame.can_show(p) && (!end || frame.at(p).x > end->x)) end = frame.at(p);
    }
    if (end) labels.push_back({*end, title_of(data.curves[i]), style_of(data, i, look)});
  }
  return labels;
}

enum class PanelNames { none, beside, inside };  // of the methods that have colours

// Panels from left to right; each but the last is followed by room for its labels where they are not shared. One below the other on
// pages that are higher than wide.
struct Columns {
  std::vector<Rect> panels;
  bool shared_labels = false;
};

Columns columns_of(const Rect& area, std::size_t count, double labels) {
  Columns columns;
  const double with_labels = labels + kLabelGap;
  if (area.height() > area.width()) {
    const double height = (area.height() - double(count - 1) * size::kGutter) / double(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double top = area.y1 - double(i) * (height + size::kGutter);
      columns.panels.push_back({area.x0, top - height, area.x1 - with_labels, top});
    }
    return columns;
  }
  columns.shared_labels = double(count) * with_labels > kMostForLabels * area.width();
  const double inner = columns.shared_labels ? size::kGutter : with_labels + size::kGutter;
  const double width = (area.width() - with_labels - double(count - 1) * inner) / double(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double left = area.x0 + double(i) * (width + inner);
    columns.panels.push_back({left, area.y0, left + width, area.y1});
  }
  return columns;
}

DrawnMarks draw_panel(Picture& picture, const Rect& area, const WorkPrecision& data, ChartCost cost,
                PanelNames names, const ChartLook& look) {
  const PlotStyle style = look.plot_style();
  const Axis costs = cost_axis(data, cost, area.width(), style);
  const double width =
      lay_out_plot(area, log_axis(errors_of(data), data.error_title), costs, style).box.width();
  const PlotFrame frame = lay_out_plot(area, error_axis(data, width, look), costs, style);
  require_room_for_axes(frame, look);
  draw_floor(picture, frame, data, look);
  draw_axes(picture, frame, style);
  draw_floor_words(picture, frame, data, look);
  const DrawnMarks drawn = draw_marks(picture, frame, data, cost, names == PanelNames::inside, look);
  if (names == PanelNames::beside)
    draw_end_labels(picture, frame, labels_of(frame, data, cost, look), frame.box.x1 + kLabelGap, style);
  draw_curves(picture, frame, data, cost, look);
  return drawn;
}

std::string footer_of(const WorkPrecision& data, bool triangles) {
  std::string text;
  const auto add = [&text](const std::string& part) {
    text += (text.empty() || part.empty() ? "" : "; ") + part;
  };
  add(data.error_meaning);
  const auto of_reference = [&] { return "reference known to " + format_power(data.reference_uncertainty); };
  if (data.is_least_of_reference())
    add("shaded: " + of_reference());
  else if (data.floor > 0)
    add("shaded: rounding grows to " + format_power(data.floor));
  if (data.reference_uncertainty > 0 && !data.is_least_of_reference()) add(of_reference());
  add(kGuidesWords);
  if (triangles) add("triangles: slope of an order");
  const auto others = std::ranges::count_if(data.curves, [](const ChartCurve& curve) { return !curve.is_lit; });
  if (others) add(std::to_string(others) + (others == 1 ? " other" : " others") + ", grey: --highlight");
  if (any_failed(data)) add("crosses: failed or lost");
  add(data.machine);
  return text;
}

// On small pages, a panel that is too narrow to be read has none beside it: the first stays, which is what the title speaks of; the table has the others.
std::span<const ChartCost> readable_panels(std::span<const ChartCost> panels, const std::vector<std::string>& methods, const ChartLook& look) {
  if (!look.is_small || panels.size() < 2) return panels;
  const Rect area{size::kMargin, size::kMargin, look.width() - size::kMargin, look.height - size::kMargin};
  const PlotStyle style = look.plot_style();
  const Columns columns = columns_of(area, panels.size(), end_labels_width(methods, style));
  return columns.panels.front().width() < kNarrowestPanel * style.text(size::kTick) ? panels.first(1) : panels;
}

}  // namespace

Picture work_precision_chart(const WorkPrecision& data, std::span<const ChartCost> all_panels,
                             const ChartLook& look) {
  std::vector<std::string> methods;  // that have labels
  for (const ChartCurve& curve : data.curves)
    if (curve.is_lit) methods.push_back(title_of(curve));
  const std::span<const ChartCost> panels = readable_panels(all_panels, methods, look);
  // On a small page the only panel has the names of its curves inside, where all have room there: beside it they would take a third of the width.
  bool inside = look.is_small && panels.size() == 1;
  const auto draw = [&](bool explains_triangles, bool& triangles) {
    Picture picture;
    const ChartText text{.title = data.title, .subtitle = data.subtitle, .footer = footer_of(data, explains_triangles), .needed = kGuidesWords, .is_in_caption = true};
    const Rect area = draw_chart_page(picture, text, look);
    require_room_for_names(methods.size(), area, look);
    const Columns columns = columns_of(area, panels.size(), inside ? -kLabelGap : end_labels_width(methods, look.plot_style()));
    triangles = false;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const PanelNames names = inside ? PanelNames::inside : !columns.shared_labels || i + 1 == panels.size() ? PanelNames::beside : PanelNames::none;
      const DrawnMarks drawn = draw_panel(picture, columns.panels[i], data, panels[i], names, look);
      triangles |= drawn.triangles;
      inside = inside && drawn.names_stand;
    }
    return picture;
  };
  // Whether they are explained decides on the room that they have.
  bool triangles = false;
  if (inside) draw(true, triangles);  // finds out whether they have room
  const Picture explained = draw(true, triangles);
  if (triangles) return as_page(explained, look);
  const Picture plain = draw(false, triangles);
  return as_page(triangles ? explained : plain, look);
}

}  // namespace chainreel

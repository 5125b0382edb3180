#include "draw/film/plot_strip.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "core/format.hpp"
#include "draw/film/needles.hpp"
#include "draw/film/strip_axes.hpp"
#include "picture/point.hpp"
#include "picture/thin_points.hpp"

namespace chainreel {
namespace {

constexpr double kTotalLine = 0.0045;
constexpr double kBoundLine = 0.0025, kThinLine = 0.0015;
constexpr const char* kRankLoss = "rank loss";
constexpr double kPale = 0.45;   // of a curve that is still to come
constexpr double kShareBelow = 0.30;  // of the page's height
constexpr double kMostLabels = 0.4;  // of a plot's width may be taken by the names of its curves
constexpr double kMostNumbers = 0.25;    // ... by numbers that its axis tells roughly
constexpr double kMostOwnLabels = 0.6;  // ... of the curves of one run, which are named nowhere else
constexpr double kShareStacked = 0.26, kMostStacked = 0.55;  // of the height: of each plot, and of all
constexpr double kPlotLabelGap = 0.012;
constexpr double kConstantSpan = 1e-6, kShareOfConstant = 0.5;  // of its size, of what the eye takes for one; of other plots' height
constexpr std::size_t kMostOnConstant = 2;  // names of curves that have room beside so low a plot
constexpr double kMostBelow = 0.45;   // of the room, whatever is asked for
constexpr double kLeastFrame = 1.5;   // words high
constexpr double kFrameOfConstant = 2;  // times that, of one that is lower than others
constexpr double kWordsOfPlot = 0.075;  // units of H: what title and numbers take of a plot's height at text_scale 1
constexpr double kNoteGap = 0.02;
constexpr double kToldOfSpan = 100;     // parts of an axis that the number at a curve's end tells
constexpr double kStepMark = 0.009;  // units of H, across
constexpr double kSameEnd = 1e-6;    // of a step: its end
constexpr double kLeastOfMoved = 0.05;  // of the energy that a motion moves: a drift of a hundredth of it is a fifth of the plot, noise of methods a line
constexpr double kFlatOfMoved = 2e-3;   // of the same: what the line of a curve covers where the axis has that range
constexpr double kMostDashed = 40;      // units of H: so many swings of a curve that long lie so near to one another that its dashes are not seen
constexpr double kSameCurve = 2e-3;   // of its range, by which a curve leaves another one: half of what a line is thick

bool is_of_ellipse(PlotQuantity quantity) {
  return quantity == PlotQuantity::effective_mass || quantity == PlotQuantity::energy_speed;
}

// Between a colour and what it stands on, as far as words and lines stay seen.
Color paler(Color color, Color ground) {
  constexpr double kStrength = 0.6;
  const auto mixed = [](std::uint8_t one, std::uint8_t other) { return std::uint8_t(std::lround(kStrength * one + (1 - kStrength) * other)); };
  return {mixed(color.r, ground.r), mixed(color.g, ground.g), mixed(color.b, ground.b), color.a};
}

// Curves are told apart by place, or by the run they belong to. One of a single body has the colour of what that body draws: its link, its
// trail; those of constraints that of their arrows, in two tones.
CurveStyle style_of(const PlotCurves& plot, std::size_t curve, std::size_t run, std::size_t runs,
                    const Theme& theme) {
  CurveStyle style = curve_style(int(runs > 1 ? run : curve), theme);
  style.marker = Marker::none;
  if (plot.curves[curve].is_bound) return {theme.muted, theme.lines * kBoundLine, Dash::dashed, Marker::none};
  if (runs > 1) {
    style.color = variant_color(theme, int(run), int(runs));
    style.dash = plot.curves.size() > 1 ? Dash(curve % 4) : Dash::solid;
    return style;
  }
  const auto hue = plot.curves[curve].body > 0 ? std::size_t(plot.curves[curve].body - 1) : curve;
  if (hue != curve) style.color = curve_style(int(hue), theme).color;
  if (hue < theme.curve.size()) style.color = theme.curve[hue];
  if (plot.quantity == PlotQuantity::energy && curve + 1 == plot.curves.size())
    return {theme.ink, theme.lines * kTotalLine, Dash::solid, Marker::none};
  if (is_of_ellipse(plot.quantity)) return {theme.ellipse, style.width, Dash(curve % 4), Marker::none};  // as its axes
  const bool is_of_constraint = plot.quantity == PlotQuantity::lambda || plot.title.find("lambda") != std::string::npos;
  if (is_of_constraint || plot.formula == "cop") style.color = curve % 2 == 0 ? theme.constraint : paler(theme.constraint, theme.background);
  return style;
}

// Of quantities whose names are symbols.
std::string symbol_of(PlotQuantity quantity) {
  switch (quantity) {
    case PlotQuantity::q:
    case PlotQuantity::qd:
    case PlotQuantity::tau:
    case PlotQuantity::lambda:
      return std::string(to_string(quantity));
    case PlotQuantity::constraint_error:
      return "phi";
    default:
      return "";
  }
}

// "q [rad]" with its symbol, or its expression, as a formula. Titles of a scene's own have what formulas they have.
std::string title_with_symbol(const PlotCurves& plot) {
  const std::string symbol = plot.formula.empty() ? symbol_of(plot.quantity) : plot.formula;
  const bool leads = !symbol.empty() && (plot.title == symbol || plot.title.starts_with(symbol + " "));
  return leads ? "$" + symbol + "$" + plot.title.substr(symbol.size()) : plot.title;
}

// In comparisons of two the titles bear the colours of their curves.
std::string label_of(const PlotCurves& plot, std::size_t curve, const StripRun& run, std::size_t runs) {
  const std::string& own = plot.curves[curve].name;
  const bool is_symbol = !symbol_of(plot.quantity).empty() || is_of_ellipse(plot.quantity);
  const std::string name = is_symbol ? "$" + own + "$" : own;
  if (runs <= 2) return runs == 1 || plot.curves.size() > 1 ? name : "";
  const std::string& title = run.title;
  return plot.curves.size() > 1 ? name + ", " + title : title;
}

// By two digits that are no less.
std::string at_most(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return format_significant(std::ceil(value / unit * (1 - 1e-9)) * unit, 2);
}

// The sums of energies of several runs, plot i of each, stand on an axis that is not made of their rounding; how constant they are is said.
void keep_noise_small(StripData& data, const std::vector<StripRun>& runs, std::size_t i) {
  double moved = 0, changed = 0;
  for (const StripRun& run : runs) {
    if (run.wild || i >= run.plots.size()) continue;
    const std::vector<PlotCurve>& curves = run.plots[i].curves;
    changed = std::max(changed, span_of(curves.back().y));
    for (std::size_t part = 0; part + 1 < curves.size(); ++part) moved = std::max(moved, span_of(curves[part].y));
  }
  data.least_span = kLeastOfMoved * moved;
  if (changed > 0 && changed < kFlatOfMoved * moved) data.constancy = "constant to " + at_most(changed) + " J";
}

std::vector<std::string> labels_of(const StripData& data) {
  std::vector<std::string> labels;
  for (const StripCurve& curve : data.curves)
    if (!curve.label.empty() && !curve.points.empty()) labels.push_back(curve.label);
  return labels;
}

bool ends_step(double t, const StripRun& run) {
  const double same = kSameEnd * run.step;
  const auto next = std::lower_bound(run.breaks.begin(), run.breaks.end(), t - same);
  return std::abs(t - run.step * std::round(t / run.step)) <= same || (next != run.breaks.end() && *next <= t + same);
}

bool may_leave(const StripCurve& curve) {
  return !curve.decides || std::isfinite(curve.shown_high);
}

// Of a run that went wild the first point that its plot does not hold; of a curve that runs off to a pole the one behind which it does not come back.
std::vector<Point>::const_iterator leaves_at(const StripCurve& curve, const Axis& y) {
  if (!may_leave(curve)) return curve.points.end();
  const auto is_out = [&](const Point& p) { return p.y < y.low || p.y > y.high; };
  if (!curve.decides) return std::ranges::find_if(curve.points, is_out);
  const auto inside = std::find_if(curve.points.rbegin(), curve.points.rend(), [&](const Point& p) { return std::isfinite(p.y) && !is_out(p); });
  return std::find_if(inside.base(), curve.points.end(), is_out);
}

// " m" of "q [m]"; of "q [rad, m]" nothing.
std::string unit_in(const std::string& title) {
  const std::size_t unit = title.find_last_of('[');
  return unit != std::string::npos && title.ends_with("]") && title.find(',', unit) == std::string::npos ? " " + title.substr(unit + 1, title.size() - unit - 2) : "";
}

// The largest number that it has shows what the axis does not: "to 7\u00D710\u2078 m", with the unit of the title.
void say_where_it_goes(StripCurve& curve, const Axis& y, const std::string& title) {
  if (curve.decides || leaves_at(curve, y) == curve.points.end()) return;
  double most = 0;
  for (const Point& p : curve.points)
    if (std::isfinite(p.y)) most = std::max(most, std::abs(p.y));
  curve.label += (curve.label.empty() ? "to " : ", to ") + format_power(most) + unit_in(title);
}

// On the page, of what can be shown.
double length_of(const std::vector<Point>& points, const PlotFrame& frame) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (frame.can_show(points[i]) && frame.can_show(points[i + 1])) length += norm(frame.at(points[i + 1]) - frame.at(points[i]));
  return length;
}

// Where a curve leaves the frame for good it goes on.
void draw_going_on(Picture& picture, const PlotFrame& frame, const StripCurve& curve, Color color) {
  constexpr double kHead = 0.018, kWidth = 0.016;  // units of H
  if (!may_leave(curve) || curve.points.size() < 2) return;
  Point from = frame.at(curve.points[curve.points.size() - 2]), to = frame.at(curve.points.back());
  const Point ahead = unit(to - from);
  if (frame.box.y0 <= to.y && to.y <= frame.box.y1) return;
  if (!cut_segment(frame.box, from, to)) return;
  const Point back = to - kHead * ahead, side = kWidth / 2 * normal_to(ahead);
  picture.add(Polygon{{to, back + side, back - side}, 3, {color, {}, 0}});
}

// What of it lies before t; between two points it is where the line between them is.
std::vector<Point> part_until(const PlotFrame& frame, const StripCurve& curve, double t) {
  const auto next = std::upper_bound(curve.points.begin(), curve.points.end(), t, [](double now, const Point& p) { return now < p.x; });
  std::vector<Point> part(curve.points.begin(), next);
  if (part.empty() || next == curve.points.end() || !frame.can_show(part.back()) || !frame.can_show(*next)) return part;
  const Point from = frame.at(part.back()), to = frame.at(*next);
  const double way = (t - part.back().x) / (next->x - part.back().x);
  if (way > 0) part.push_back({t, frame.data_at(from + way * (to - from)).y});
  return part;
}

// A curve until t, and where steps end.
void draw_part(Picture& picture, const PlotFrame& frame, const StripCurve& curve, double t, const Theme& theme, double opacity) {
  const std::vector<Point> path = part_until(frame, curve, t);
  CurveStyle style = curve.style;
  // Two pale colours over one another would be a third one, of no curve.
  if (curve.covers && opacity < 1) {
    style.color = theme.background;
    draw_curve(picture, frame, path, style, theme);
  }
  style.color = curve.style.color.faded(opacity);
  draw_curve(picture, frame, path, style, theme);
  if (curve.points.empty() || t >= curve.points.back().x) draw_going_on(picture, frame, curve, style.color);
  for (const Point& p : curve.marks)
    if (!path.empty() && p.x <= path.back().x && frame.can_show(p) && p.y >= frame.y.low && p.y <= frame.y.high)
      draw_marker(picture, frame.at(p), Marker::disc, kStepMark, style.color, theme.background);
}

}  // namespace

double span_of(std::span<const double> y) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double one : y)
    if (std::isfinite(one)) low = std::min(low, one), high = std::max(high, one);
  return low <= high ? high - low : 0;
}

PlotStrip::PlotStrip(StripData data, const Rect& area, const PlotStyle& style)
    : data_(std::move(data)), area_(area), style_(style) {
  Axis values = value_axis(data_);
  for (StripCurve& curve : data_.curves) say_where_it_goes(curve, values, data_.title);
  std::vector<std::string> labels = labels_of(data_);
  // The names of runs stand above their panels, too, in the colours of the curves.
  const double most = data_.ends_in_numbers ? kMostNumbers : data_.of_runs ? kMostLabels : kMostOwnLabels;
  if (!labels.empty() && end_labels_width(labels, style_) > most * area.width()) {
    for (StripCurve& curve : data_.curves) {
      curve.label.clear();
      if (data_.note.empty()) data_.note = curve.words_above;
    }
    labels.clear();
  }
  Rect inner = area;
  if (!labels.empty()) inner.x1 -= end_labels_width(labels, style_) + kPlotLabelGap;
  if (!data_.constancy.empty()) {
    const std::string said = data_.title + ", " + data_.constancy;
    const TextStyle words{Face::label, style_.text(size::kAxis), style_.theme->ink, Align::left};
    if (lay_out_words(*style_.fonts, said, words).advance <= inner.width()) values.title = data_.title = said;
  }
  frame_ = lay_out_plot(inner, time_axis(data_.end), values, style_);
  needles_ = needles_of(data_.curves, frame_.y);
  // What a run that went wild does behind the point where it leaves the plot is no motion.
  for (StripCurve& curve : data_.curves) {
    const auto out = leaves_at(curve, frame_.y);
    if (out != curve.points.end()) curve.points.erase(out + 1, curve.points.end());
  }
  for (StripCurve& curve : data_.curves) {
    std::vector<Point> shown;
    for (const std::size_t i : thin_points(frame_, curve.points, style_.pixel)) shown.push_back(curve.points[i]);
    curve.points = std::move(shown);
    if (curve.style.dash != Dash::even && length_of(curve.points, frame_) > kMostDashed) curve.style.dash = Dash::solid;
  }
}

void PlotStrip::draw_static(Picture& picture) const {
  if (data_.accurate_until < frame_.x.high) draw_zone(picture, frame_, {data_.accurate_until, frame_.y.low}, {frame_.x.high, frame_.y.high}, style_.theme->grid);
  draw_axes(picture, frame_, style_);
  draw_needle_heads(picture, frame_, needles_, data_.curves, HUGE_VAL, kPale);
  const std::string unit = unit_in(data_.title);
  std::string note = data_.note;
  // What has no room in the plot stands above it.
  if (!draw_needle_numbers(picture, frame_, needles_, data_.curves, unit, style_))
    note += (note.empty() ? "to " : ", to ") + number_of(std::ranges::max(needles_, {}, [](const Needle& one) { return std::abs(one.peak.y); }), unit);
  draw_note(picture, note);
  draw_change_points(picture, note);
  std::vector<EndLabel> ends;
  for (const StripCurve& curve : data_.curves) {
    draw_part(picture, frame_, curve, HUGE_VAL, *style_.theme, kPale);
    const auto last = std::find_if(curve.points.rbegin(), curve.points.rend(), [&](const Point& p) { return std::isfinite(p.y) && (!data_.is_log || p.y > 0); });
    if (curve.label.empty() || curve.points.empty() || (last == curve.points.rend() && !data_.has_poles && !data_.is_log)) continue;
    const Point end = last == curve.points.rend() ? Point{frame_.box.x1, data_.has_poles ? frame_.box.y1 : frame_.box.y0} : frame_.at(*last);
    // A leader from where a curve leaves the plot, or ends before the others, would be taken for its way on.
    const bool goes_on = !may_leave(curve) && last == curve.points.rbegin() && end.x >= frame_.box.x1 - kPlotLabelGap;
    ends.push_back({{goes_on ? end.x : frame_.box.x1, std::clamp(end.y, frame_.box.y0, frame_.box.y1)}, curve.label, curve.style});
  }
  draw_end_labels(picture, frame_, ends, frame_.box.x1 + kPlotLabelGap, style_);
}

// Thin and dotted, which no curve is; one says what they are, the first that has room above it beside the title and the note.
void PlotStrip::draw_change_points(Picture& picture, const std::string& note) const {
  const auto words = [&](const std::string& text, double size, bool is_note) {
    return lay_out_words(*style_.fonts, text, {Face::label, style_.text(size), is_note ? style_.theme->muted : style_.theme->ink, Align::left});
  };
  const TextLine name = words(kRankLoss, size::kTick, true);
  const double begin = area_.x0 + words(data_.title, size::kAxis, false).advance + kNoteGap;
  const double right = frame_.box.x1 - (note.empty() ? 0 : words(note, size::kTick, true).advance + kNoteGap);
  bool is_named = false;
  for (const double t : data_.change_points) {
    draw_guide(picture, frame_, {t, frame_.y.low}, {t, frame_.y.high}, {style_.theme->muted, style_.theme->lines * kThinLine, Dash::dotted, Marker::none});
    // Above its middle, or beside the title some of it.
    const double at = frame_.at({t, frame_.y.high}).x, left = std::max(at - name.advance / 2, begin);
    if (is_named || left > at || left + name.advance > right) continue;
    draw_text(picture, name, {left, frame_.box.y1 + title_above_frame(style_)});
    is_named = true;
  }
}

// Beside the title of the vertical axis, or not at all.
void PlotStrip::draw_note(Picture& picture, const std::string& words) const {
  if (words.empty()) return;
  const TextLine title = lay_out_words(*style_.fonts, data_.title, {Face::label, style_.text(size::kAxis), style_.theme->ink});
  std::vector<std::string> notes = data_.shorter_notes;
  notes.insert(notes.begin(), words);
  for (const std::string& said : notes) {
    const TextLine note = lay_out_words(*style_.fonts, said, {Face::label, style_.text(size::kTick), style_.theme->muted, Align::right});
    // Over the names of curves, too, where the frame is narrow.
    const double right = std::max(frame_.box.x1, area_.x0 + title.advance + kNoteGap + note.advance);
    if (right > area_.x1 + kSameEnd) continue;
    draw_text(picture, note, {right, frame_.box.y1 + title_above_frame(style_)});
    return;
  }
}

void PlotStrip::draw_frame(Picture& picture, double t) const {
  for (const StripCurve& curve : data_.curves) draw_part(picture, frame_, curve, t, *style_.theme, 1);
  draw_needle_heads(picture, frame_, needles_, data_.curves, t, 1);
  draw_cursor(picture, frame_, std::clamp(t, frame_.x.low, frame_.x.high), style_.theme->ink);
}

namespace {

// Of plot i, of which the first says what holds for all; of several runs until when all of them are accurate.
void add_doubts(const StripRun& run, std::size_t i, StripData& data) {
  if (run.accurate_until < std::min(data.end, data.accurate_until)) {
    data.accurate_until = run.accurate_until;
    if (i == 0) data.note = "accurate until " + format_significant(run.accurate_until, 3) + " s";
  } else if (!data.of_runs && run.energy_off > 0 && run.plots[i].quantity == PlotQuantity::energy) {
    const std::string off = format_significant(run.energy_off, 2) + " J";
    data.shorter_notes = {"numerical error of total: " + off, "error: " + off};
    data.note = run.steps.empty() ? data.shorter_notes.front() : run.steps + ": total off by " + off;
  }
}

// To so many decimals that a hundredth of the axis is told; of a smaller axis "2\u00D710\u207B\u2079".
std::string told_number(double value, double span) {
  constexpr int kMostDecimals = 4;
  const int decimals = std::max(0, int(std::ceil(-std::log10(span / kToldOfSpan) - kSameEnd)));
  const std::string size = decimals <= kMostDecimals ? format_fixed(std::abs(value), decimals) : value != 0 ? format_power(std::abs(value)) : "0";
  const bool is_zero = size.find_first_of("123456789") == std::string::npos;
  return (!is_zero && value < 0 ? "\u2212" : "") + size;
}

// Where titles of panels name the curves, those of energies end with what the runs have made of it.
void add_last_energies(const std::vector<StripRun>& runs, std::size_t i, StripData& data) {
  const auto is_energy = [i](const StripRun& run) {
    if (!run.is_named_by_colour || i >= run.plots.size()) return false;
    return run.plots[i].quantity == PlotQuantity::energy || run.plots[i].quantity == PlotQuantity::energy_error;
  };
  if (!data.of_runs || data.curves.size() != runs.size() || !std::ranges::all_of(runs, is_energy)) return;
  std::vector<double> shown;
  for (const StripCurve& curve : data.curves)
    for (const Point& p : curve.points)
      if (curve.decides) shown.push_back(p.y);
  const double span = std::max(data.least_span, span_of(shown));
  if (!(span > 0)) return;
  data.ends_in_numbers = true;
  for (StripCurve& curve : data.curves)
    curve.label = curve.decides && !curve.points.empty() && std::isfinite(curve.points.back().y) ? told_number(curve.points.back().y, span) + unit_in(data.title) : "";
}

// Of two curves in one place the later one has gaps that show the other.
void part_equal_curves(std::vector<StripCurve>& curves) {
  const auto is_same = [](const StripCurve& a, const StripCurve& b) {
    if (a.points.size() != b.points.size() || a.points.empty()) return false;
    double low = HUGE_VAL, high = -HUGE_VAL, apart = 0;
    for (std::size_t k = 0; k < a.points.size(); ++k) {
      const double y = a.points[k].y, other = b.points[k].y;
      if (a.points[k].x != b.points[k].x || std::isfinite(y) != std::isfinite(other)) return false;
      if (!std::isfinite(y)) continue;
      low = std::min(low, y), high = std::max(high, y), apart = std::max(apart, std::abs(y - other));
    }
    return apart <= kSameCurve * (high - low);
  };
  for (std::size_t c = 1; c < curves.size(); ++c) {
    const std::span before = std::span(curves).first(c);
    const auto below = std::ranges::count_if(before, [&](const StripCurve& one) { return is_same(one, curves[c]); });
    curves[c].covers = below > 0;
    // A third one keeps dots of its own.
    if (below == 1) curves[c].style.dash = Dash::even;
  }
}

}  // namespace

StripData strip_data(const std::vector<StripRun>& runs, std::size_t i, double end, const Theme& theme) {
  StripData data;
  data.end = end;
  data.of_runs = runs.size() > 1;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const StripRun& run = runs[r];
    if (i >= run.plots.size()) continue;
    const PlotCurves& plot = run.plots[i];
    data.title = title_with_symbol(plot);
    add_doubts(run, i, data);
    data.change_points.insert(data.change_points.end(), run.change_points.begin(), run.change_points.end());
    data.angles = plot.angles;
    data.has_poles = plot.quantity == PlotQuantity::effective_mass;
    data.is_log = plot.scale == PlotScale::log;
    // A comparison shows the sum of energies alone.
    const bool sum_alone = runs.size() > 1 && plot.quantity == PlotQuantity::energy;
    if (sum_alone && data.least_span == 0) keep_noise_small(data, runs, i);
    PlotCurves shown = plot;
    if (sum_alone) shown.curves = {plot.curves.back()};
    for (std::size_t c = 0; c < shown.curves.size(); ++c) {
      StripCurve curve{
          label_of(shown, c, run, runs.size()), style_of(shown, c, r, runs.size(), theme), {}, !run.wild || data.is_log};
      curve.shown_low = shown.curves[c].shown_low, curve.shown_high = shown.curves[c].shown_high;
      const std::vector<double>& y = shown.curves[c].y;
      const std::vector<double>& t = run.times[i];
      curve.points.reserve(std::min(y.size(), t.size()));
      for (std::size_t k = 0; k < std::min(y.size(), t.size()); ++k) curve.points.push_back({t[k], y[k]});
      if (data.has_poles && !curve.label.empty() && std::ranges::all_of(y, [](double one) { return std::isinf(one); })) curve.label += " = \u221E";
      if (const double alone = shown.curves[c].alone; alone > 0) curve.label += (curve.label.empty() ? "once " : ", once ") + format_power(alone) + unit_in(data.title);
      if (run.step > 0) std::ranges::copy_if(curve.points, std::back_inserter(curve.marks), [&](const Point& p) { return ends_step(p.x, run); });
      // Straight lines between far states pass near to zero, where no step of the run has been.
      if (data.is_log && run.step > 0) curve.points = curve.marks;
      if (data.is_log && !curve.label.empty() && std::ranges::none_of(y, [](double one) { return one > 0; })) curve.label += " \u2264 0";
      data.curves.push_back(std::move(curve));
    }
  }
  add_last_energies(runs, i, data);
  part_equal_curves(data.curves);
  return data;
}

double share_of_height(const StripData& data) {
  double widest = 0, size = 0;
  for (const StripCurve& curve : data.curves) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Point& p : curve.points) {
      if (!std::isfinite(p.y)) continue;
      low = std::min(low, p.y), high = std::max(high, p.y);
      size = std::max(size, std::abs(p.y));
    }
    if (low < high) widest = std::max(widest, high - low);
  }
  return widest <= kConstantSpan * size && labels_of(data).size() <= kMostOnConstant ? kShareOfConstant : 1;
}

double least_frame(double text_scale) {
  return kLeastFrame * scaled(size::kTick, text_scale);
}

namespace {

// One above the other, from the top down. Each has its title and numbers; what is left is shared, equally where the least would be lower than its numbers.
void add_column(std::vector<Rect>& plots, const Rect& all, int count, double text_scale, const std::vector<double>& shares) {
  const double room = all.height() - size::kGutter * (count - 1), words = std::min(kWordsOfPlot * text_scale, 0.6 * room / count);
  double sum = 0;
  for (const double share : shares) sum += share;
  const bool is_equal = shares.empty() || (room - count * words) * std::ranges::min(shares) / sum < kFrameOfConstant * least_frame(text_scale);
  if (is_equal) sum = count;
  double y1 = all.y1;
  for (int i = 0; i < count; ++i) {
    const double height = words + (room - count * words) * (is_equal ? 1 : shares[std::size_t(i)]) / sum;
    plots.push_back({all.x0, y1 - height, all.x1, y1});
    y1 -= height + size::kGutter;
  }
}

}  // namespace

PlotAreas plot_areas(const Rect& page, int count, PlotPlace place, double least_below,
                     double text_scale, double beside, double least_each, const std::vector<double>& shares, double most) {
  PlotAreas areas{page, {}};
  if (count == 0) return areas;
  const double gap = size::kGutter;
  Rect all = page;
  if (place == PlotPlace::stacked) {
    all.y1 = page.y0 + std::min(std::max(kShareStacked * page.height(), least_each) * count, (most > 0 ? most : kMostStacked) * page.height());
    areas.scene.y0 = all.y1 + gap;
    add_column(areas.plots, all, count, text_scale, shares);
    return areas;
  }
  if (place == PlotPlace::below) {
    const double height = page.height(), words = std::max(0.0, text_scale - 1) * kWordsOfPlot;
    all.y1 = page.y0 + std::max(kShareBelow * height,
                                std::min(std::max({kShareBelow * height + words, least_below, least_each}), (most > 0 ? most : kMostBelow) * height));
    areas.scene.y0 = all.y1 + gap;
    const double width = (all.width() - gap * (count - 1)) / count;
    for (int i = 0; i < count; ++i) {
      const double x0 = all.x0 + i * (width + gap);
      areas.plots.push_back({x0, all.y0, x0 + width, all.y1});
    }
    return areas;
  }
  all.x0 = page.x1 - beside * page.width();
  areas.scene.x1 = all.x0 - gap;
  add_column(areas.plots, all, count, text_scale, shares);
  return areas;
}

}  // namespace chainreel

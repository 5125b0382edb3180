#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/format.hpp"
#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr double kTitleAbove = 0.019;  // with text at its usual size
constexpr double kTickToLabel = 0.007, kLabelToTitle = 0.010;
constexpr double kSuperscriptScale = 0.70, kSuperscriptUp = 0.38;  // of the em, as in formulas
constexpr double kPitchX = 1.7;  // of the widest label: distance of labels along x
constexpr double kPitchY = 3.0, kLeastPitchY = 1.3;  // of the em, along y
constexpr double kLeastAcross = 0.85;  // of the em: numbers that are nearer along y lie on one another
constexpr int kFewestLabels = 3, kMostLinear = 5, kMostLog = 6, kMostThinned = 9;
constexpr std::size_t kFewestOfScale = 2;
constexpr double kDecadeApart = 0.011;  // units of H: ticks of decades without a number that stand closer are a comb
constexpr double kLeastAir = 0.3;  // of the em, between two numbers below a frame
constexpr double kLastAir = 0.6;  // of the em, before the last number with its unit

// Grows with the words: symbols with dots rise above their capitals.
double label_to_title(const PlotStyle& style) {
  return kLabelToTitle * style.text(size::kTick) / size::kTick;
}

Color tick_color(const PlotStyle& style) {
  return style.theme->muted;
}

TextStyle tick_style(const PlotStyle& style) {
  return {Face::label, style.text(size::kTick), tick_color(style), Align::left};
}

struct TickLine {
  TextLine base, superscript;
  double advance = 0;
};

TickLine lay_out_tick(const Tick& tick, const PlotStyle& style) {
  TextStyle text = tick_style(style);
  TickLine line{lay_out_text(*style.fonts, tick.label, text), {}, 0};
  line.advance = line.base.advance;
  if (!tick.superscript.empty()) {
    text.size *= kSuperscriptScale;
    line.superscript = lay_out_text(*style.fonts, tick.superscript, text);
    line.advance += line.superscript.advance;
  }
  return line;
}

double widest_label(const std::vector<Tick>& ticks, const PlotStyle& style) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, lay_out_tick(tick, style).advance);
  return widest;
}

// As many as stand `pitch` apart; few of a scale rather closer, but at `least` apart.
int most_labels(const Axis& axis, double length, double pitch, double least) {
  const bool is_log = axis.scale == Scale::log;
  const int fewest = std::min(is_log ? int(kFewestOfScale) : kFewestLabels, std::max(int(kFewestOfScale), int(length / least) + 1));
  return std::clamp(int(length / pitch), fewest, is_log ? kMostLog : kMostLinear);
}

// A lone number is no scale: of finer ticks those have theirs that stand `pitch` apart, zero among them, even where that are two.
std::vector<Tick> thinned_ticks(const Axis& axis, double length, double pitch) {
  std::vector<Tick> ticks = ticks_of(axis, kMostLinear);
  if (ticks.size() < kFewestOfScale) return ticks;
  const double step = ticks[1].value - ticks[0].value;
  const auto labelled = [&](long stride) {
    return std::count_if(ticks.begin(), ticks.end(), [&](const Tick& tick) { return std::lround(tick.value / step) % stride == 0; });
  };
  long stride = 1;
  while (double(stride) * step / (axis.high - axis.low) * length < pitch && labelled(stride + 1) >= long(kFewestOfScale)) ++stride;
  for (Tick& tick : ticks)
    if (std::lround(tick.value / step) % stride != 0) tick.label = tick.superscript = "";
  return ticks;
}

// Of decades without a number as many as stand apart, at even steps between those that have one.
std::vector<Tick> without_comb(std::vector<Tick> ticks, const Axis& axis, double length) {
  if (axis.scale != Scale::log || !axis.at.empty()) return ticks;
  const auto exponent = [](const Tick& tick) { return std::lround(std::log10(tick.value)); };
  const double decade = length / (std::log10(axis.high) - std::log10(axis.low));
  const auto is_labelled = [](const Tick& tick) { return !tick.label.empty(); };
  const auto first = std::ranges::find_if(ticks, is_labelled);
  const auto second = first == ticks.end() ? first : std::find_if(first + 1, ticks.end(), is_labelled);
  if (!(decade < kDecadeApart) || second == ticks.end()) return ticks;
  const long stride = exponent(*second) - exponent(*first);
  long step = 1;
  while (step < stride && (stride % step != 0 || double(step) * decade < kDecadeApart)) ++step;
  std::erase_if(ticks, [&](const Tick& tick) { return tick.label.empty() && exponent(tick) % step != 0; });
  return ticks;
}

// At most so many, but at least three where a finer step has them and they stand `pitch` apart on the axis' `length`.
std::vector<Tick> enough_ticks(const Axis& axis, int most, double length, double pitch) {
  std::vector<Tick> ticks = ticks_of(axis, most);
  for (int more = most + 1; axis.scale != Scale::log && int(ticks.size()) < kFewestLabels && more <= kMostLinear + 1;
       ++more) {
    std::vector<Tick> finer = ticks_of(axis, more);
    const double step = finer.size() > 1 ? finer[1].value - finer[0].value : 0;
    if (step / (axis.high - axis.low) * length < pitch) break;
    ticks = std::move(finer);
  }
  if (axis.scale == Scale::log) return without_comb(std::move(ticks), axis, length);
  return ticks.size() < kFewestOfScale ? thinned_ticks(axis, length, pitch) : ticks;
}

Tick last_tick(const Axis& axis) {
  return {axis.high, format_significant(axis.high, 4) + "\u2009" + axis.last_unit, ""};
}

double place_on(const Axis& axis, double value) {
  if (axis.scale != Scale::log) return (value - axis.low) / (axis.high - axis.low);
  return (std::log10(value) - std::log10(axis.low)) / (std::log10(axis.high) - std::log10(axis.low));
}

// From the last number on, those that would touch the one behind them have none; two stay, the first and the last.
std::vector<Tick> without_touching(std::vector<Tick> ticks, const Axis& axis, double width, const PlotStyle& style) {
  const double air = kLeastAir * style.text(size::kTick);
  std::vector<std::size_t> kept, labelled;
  double free = std::numeric_limits<double>::infinity();
  for (std::size_t i = ticks.size(); i-- > 0;) {
    if (ticks[i].label.empty()) continue;
    labelled.push_back(i);
    const double at = place_on(axis, ticks[i].value) * width, half = lay_out_tick(ticks[i], style).advance / 2;
    if (at + half > free) continue;
    kept.push_back(i);
    free = at - half - air;
  }
  if (kept.size() < kFewestOfScale && labelled.size() >= kFewestOfScale) kept = {labelled.front(), labelled.back()};
  for (std::size_t i = 0; i < ticks.size(); ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) ticks[i].label = ticks[i].superscript = "";
  return ticks;
}

// At values that are given: as many as stand `apart` on the axis' `length`, the first and the last among them where that can be.
std::vector<Tick> given_ticks(const Axis& axis, double length, double apart) {
  const std::vector<Tick> all = ticks_of(axis, int(axis.at.size()));
  const std::size_t gaps = all.size() - 1;
  std::size_t every = 1;
  const auto is_close = [&] { return gaps > 0 && std::abs(place_on(axis, all[gaps].value) - place_on(axis, all[0].value)) * length * double(every) / double(gaps) < apart; };
  while (every < gaps && (is_close() || (gaps % every != 0 && gaps / every < 3))) ++every;
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < all.size(); i += every) ticks.push_back(all[i]);
  return ticks;
}

std::vector<Tick> x_ticks(const Axis& axis, double width, const PlotStyle& style) {
  if (!axis.at.empty()) return given_ticks(axis, width, widest_label(ticks_of(axis, int(axis.at.size())), style) + style.text(size::kTick));
  const double pitch = kPitchX * widest_label(ticks_of(axis, kMostLog), style);
  const double apart = std::max(pitch, 1e-3);
  std::vector<Tick> ticks = enough_ticks(axis, most_labels(axis, width, apart, apart / kPitchX), width, pitch);
  if (axis.last_unit.empty()) return without_touching(std::move(ticks), axis, width, style);
  // Numbers that the last one would touch give way to it.
  const Tick last = last_tick(axis);
  const double per_value = width / (axis.high - axis.low), air = kLastAir * style.text(size::kTick);
  const double taken = lay_out_tick(last, style).advance / 2 + air;
  std::erase_if(ticks, [&](const Tick& tick) {
    return (axis.high - tick.value) * per_value < taken + lay_out_tick(tick, style).advance / 2;
  });
  ticks.push_back(last);
  return ticks;
}

// Whether numbers do not lie on one another.
bool stand_apart(const std::vector<Tick>& ticks, const Axis& axis, double length, double apart) {
  std::optional<double> before;
  for (const Tick& tick : ticks) {
    if (tick.label.empty()) continue;
    if (before && (tick.value - *before) / (axis.high - axis.low) * length < apart) return false;
    before = tick.value;
  }
  return true;
}

// Numbers at the first and the last tick only.
std::vector<Tick> with_ends_alone(std::vector<Tick> ticks) {
  for (std::size_t i = 1; i + 1 < ticks.size(); ++i) ticks[i].label = ticks[i].superscript = "";
  return ticks;
}

// Of an axis that has no room for two the number nearest to its middle.
std::vector<Tick> one_number(const Axis& axis) {
  std::vector<Tick> ticks = ticks_of(axis, kFewestLabels);
  const double middle = (axis.low + axis.high) / 2;
  const auto nearest = std::min_element(ticks.begin(), ticks.end(), [&](const Tick& a, const Tick& b) {
    return std::abs(a.value - middle) < std::abs(b.value - middle);
  });
  for (auto tick = ticks.begin(); tick != ticks.end(); ++tick)
    if (tick != nearest) tick->label = tick->superscript = "";
  return ticks;
}

// Three numbers at finer round values, with ticks alone between them, where these stand `pitch` apart; else `ticks`.
std::vector<Tick> three_numbers(std::vector<Tick> ticks, const Axis& axis, double length, double pitch) {
  const auto numbers = std::ranges::count_if(ticks, [](const Tick& tick) { return !tick.label.empty(); });
  if (axis.scale != Scale::linear || numbers >= kFewestLabels) return ticks;
  for (int most = kMostLinear; most <= kMostThinned; ++most) {
    std::vector<Tick> finer = ticks_of(axis, most);
    const long count = long(finer.size());
    for (long stride = 1; (kFewestLabels - 1) * stride < count; ++stride) {
      if (double(stride) * (finer[1].value - finer[0].value) / (axis.high - axis.low) * length < pitch) continue;
      // Zero has its number; else they stand in the middle.
      long first = ((count - 1) % stride) / 2;
      for (long i = 0; i < count; ++i)
        if (finer[std::size_t(i)].value == 0) first = i % stride;
      if ((count - 1 - first) / stride + 1 < kFewestLabels) continue;
      for (long i = 0; i < count; ++i)
        if ((i - first) % stride != 0) finer[std::size_t(i)].label = finer[std::size_t(i)].superscript = "";
      return finer;
    }
  }
  return ticks;
}

std::vector<Tick> y_ticks(const Axis& axis, double height, const PlotStyle& style) {
  const double em = style.text(size::kTick);
  if (!axis.at.empty()) return given_ticks(axis, height, kLeastPitchY * em);
  std::vector<Tick> ticks = enough_ticks(axis, most_labels(axis, height, kPitchY * em, kLeastPitchY * em), height, kLeastPitchY * em);
  ticks = three_numbers(std::move(ticks), axis, height, kLeastPitchY * em);
  if (axis.scale == Scale::log || stand_apart(ticks, axis, height, kLeastAcross * em)) return ticks;
  ticks = with_ends_alone(ticks_of(axis, kFewestLabels));
  return stand_apart(ticks, axis, height, kLeastAcross * em) && ticks.size() > 1 ? ticks : one_number(axis);
}

void draw_line(Picture& picture, Point a, Point b, double width, Color color) {
  picture.add(Capsule{a, b, width / 2, {color, {}, 0}});
}

double value_on(const Axis& axis, double place) {
  if (axis.scale != Scale::log) return axis.low + place * (axis.high - axis.low);
  const double low = std::log10(axis.low), high = std::log10(axis.high);
  return std::pow(10.0, low + place * (high - low));
}

bool is_shown(const Axis& axis, double value) {
  return std::isfinite(value) && (axis.scale != Scale::log || value > 0);
}

bool has_zero_inside(const Axis& axis) {
  return axis.scale != Scale::log && axis.low < 0 && axis.high > 0;
}

void draw_grid(Picture& picture, const PlotFrame& f, const std::vector<Tick>& xs, const std::vector<Tick>& ys,
               const Theme& theme) {
  for (const Tick& tick : xs)
    if (!tick.label.empty())
      draw_line(picture, {f.at_x(tick.value), f.box.y0}, {f.at_x(tick.value), f.box.y1}, size::kPlotGrid,
                theme.grid);
  for (const Tick& tick : ys)
    if (!tick.label.empty())
      draw_line(picture, {f.box.x0, f.at_y(tick.value)}, {f.box.x1, f.at_y(tick.value)}, size::kPlotGrid,
                theme.grid);
  if (has_zero_inside(f.y))
    draw_line(picture, {f.box.x0, f.at_y(0)}, {f.box.x1, f.at_y(0)}, size::kPlotFrame, theme.muted);
  if (has_zero_inside(f.x))
    draw_line(picture, {f.at_x(0), f.box.y0}, {f.at_x(0), f.box.y1}, size::kPlotFrame, theme.muted);
}

void draw_frame_line(Picture& picture, const Rect& box, const Theme& theme) {
  const Point corners[] = {{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
  for (std::size_t i = 0; i < 4; ++i)
    draw_line(picture, corners[i], corners[(i + 1) % 4], size::kPlotFrame, theme.rule);
}

// Half as long where no number stands.
double tick_length(const Tick& tick) {
  return tick.label.empty() ? size::kPlotTick / 2 : size::kPlotTick;
}

// The middle of the numbers below the frame.
double tick_row(const PlotFrame& f, const PlotStyle& style) {
  return f.box.y0 - size::kPlotTick - kTickToLabel -
         kCapHeight * style.text(size::kTick) * (1 + kSuperscriptUp) / 2;
}

// Half of the last number hangs over the end of the axis.
double beyond_end(const Axis& x, const PlotStyle& style) {
  return (x.last_unit.empty() ? widest_label(ticks_of(x, kMostLog), style) : lay_out_tick(last_tick(x), style).advance) / 2;
}

void draw_x_ticks(Picture& picture, const PlotFrame& f, const std::vector<Tick>& ticks,
                  const PlotStyle& style) {
  const double middle = tick_row(f, style);
  for (const Tick& tick : ticks) {
    const double x = f.at_x(tick.value);
    draw_line(picture, {x, f.box.y0}, {x, f.box.y0 - tick_length(tick)}, size::kPlotFrame,
              style.theme->muted);
    if (tick.label.empty()) continue;
    draw_tick_label(picture, tick, {x, middle}, Align::center, style);
  }
}

void draw_y_ticks(Picture& picture, const PlotFrame& f, const std::vector<Tick>& ticks,
                  const PlotStyle& style) {
  for (const Tick& tick : ticks) {
    const double y = f.at_y(tick.value);
    draw_line(picture, {f.box.x0, y}, {f.box.x0 - tick_length(tick), y}, size::kPlotFrame,
              style.theme->muted);
    if (tick.label.empty()) continue;
    draw_tick_label(picture, tick, {f.box.x0 - size::kPlotTick - kTickToLabel, y}, Align::right, style);
  }
}

}  // namespace

double tick_label_width(const Tick& tick, const PlotStyle& style) {
  return lay_out_tick(tick, style).advance;
}

void draw_tick_label(Picture& picture, const Tick& tick, Point at, Align align, const PlotStyle& style) {
  const TickLine line = lay_out_tick(tick, style);
  const double em = style.text(size::kTick);
  const double shift = align == Align::left ? 0 : align == Align::center ? line.advance / 2 : line.advance;
  const Point left = {at.x - shift, at.y - kCapHeight * em / 2};
  draw_text(picture, line.base, left);
  draw_text(picture, line.superscript, {left.x + line.base.advance, left.y + kSuperscriptUp * em});
}

double PlotStyle::text(double size) const {
  return scaled(size, text_scale);
}

bool PlotFrame::can_show(Point data) const {
  return is_shown(x, data.x) && is_shown(y, data.y);
}

double PlotFrame::at_x(double value) const {
  return box.x0 + place_on(x, value) * box.width();
}

double PlotFrame::at_y(double value) const {
  return box.y0 + place_on(y, value) * box.height();
}

Point PlotFrame::at(Point data) const {
  return {at_x(data.x), at_y(data.y)};
}

Point PlotFrame::data_at(Point page) const {
  return {value_on(x, (page.x - box.x0) / box.width()), value_on(y, (page.y - box.y0) / box.height())};
}

double title_above_frame(const PlotStyle& style) {
  return kTitleAbove * style.text(size::kTick) / size::kTick;
}

double height_around_frame(const PlotStyle& style) {
  return size::kPlotTick + kTickToLabel + style.text(size::kTick) + style.text(size::kAxis) + title_above_frame(style);
}

PlotFrame lay_out_plot(const Rect& area, const Axis& x, const Axis& y, const PlotStyle& style) {
  const double tick = style.text(size::kTick), title = style.text(size::kAxis);
  PlotFrame frame{x, y, area};
  Rect& box = frame.box;
  box.y0 += size::kPlotTick + kTickToLabel + tick;
  if (!x.title.empty()) box.y0 += label_to_title(style) + title;
  box.y1 -= y.title.empty() ? tick / 2 : title + title_above_frame(style);
  box.x0 += size::kPlotTick + kTickToLabel + widest_label(y_ticks(y, box.height(), style), style);
  box.x1 -= beyond_end(x, style);
  return frame;
}

Point end_of_numbers(const PlotFrame& frame, const PlotStyle& style) {
  return {frame.box.x1 + beyond_end(frame.x, style), tick_row(frame, style) - kCapHeight * style.text(size::kTick) / 2};
}

void draw_axes(Picture& picture, const PlotFrame& frame, const PlotStyle& style) {
  const std::vector<Tick> xs = x_ticks(frame.x, frame.box.width(), style);
  const std::vector<Tick> ys = y_ticks(frame.y, frame.box.height(), style);
  draw_grid(picture, frame, xs, ys, *style.theme);
  draw_frame_line(picture, frame.box, *style.theme);
  draw_x_ticks(picture, frame, xs, style);
  draw_y_ticks(picture, frame, ys, style);

  const double em = style.text(size::kAxis);
  const TextStyle text{Face::label, em, style.theme->ink, Align::center};
  const double below =
      size::kPlotTick + kTickToLabel + style.text(size::kTick) + label_to_title(style) + kCapHeight * em;
  draw_text(picture, lay_out_words(*style.fonts, frame.x.title, text),
            {(frame.box.x0 + frame.box.x1) / 2, frame.box.y0 - below});
  const double labels = widest_label(ys, style) + kTickToLabel + size::kPlotTick;
  draw_text(picture,
            lay_out_words(*style.fonts, frame.y.title, {Face::label, em, style.theme->ink, Align::left}),
            {frame.box.x0 - labels, frame.box.y1 + title_above_frame(style)});
}

void draw_cursor(Picture& picture, const PlotFrame& frame, double x, Color color) {
  if (!(x >= frame.x.low && x <= frame.x.high)) return;
  draw_line(picture, {frame.at_x(x), frame.box.y0}, {frame.at_x(x), frame.box.y1}, size::kPlotCursor, color);
}

// Colours for up to twelve curves in one plot. Contrast with the background is at least 3.5; colour is never
// the only cue: markers differ, and so do the dashes of neighbours. Further curves take the colours again with
// other markers and dashes.

namespace {

constexpr std::array<std::uint32_t, kCurveLooks> kOnLight = {0x0072B2, 0xC25700, 0x005F46, 0x873C56,
                                                             0x5159FD, 0x7D700F, 0xC2378A, 0x00828F,
                                                             0x7A3FB0, 0x8A5A2B, 0x1A1A1A, 0x5F6670};
constexpr std::array<std::uint32_t, kCurveLooks> kOnDark = {0x56B4E9, 0xE69F00, 0x2FCB9C, 0xE04F9F,
                                                            0x8F9BFF, 0xC4FA58, 0xFF9DB8, 0x4FD8E8,
                                                            0xC8A2F5, 0xD2A679, 0xF2F2F2, 0xA9B0BA};

}  // namespace

Color variant_color(const Theme& theme, int i, int count) {
  if (count == 2) return i == 0 ? theme.side_a : theme.side_b;
  return i < theme.variants ? theme.variant[std::size_t(i)] : curve_style(i, theme).color;
}

CurveStyle curve_style(int index, const Theme& theme, double text_scale) {
  const int look = index % kCurveLooks, round = index / kCurveLooks;
  const auto& colors = is_dark(theme) ? kOnDark : kOnLight;
  CurveStyle style;
  style.color = color_of(colors[std::size_t(look)]);
  style.marker = Marker(1 + (look + 5 * round) % kCurveLooks);
  style.dash = Dash((look + round) % 4);
  style.width *= theme.lines;
  style.marker_size = size::kMarker * std::max(1.0, text_scale);
  return style;
}

}  // namespace chainreel

// Colours: ten of the map `viridis` (S. van der Walt, N. Smith, 2015, CC0), linear in between.
#include "draw/charts/stability_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/format.hpp"
#include "picture/plot_hatch.hpp"

namespace chainreel {
namespace {

constexpr std::array<std::uint32_t, 10> kViridis = {0x440154, 0x482878, 0x3E4989, 0x31688E, 0x26828E,
                                                    0x1F9E89, 0x35B779, 0x6ECE58, 0xB5DE2B, 0xFDE725};
constexpr double kBarGap = 0.045, kSmallBarGap = 0.025, kBarWidth = 0.035, kBarToLabel = 0.016;
constexpr int kBarSteps = 128;
constexpr double kSwatch = 0.044, kSwatchToText = 0.012;
constexpr double kDotOfCell = 0.16, kLargestDot = 0.0075, kDotEdge = 0.0022;  // radius: of the cell's shorter side, and at most
constexpr double kHalo = 0.0085, kBoundaryLine = 0.0040;
constexpr double kLabelPad = 0.010, kLabelDistance = 0.030;

Axis value_axis(const StabilityMap& data) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const MapCell& cell : data.cells) {
    if (cell.failed || !std::isfinite(cell.error)) continue;
    low = std::min(low, cell.error);
    high = std::max(high, cell.error);
  }
  if (!(high >= low)) low = 0, high = 1;
  // All alike: their number is in the middle.
  if (!(high > low)) {
    const double around = low != 0 ? 0.1 * std::abs(low) : 1;
    low -= around, high += around;
  }
  return rounded_out({Scale::linear, low, high, data.error_title});
}

bool is_pale(const StabilityMap& data, const MapCell& cell) {
  return !cell.failed && !data.is_linear && !(cell.error <= data.most);
}

// Whole decades around the errors of the runs that held.
Axis error_axis(const StabilityMap& data) {
  if (data.is_linear) return value_axis(data);
  double low = HUGE_VAL, high = 0;
  for (const MapCell& cell : data.cells) {
    if (cell.failed || !(cell.error > 0) || !std::isfinite(cell.error) || is_pale(data, cell)) continue;
    low = std::min(low, cell.error);
    high = std::max(high, cell.error);
  }
  if (!(high > 0)) low = 0.1 * std::min(data.most, 1.0), high = std::min(data.most, 1.0);
  return rounded_out({Scale::log, low, high, data.error_title});
}

Color failed_color(const Theme& theme) {
  return theme.grid;
}

// Beyond the end of the colours: the last of them, hardly there.
Color pale_color(const Theme& theme) {
  constexpr double kThere = 0.3;
  const Color last = map_color(1), page = theme.background;
  const auto mix = [](std::uint8_t from, std::uint8_t to) { return std::uint8_t(std::lround(from + kThere * (double(to) - from))); };
  return {mix(page.r, last.r), mix(page.g, last.g), mix(page.b, last.b), 1};
}

Cells cells_of(const StabilityMap& data, const Axis& errors, const Rect& box, const Theme& theme) {
  Cells cells{box, data.nx, data.ny, {}};
  const double low = std::log10(errors.low), decades = std::log10(errors.high) - low;
  for (const MapCell& cell : data.cells) {
    const double share = data.is_linear   ? (cell.error - errors.low) / (errors.high - errors.low)
                         : cell.error > 0 ? (std::log10(cell.error) - low) / decades
                                          : 0;
    cells.colors.push_back(cell.failed ? failed_color(theme) : is_pale(data, cell) ? pale_color(theme) : map_color(share));
  }
  return cells;
}

void draw_failed_hatch(Picture& picture, const StabilityMap& data, const Rect& box, const Theme& theme) {
  std::vector<bool> failed;
  for (const MapCell& cell : data.cells) failed.push_back(cell.failed);
  draw_hatch(picture, box, data.nx, data.ny, failed, theme.base);
}

// In the middle of each cell that is doubtful: light with a dark edge, seen on any colour.
void draw_doubtful_dots(Picture& picture, const StabilityMap& data, const Rect& box) {
  const double width = box.width() / data.nx, height = box.height() / data.ny;
  const double radius = std::min(kDotOfCell * std::min(width, height), kLargestDot);
  for (std::size_t i = 0; i < data.cells.size(); ++i) {
    if (!data.cells[i].doubtful) continue;
    const Point middle{box.x0 + (double(i % std::size_t(data.nx)) + 0.5) * width, box.y0 + (double(i / std::size_t(data.nx)) + 0.5) * height};
    picture.add(Ellipse{middle, {radius, 0}, {0, radius}, {Color{255, 255, 255, 1}, Color{0, 0, 0, 1}, std::min(kDotEdge, radius / 2)}});
  }
}

void draw_boundary_line(Picture& picture, const PlotFrame& frame, const MapBoundary& boundary,
                        const Theme& theme) {
  draw_curve(picture, frame, boundary.points, {theme.background, kHalo, Dash::solid, Marker::none}, theme);
  draw_curve(picture, frame, boundary.points, {theme.ink, kBoundaryLine, Dash::solid, Marker::none}, theme);
}

// Even steps along the boundary inside the frame.
std::vector<Point> page_points(const PlotFrame& frame, const MapBoundary& boundary) {
  constexpr double kStep = 0.004;
  std::vector<Point> found;
  for (std::size_t i = 0; i + 1 < boundary.points.size(); ++i) {
    if (!frame.can_show(boundary.points[i]) || !frame.can_show(boundary.points[i + 1])) continue;
    const Point a = frame.at(boundary.points[i]), d = frame.at(boundary.points[i + 1]) - a;
    const int steps = std::clamp(int(std::sqrt(d.x * d.x + d.y * d.y) / kStep) + 1, 1, 1000);
    for (int k = 0; k <= steps; ++k) {
      const Point p = a + (double(k) / steps) * d;
      if (p.x >= frame.box.x0 && p.x <= frame.box.x1 && p.y >= frame.box.y0 && p.y <= frame.box.y1)
        found.push_back(p);
    }
  }
  return found;
}

bool touches(const Rect& box, const std::vector<Point>& points) {
  return std::any_of(points.begin(), points.end(),
                     [&](Point p) { return p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1; });
}

// Beside the boundary, as near to its middle as there is a place that it does not cross.
void draw_boundary_label(Picture& picture, const PlotFrame& frame, const MapBoundary& boundary,
                         std::vector<Rect>& taken, const ChartLook& look) {
  const std::vector<Point> line = page_points(frame, boundary);
  if (line.empty() || boundary.label.empty()) return;
  const TextStyle style{Face::math, look.plot_style().text(size::kAxis), look.theme->ink, Align::left};
  const TextLine text = lay_out_math(*look.fonts, boundary.label, style);
  const double width = text.advance + 2 * kLabelPad, height = text.box.height() + 2 * kLabelPad;
  const std::size_t middle = line.size() / 2;
  for (std::size_t away = 0; away <= middle; away += 3) {
    for (const std::size_t at : {middle - away, std::min(middle + away, line.size() - 1)}) {
      for (const Point side :
           {Point{1, 1}, Point{1, -1}, Point{-1, 1}, Point{-1, -1}, Point{1, 0}, Point{-1, 0}}) {
        const Point c = line[at] + Point{side.x * (kLabelDistance + width / 2),
                                         side.y * (kLabelDistance / 2 + height / 2)};
        const Rect box = {c.x - width / 2, c.y - height / 2, c.x + width / 2, c.y + height / 2};
        const bool inside = box.x0 > frame.box.x0 + kLabelPad && box.x1 < frame.box.x1 - kLabelPad &&
                            box.y0 > frame.box.y0 + kLabelPad && box.y1 < frame.box.y1 - kLabelPad;
        const bool free = std::none_of(taken.begin(), taken.end(), [&](const Rect& r) {
          return r.x0 < box.x1 && box.x0 < r.x1 && r.y0 < box.y1 && box.y0 < r.y1;
        });
        if (!inside || !free || touches(box, line)) continue;
        taken.push_back(box);
        Polygon plate;
        plate.corners = {Point{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
        plate.count = 4;
        plate.paint = {look.theme->background, look.theme->ink, size::kPlotFrame};
        picture.add(plate);
        draw_text(picture, text, {box.x0 + kLabelPad, box.y0 + kLabelPad - text.box.y0});
        return;
      }
    }
  }
}

// Hundreds of per cent as plain numbers: an exponent would reach into the title above.
std::vector<Tick> ticks_of_bar(const Axis& errors) {
  std::vector<Tick> ticks = ticks_of(errors, 6);
  for (Tick& tick : ticks)
    if (!tick.superscript.empty() && tick.value > 1 && tick.value < 1e4) tick = {tick.value, format_significant(tick.value, 1), ""};
  return ticks;
}

void draw_color_bar(Picture& picture, const Rect& bar, const Axis& errors, const ChartLook& look) {
  const PlotStyle style = look.plot_style();
  Cells cells{bar, 1, kBarSteps, {}};
  for (int i = 0; i < kBarSteps; ++i) cells.colors.push_back(map_color((i + 0.5) / kBarSteps));
  picture.add(std::move(cells));
  const PlotFrame frame{errors, errors, bar};
  for (const Tick& tick : ticks_of_bar(errors)) {
    const double y = frame.at_y(tick.value);
    if (tick.label.empty()) continue;
    picture.add(Capsule{
        {bar.x1, y}, {bar.x1 + size::kPlotTick, y}, size::kPlotFrame / 2, {look.theme->muted, {}, 0}});
    draw_tick_label(picture, tick, {bar.x1 + kBarToLabel, y}, Align::left, style);
  }
}

double widest_tick(const Axis& errors, const PlotStyle& style) {
  double widest = 0;
  for (const Tick& tick : ticks_of_bar(errors)) widest = std::max(widest, tick_label_width(tick, style));
  return widest;
}

// What cells are that have no colour of the bar, or a dot; none where no cell is.
class MapKey {
 public:
  MapKey(const StabilityMap& data, const ChartLook& look) : look_(look), style_(look.plot_style()) {
    const auto any = [&data](const auto& is) { return std::ranges::any_of(data.cells, is); };
    if (any([](const MapCell& cell) { return cell.failed; })) words_[kHatched] = data.hatched;
    if (any([&data](const MapCell& cell) { return is_pale(data, cell); })) words_[kPale] = data.pale;
    if (any([](const MapCell& cell) { return cell.doubtful; })) words_[kDotted] = data.dotted;
  }

  bool is_empty() const { return std::ranges::all_of(words_, &std::string::empty); }
  double pitch() const { return kSwatch + style_.text(size::kTick); }
  double width_of(std::size_t kind) const { return words_[kind].empty() ? 0 : kSwatch + kSwatchToText + line_of(kind).advance; }
  double widest() const { return std::max({width_of(kHatched), width_of(kPale), width_of(kDotted)}); }

  // One below the other from `bottom` up; returns where they end.
  double draw_column(Picture& picture, double left, double bottom) const {
    for (std::size_t kind = 0; kind < words_.size(); ++kind)
      if (!words_[kind].empty()) draw_one(picture, kind, {left, bottom}), bottom += pitch();
    return bottom;
  }

  // One beside the other, up to `right`.
  void draw_row(Picture& picture, double right, double bottom) const {
    for (std::size_t kind = words_.size(); kind-- > 0;)
      if (!words_[kind].empty()) draw_one(picture, kind, {right - width_of(kind), bottom}), right -= width_of(kind) + size::kGutter;
  }

 private:
  enum Kind : std::size_t { kHatched, kPale, kDotted };

  TextLine line_of(std::size_t kind) const { return lay_out_text(*look_.fonts, words_[kind], {Face::label, style_.text(size::kTick), look_.theme->ink, Align::left}); }

  void draw_one(Picture& picture, std::size_t kind, Point at) const {
    const Rect swatch = {at.x, at.y, at.x + kSwatch, at.y + kSwatch};
    const Color color = kind == kHatched ? failed_color(*look_.theme) : kind == kPale ? pale_color(*look_.theme) : map_color(0.5);
    picture.add(Cells{swatch, 1, 1, {color}});
    if (kind == kHatched) draw_hatch(picture, swatch, 1, 1, {true}, look_.theme->base);
    if (kind == kDotted) {
      StabilityMap one;
      one.nx = one.ny = 1;
      one.cells.resize(1);
      one.cells.front().doubtful = true;
      draw_doubtful_dots(picture, one, swatch);
    }
    draw_text(picture, line_of(kind), {swatch.x1 + kSwatchToText, (swatch.y0 + swatch.y1 - kCapHeight * style_.text(size::kTick)) / 2});
  }

  const ChartLook& look_;
  PlotStyle style_;
  std::array<std::string, 3> words_;
};

// The bar stands beside the map. Its title ends with the page, in the row of the upward axis' title where both have room, else above; on small pages
// the keys have a row there, too: a column of words would take the map's width.
class MapLegend {
 public:
  MapLegend(const StabilityMap& data, const Axis& errors, const Rect& area, const ChartLook& look)
      : errors_(errors), look_(look), style_(look.plot_style()), key_(data, look), area_(area) {
    const TextStyle words{Face::label, style_.text(size::kAxis), look.theme->ink, Align::left};
    title_ = lay_out_words(*look.fonts, errors.title, words);
    const double of_axis = lay_out_words(*look.fonts, data.y.title, words).advance;
    has_own_row_ = of_axis + size::kGutter + title_.advance > area.width();
    keys_above_ = look.is_small && !key_.is_empty();
    gap_ = look.is_small ? kSmallBarGap : kBarGap;
  }

  double width() const { return gap_ + std::max(kBarWidth + kBarToLabel + widest_tick(errors_, style_), keys_above_ ? 0 : key_.widest()); }
  double rows_above() const { return (has_own_row_ ? title_row() : 0) + (keys_above_ ? key_.pitch() : 0); }

  void draw(Picture& picture, const PlotFrame& map) const {
    const double left = map.box.x1 + gap_;
    const double bottom = keys_above_ ? map.box.y0 : key_.draw_column(picture, left, map.box.y0);
    draw_color_bar(picture, {left, bottom, left + kBarWidth, map.box.y1}, errors_, look_);
    double base = map.box.y1 + title_above_frame(style_) + (has_own_row_ ? title_row() : 0);
    draw_text(picture, title_, {area_.x1 - title_.advance, base});
    if (keys_above_) key_.draw_row(picture, area_.x1, base + style_.text(size::kAxis) + kSwatchToText);
  }

 private:
  double title_row() const { return kLinePitch * style_.text(size::kAxis); }

  Axis errors_;
  const ChartLook& look_;
  PlotStyle style_;
  MapKey key_;
  Rect area_;
  TextLine title_;
  bool has_own_row_ = false, keys_above_ = false;
  double gap_ = 0;
};

}  // namespace

Color map_color(double share) {
  if (!(share > 0)) share = 0;  // also where it is no number
  const double place = std::min(share, 1.0) * double(kViridis.size() - 1);
  const std::size_t i = std::min(std::size_t(place), kViridis.size() - 2);
  const Color a = color_of(kViridis[i]), b = color_of(kViridis[i + 1]);
  const auto mix = [t = place - double(i)](std::uint8_t from, std::uint8_t to) {
    return std::uint8_t(std::lround(from + t * (double(to) - from)));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b), 1};
}

std::vector<std::vector<Point>> edges_between(const std::vector<std::optional<bool>>& cells, int nx, int ny) {
  const auto differ = [&](int xa, int ya, int xb, int yb) {
    const auto &a = cells[std::size_t(ya * nx + xa)], &b = cells[std::size_t(yb * nx + xb)];
    return a && b && *a != *b;
  };
  using GridCorner = std::pair<int, int>;
  std::multimap<GridCorner, GridCorner> edges;  // both ways
  const auto add = [&](GridCorner a, GridCorner b) { edges.emplace(a, b), edges.emplace(b, a); };
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      if (x > 0 && differ(x - 1, y, x, y)) add({x, y}, {x, y + 1});
      if (y > 0 && differ(x, y - 1, x, y)) add({x, y}, {x + 1, y});
    }
  const auto take = [&](GridCorner a, GridCorner b) {
    auto [begin, end] = edges.equal_range(a);
    edges.erase(std::find_if(begin, end, [&](const auto& edge) { return edge.second == b; }));
  };
  std::vector<std::vector<Point>> lines;
  while (!edges.empty()) {
    // From an end of a line where there is one; closed lines from anywhere.
    auto first = std::find_if(edges.begin(), edges.end(),
                              [&](const auto& edge) { return edges.count(edge.first) % 2 == 1; });
    GridCorner at = (first == edges.end() ? edges.begin() : first)->first;
    std::vector<Point> line{{double(at.first), double(at.second)}};
    for (auto next = edges.find(at); next != edges.end(); next = edges.find(at)) {
      const GridCorner to = next->second;
      take(at, to), take(to, at);
      at = to;
      line.push_back({double(at.first), double(at.second)});
    }
    lines.push_back(line);
  }
  return lines;
}

Picture stability_map(const StabilityMap& data, const ChartLook& look) {
  if (data.nx < 1 || data.ny < 1 || data.cells.size() != std::size_t(data.nx) * std::size_t(data.ny))
    throw Error(ExitCode::bad_input, "a map of " + std::to_string(data.nx) + "x" + std::to_string(data.ny) +
                                         " cells was given " + std::to_string(data.cells.size()));
  Picture picture;
  const Rect area = draw_chart_page(picture, {data.title, data.subtitle, data.footer}, look);
  const PlotStyle style = look.plot_style();
  const Axis errors = error_axis(data);
  const MapLegend legend(data, errors, area, look);
  PlotFrame frame = lay_out_plot({area.x0, area.y0, area.x1 - legend.width(), area.y1 - legend.rows_above()}, data.x, data.y, style);
  frame.box.x1 = area.x1 - legend.width();  // the last number may hang over below the bar
  require_room_for_axes(frame, look);
  draw_axes(picture, frame, style);
  picture.add(cells_of(data, errors, frame.box, *look.theme));
  draw_failed_hatch(picture, data, frame.box, *look.theme);
  draw_doubtful_dots(picture, data, frame.box);
  for (const MapBoundary& boundary : data.boundaries)
    draw_boundary_line(picture, frame, boundary, *look.theme);
  std::vector<Rect> taken;
  for (const MapBoundary& boundary : data.boundaries)
    draw_boundary_label(picture, frame, boundary, taken, look);
  legend.draw(picture, frame);
  return as_page(picture, look);
}

}  // namespace chainreel

#include "draw/charts/response_chart.hpp"

#include <algorithm>
#include <cmath>

#include "draw/charts/obstacles.hpp"
#include "picture/formula_words.hpp"

namespace chainreel {
namespace {

constexpr double kFlat = 1e-3;   // of its size: the least range that an axis has about curves that do not change
constexpr double kBeside = 0.04; // of the range in x: air beside the first and the last run
constexpr double kAirOfValues = 0.06;    // of the range in y: above the highest and below the lowest mark, so that none lies on the frame
constexpr double kSame = 1e-9;   // of their size: curves no farther apart are one
constexpr double kStrip = 1.9;   // of a mark: the height of the strip of crosses
constexpr double kLeastPanel = 9;  // ems of the numbers: the height with words below which a panel cannot be read
constexpr double kBesideLine = 0.008;

Axis y_axis(const ResponsePanel& panel) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const ResponseCurve& curve : panel.curves)
    for (const ResponsePoint& point : curve.points)
      if (point.y) low = std::min(low, *point.y), high = std::max(high, *point.y);
  if (!(low <= high)) low = 0, high = 1;
  if (panel.from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(high - low > kFlat * size)) {
    const double half = size > 0 ? kFlat * size : 0.5;
    low -= half, high += half;
  }
  const double air = kAirOfValues * (high - low);
  if (!(panel.from_zero && low == 0)) low -= air;
  return rounded_out({Scale::linear, low, high + air, panel.y_title});
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

bool are_same(const ResponseCurve& a, const ResponseCurve& b) {
  return std::ranges::equal(a.points, b.points, [](const ResponsePoint& p, const ResponsePoint& q) {
    return p.x == q.x && p.y.has_value() == q.y.has_value() && (!p.y || std::abs(*p.y - *q.y) <= kSame * std::abs(*p.y));
  });
}

// Curves that would lie over one another are one, which has all names.
ResponsePanel merged_curves(const ResponsePanel& panel) {
  ResponsePanel merged{panel.y_title, panel.from_zero, {}};
  for (const ResponseCurve& curve : panel.curves) {
    const auto same = std::ranges::find_if(merged.curves, [&](const ResponseCurve& one) { return are_same(one, curve); });
    if (same == merged.curves.end())
      merged.curves.push_back(curve);
    else
      same->title += ", " + curve.title;
  }
  return merged;
}

const ResponsePoint* last_mark(const ResponseCurve& curve) {
  const auto last = std::find_if(curve.points.rbegin(), curve.points.rend(), [](const ResponsePoint& point) { return point.y.has_value(); });
  return last == curve.points.rend() ? nullptr : &*last;
}

bool ends_with_the_runs(const ResponseCurve& curve) {
  return !curve.points.empty() && curve.points.back().y.has_value();
}

bool has_missing(const ResponsePanel& panel) {
  return !panel.curves.empty() && std::ranges::any_of(panel.curves.front().points, [](const ResponsePoint& point) { return !point.y; });
}

// One panel on the page.
class PanelDrawing {
 public:
  PanelDrawing(const ResponsePanel& panel, const ResponseChart& data, const Rect& area, bool has_x_title, const ChartLook& look)
      : panel_(merged_curves(panel)), data_(data), look_(look), style_(look.plot_style()), area_(area), is_named_(panel.curves.size() > 1) {
    std::vector<std::string> names;
    for (const ResponseCurve& curve : panel_.curves)
      if (ends_with_the_runs(curve)) names.push_back(curve.title);
    if (has_missing(panel_)) strip_ = kStrip * marker_size();
    const double labels = is_named_ && !names.empty() ? end_labels_width(names, style_) + kLabelGap : 0;
    Axis x = x_axis(data.x);
    if (!has_x_title) x.title.clear();
    frame_ = lay_out_plot({area.x0, area.y0, area.x1 - labels, area.y1 - strip_}, x, y_axis(panel_), style_);
    if (strip_ > 0) lay_out_lacks();
  }

  PlotFrame& frame() { return frame_; }

  void draw(Picture& picture) {
    require_room_for_axes(frame_, look_);
    PlotFrame axes = frame_;
    if (strip_ > 0) axes.y.title.clear();
    draw_axes(picture, axes, style_);
    taken_.inside = frame_.box;
    draw_edges(picture);
    if (strip_ > 0) draw_strip(picture);
    for (std::size_t i = 0; i < panel_.curves.size(); ++i) {
      draw_points(picture, panel_.curves[i], style_of(i));
      take(panel_.curves[i], int(i));
    }
    if (is_named_) draw_names(picture);
  }

 private:
  double marker_size() const { return size::kMarker * look_.text_scale; }

  CurveStyle style_of(std::size_t i) const {
    CurveStyle style = curve_style(int(i), *look_.theme, look_.text_scale);
    if (i < look_.theme->curve.size()) style.color = look_.theme->curve[i];  // a house style's
    return style;
  }

  // Lines join neighbours whose numbers are sound.
  void draw_points(Picture& picture, const ResponseCurve& curve, const CurveStyle& style) const {
    CurveStyle line = style;
    line.marker = Marker::none;
    std::vector<Point> joined;
    const auto draw_joined = [&] {
      if (joined.size() > 1) draw_curve(picture, frame_, joined, line, *look_.theme);
      joined.clear();
    };
    for (const ResponsePoint& point : curve.points)
      if (point.y && !point.is_doubtful)
        joined.push_back({point.x, *point.y});
      else
        draw_joined();
    draw_joined();
    for (const ResponsePoint& point : curve.points)
      if (point.y)
        draw_marker(picture, frame_.at({point.x, *point.y}), point.is_doubtful ? Marker::ring : style.marker, style.marker_size, style.color, look_.theme->background);
  }

  void take(const ResponseCurve& curve, int index) {
    std::optional<Point> before;
    for (const ResponsePoint& point : curve.points) {
      if (!point.y) {
        before.reset();
        continue;
      }
      const Point at = frame_.at({point.x, *point.y});
      taken_.lines.push_back({before.value_or(at), at, index});
      before = at;
    }
  }

  void draw_edges(Picture& picture) {
    double taken = -HUGE_VAL;
    int line = 0;
    for (const ResponseEdge& edge : data_.edges) {
      const double x = frame_.at_x(edge.x), em = style_.text(size::kTick);
      if (!(x >= frame_.box.x0 && x <= frame_.box.x1)) continue;
      const CurveStyle dashed{look_.theme->muted, size::kPlotLineSecondary, Dash::dashed, Marker::none};
      const Point ends[] = {{x, frame_.box.y0}, {x, frame_.box.y1 + strip_}};
      draw_path(picture, ends, dashed);
      taken_.lines.push_back({ends[0], ends[1], kNoCurve});
      const TextLine word = lay_out_text(*look_.fonts, edge.value, {Face::label, em, look_.theme->muted, Align::left});
      // To its left where the frame ends; one line lower where the last one's word still stands.
      const double left = x + kBesideLine + word.advance <= frame_.box.x1 ? x + kBesideLine : x - kBesideLine - word.advance;
      line = left < taken + kBesideLine ? line + 1 : 0;
      taken = std::max(taken, left + word.advance);
      const Point at{left, frame_.box.y1 - (1 + kLinePitch * line) * em - kBesideLine};
      draw_text(picture, word, at);
      taken_.boxes.push_back({at.x, at.y, at.x + word.advance, at.y + em});
    }
  }

  TextLine title_line() const { return lay_out_words(*look_.fonts, panel_.y_title, {Face::label, style_.text(size::kAxis), look_.theme->ink, Align::left}); }
  TextLine words_of(const ResponseLack& lack) const { return lay_out_text(*look_.fonts, lack.words, {Face::label, style_.text(size::kTick), look_.theme->muted, Align::left}); }
  double width_of(const ResponseLack& lack) const { return marker_size() + size::kMarkToText + words_of(lack).advance; }
  const ResponseLack& lack_of(const ResponsePoint& point) const { return data_.lacks[point.lack]; }

  // What the marks of the strip mean, those that occur: beside the title where there is room for all, else in rows of their own below it.
  void lay_out_lacks() {
    std::vector<const ResponseLack*> found;
    for (const ResponseLack& lack : data_.lacks)
      if (std::ranges::any_of(panel_.curves.front().points, [&](const ResponsePoint& point) { return !point.y && &lack_of(point) == &lack; })) found.push_back(&lack);
    double taken = 0;
    const double whole = frame_.box.x1 - area_.x0;
    lack_rows_ = {{}};
    for (const ResponseLack* lack : found) {
      const double width = width_of(*lack);
      if (taken > 0 && taken + size::kGutter + width > whole) lack_rows_.emplace_back(), taken = 0;
      taken += (taken > 0 ? size::kGutter : 0) + width;
      lack_rows_.back().push_back(lack);
    }
    const bool is_beside = lack_rows_.size() == 1 && title_line().advance + size::kGutter + taken <= whole;
    lack_rows_height_ = is_beside ? 0 : double(lack_rows_.size()) * kLinePitch * style_.text(size::kTick);
    frame_.box.y1 -= lack_rows_height_;
  }

  // Runs without a value stand above the axis, not on it, where they would be at its number; what they are is said above, at the right.
  void draw_strip(Picture& picture) const {
    constexpr double kStripOpacity = 0.14;
    const Rect strip{frame_.box.x0, frame_.box.y1, frame_.box.x1, frame_.box.y1 + strip_};
    picture.add(Cells{strip, 1, 1, {look_.theme->base.faded(kStripOpacity)}});
    for (const ResponsePoint& point : panel_.curves.front().points)
      if (!point.y) draw_lack(picture, lack_of(point), {frame_.at_x(point.x), (strip.y0 + strip.y1) / 2});
    const double base = strip.y1 + title_above_frame(style_), em = style_.text(size::kTick);
    draw_text(picture, title_line(), {area_.x0, base + lack_rows_height_});
    for (std::size_t row = 0; row < lack_rows_.size(); ++row) {
      const double y = base + double(lack_rows_.size() - 1 - row) * kLinePitch * em;
      double right = strip.x1;
      for (std::size_t i = lack_rows_[row].size(); i-- > 0;) {
        const ResponseLack& lack = *lack_rows_[row][i];
        const double left = right - width_of(lack);
        draw_lack(picture, lack, {left + marker_size() / 2, y + kCapHeight * em / 2});
        draw_text(picture, words_of(lack), {left + marker_size() + size::kMarkToText, y});
        right = left - size::kGutter;
      }
    }
  }

  void draw_lack(Picture& picture, const ResponseLack& lack, Point at) const {
    draw_marker(picture, at, lack.marker, marker_size(), lack.curve ? style_of(*lack.curve).color : look_.theme->muted, look_.theme->background);
  }

  // A leader from a mark before the last run would be read as a curve.
  void draw_names(Picture& picture) {
    std::vector<EndLabel> ends;
    for (std::size_t i = 0; i < panel_.curves.size(); ++i) {
      const ResponsePoint* const last = last_mark(panel_.curves[i]);
      if (last == nullptr) continue;
      const Point at = frame_.at({last->x, *last->y});
      if (ends_with_the_runs(panel_.curves[i]))
        ends.push_back({at, panel_.curves[i].title, style_of(i)});
      else
        draw_name_beside(picture, panel_.curves[i].title, style_of(i).color, at);
    }
    draw_end_labels(picture, frame_, ends, frame_.box.x1 + kLabelGap, style_);
  }

  // Where nothing else is; where there is no such place, to the right of the mark.
  void draw_name_beside(Picture& picture, const std::string& name, Color color, Point at) {
    const double em = style_.text(size::kTick), high = kCapHeight * em, off = marker_size() / 2 + 1.5 * kClearance;
    const TextLine words = lay_out_words(*look_.fonts, name, {Face::label_bold, em, color, Align::left});
    const double wide = words.advance;
    const Point corners[] = {{off, -high / 2}, {-off - wide, -high / 2}, {-wide / 2, off}, {off, off}, {-off - wide, off}, {-wide / 2, -off - high}, {off, -off - high}, {-off - wide, -off - high}};
    const auto box_at = [&](Point corner) { return Rect{at.x + corner.x, at.y + corner.y, at.x + corner.x + wide, at.y + corner.y + high}; };
    const auto free = std::ranges::find_if(corners, [&](Point corner) { return taken_.is_free(box_at(corner)); });
    const Point corner = free == std::end(corners) ? corners[0] : *free;
    draw_text(picture, words, at + corner);
    taken_.boxes.push_back(box_at(corner));
  }

  ResponsePanel panel_;
  const ResponseChart& data_;
  const ChartLook& look_;
  PlotStyle style_;
  Rect area_;
  bool is_named_;
  double strip_ = 0, lack_rows_height_ = 0;
  std::vector<std::vector<const ResponseLack*>> lack_rows_;
  PlotFrame frame_;
  Obstacles taken_;
};

// The page's words, and how many panels have room between them.
std::size_t panels_with_room(const ResponseChart& data, const Rect& area, const ChartLook& look) {
  const double each = kLeastPanel * look.plot_style().text(size::kTick) + size::kGutter;
  return std::clamp<std::size_t>(std::size_t((area.height() + size::kGutter) / each), 1, data.panels.size());
}

}  // namespace

Picture response_chart(const ResponseChart& data, const ChartLook& look) {
  ChartText text{data.title, data.subtitle, data.footer, data.needed, data.warning};
  Picture picture;
  Rect area = draw_chart_page(picture, text, look);
  if (data.panels.empty()) return as_page(picture, look);
  const std::size_t count = panels_with_room(data, area, look);
  if (count < data.panels.size()) {
    std::string without;
    for (std::size_t i = count; i < data.panels.size(); ++i) without += (without.empty() ? "Not shown, as there is no room: " : ", ") + without_formulas(data.panels[i].y_title);
    for (std::string* words : {&text.footer, &text.needed}) *words += (words->empty() ? "" : " ") + without + ".";
    picture = {};
    area = draw_chart_page(picture, text, look);
  }
  const double height = (area.height() - double(count - 1) * size::kGutter) / double(count);
  std::vector<PanelDrawing> panels;
  for (std::size_t i = 0; i < count; ++i) {
    const double top = area.y1 - double(i) * (height + size::kGutter);
    const Rect own{area.x0, top - height, area.x1, top};
    require_room_for_names(data.panels[i].curves.size(), own, look);
    panels.emplace_back(data.panels[i], data, own, i + 1 == count, look);
  }
  // One above the other they begin and end at the same places.
  double x0 = area.x0, x1 = area.x1;
  for (PanelDrawing& panel : panels) x0 = std::max(x0, panel.frame().box.x0), x1 = std::min(x1, panel.frame().box.x1);
  for (PanelDrawing& panel : panels) {
    panel.frame().box.x0 = x0, panel.frame().box.x1 = x1;
    panel.draw(picture);
  }
  return as_page(picture, look);
}

}  // namespace chainreel

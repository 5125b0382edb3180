#include "draw/film/needles.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

// Of a curve: the share of its time that the rest takes at least; how high that is of the whole at most; how many needles it has at most.
struct NeedleRule {
  double time, rest;
  std::size_t few;
};
// Five times as high the rest can be read, and more than six needles are how a curve is. Of a short clip a single one may take a quarter of the
// time, where all else is a line beside it.
constexpr NeedleRule kNeedleRules[] = {{0.95, 0.2, 6}, {0.9, 0.06, 1}, {0.85, 0.06, 1}, {0.8, 0.06, 1}, {0.75, 0.06, 1}};
constexpr double kLeastRest = 1e-3;     // of the whole: less is a constant, and its peaks are all that happens
constexpr double kHeldBeyond = 1;       // of the rest's range: a peak that is as high as twice that is part of it
constexpr double kHeadLong = 0.018, kHeadWide = 0.016;  // units of H
constexpr double kBesideNeedle = 0.006, kAboveEdge = 0.007, kAirOfNumber = 0.003;
constexpr double kSamePlace = 0.004;    // units of H: heads nearer than that are one

// The least interval that holds a curve for so much of its time; a point stands for half of the way to its neighbours.
ValueRange most_of(const std::vector<Point>& points, double share) {
  struct Part {
    double y, time;
  };
  std::vector<Part> parts;
  double all = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].y)) continue;
    parts.push_back({points[k].y, (points[std::min(k + 1, points.size() - 1)].x - points[k > 0 ? k - 1 : 0].x) / 2});
    all += parts.back().time;
  }
  if (parts.empty()) return {HUGE_VAL, -HUGE_VAL};
  std::ranges::sort(parts, {}, &Part::y);
  ValueRange best{parts.front().y, parts.back().y};
  double held = 0;
  for (std::size_t from = 0, to = 0; from < parts.size(); held -= parts[from++].time) {
    while (to < parts.size() && held < share * all) held += parts[to++].time;
    if (held < share * all) break;
    if (parts[to - 1].y - parts[from].y < best.span()) best = {parts[from].y, parts[to - 1].y};
  }
  return best;
}

// Stretches [begin, end) of a curve above or below a range, with their farthest points.
struct Excursion {
  std::size_t begin, end, farthest;
  bool is_up;
};
std::vector<Excursion> excursions_of(const std::vector<Point>& points, const ValueRange& range) {
  std::vector<Excursion> found;
  const auto side = [&](std::size_t k) { return points[k].y > range.high ? 1 : points[k].y < range.low ? -1 : 0; };
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].y) || side(k) == 0) continue;
    Excursion one{k, k, k, side(k) > 0};
    for (; one.end < points.size() && std::isfinite(points[one.end].y) && side(one.end) == side(k); ++one.end)
      if (one.is_up ? points[one.end].y > points[one.farthest].y : points[one.end].y < points[one.farthest].y) one.farthest = one.end;
    k = one.end - 1;
    found.push_back(one);
  }
  return found;
}

bool decides_whole(const StripCurve& curve) {
  return curve.decides && !std::isfinite(curve.shown_low) && !std::isfinite(curve.shown_high);
}

// Whether a curve comes from the range and returns to it.
bool returns(const Excursion& one, const std::vector<Point>& points) {
  return one.begin > 0 && one.end < points.size() && std::isfinite(points[one.begin - 1].y) && std::isfinite(points[one.end].y);
}

std::optional<ValueRange> range_by(const NeedleRule& rule, const StripData& data, ValueRange whole) {
  ValueRange most{HUGE_VAL, -HUGE_VAL};
  for (const StripCurve& curve : data.curves) {
    if (!curve.decides) continue;
    const ValueRange own = most_of(curve.points, rule.time);
    most = {std::min(most.low, own.low), std::max(most.high, own.high)};
  }
  if (!(most.span() >= kLeastRest * whole.span()) || !(most.span() < rule.rest * whole.span())) return std::nullopt;
  ValueRange held = most;
  for (const StripCurve& curve : data.curves) {
    if (!curve.decides) continue;
    std::size_t needles = 0;
    for (const Excursion& one : excursions_of(curve.points, most)) {
      const double y = curve.points[one.farthest].y, beyond = one.is_up ? y - most.high : most.low - y;
      if (returns(one, curve.points) && beyond > kHeldBeyond * most.span()) ++needles;
      else held = {std::min(held.low, y), std::max(held.high, y)};
    }
    if (needles > rule.few) return std::nullopt;
  }
  return held.span() < rule.rest * whole.span() ? std::optional(held) : std::nullopt;
}

}  // namespace

std::optional<ValueRange> range_without_needles(const StripData& data, ValueRange whole) {
  if (data.angles || !std::ranges::all_of(data.curves, [](const StripCurve& curve) { return !curve.decides || decides_whole(curve); })) return std::nullopt;
  for (const NeedleRule& rule : kNeedleRules)
    if (const std::optional<ValueRange> held = range_by(rule, data, whole)) return held;
  return std::nullopt;
}

std::vector<Needle> needles_of(const std::vector<StripCurve>& curves, const Axis& y) {
  std::vector<Needle> needles;
  if (y.scale == Scale::log) return needles;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (!decides_whole(curves[c]) || curves[c].covers) continue;
    for (const Excursion& one : excursions_of(curves[c].points, {y.low, y.high}))
      needles.push_back({curves[c].points[one.farthest], c, one.is_up});
  }
  return needles;
}

namespace {

double edge_of(const PlotFrame& frame, const Needle& needle) {
  return needle.is_up ? frame.box.y1 : frame.box.y0;
}

bool crosses(const PlotFrame& frame, const std::vector<StripCurve>& curves, const Rect& box) {
  for (const StripCurve& curve : curves)
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
      if (!frame.can_show(curve.points[k]) || !frame.can_show(curve.points[k + 1])) continue;
      Point a = frame.at(curve.points[k]), b = frame.at(curve.points[k + 1]);
      if (cut_segment(box, a, b)) return true;
    }
  return false;
}

// Beside its head, on the side `way`; nothing where it would lie on a curve, another head or another number.
std::optional<Rect> place_of_number(const PlotFrame& frame, const std::vector<StripCurve>& curves, const Needle& needle, double way, const TextLine& number,
                                    const std::vector<Rect>& taken) {
  const double x = frame.at_x(needle.peak.x), inward = needle.is_up ? -1 : 1;
  const double high = number.box.height(), beside = kHeadWide / 2 + kBesideNeedle;
  const double x0 = way > 0 ? x + beside : x - beside - number.advance, middle = edge_of(frame, needle) + inward * (kAboveEdge + high / 2);
  const Rect box{x0, middle - high / 2, x0 + number.advance, middle + high / 2}, with_air = widened(box, kAirOfNumber);
  if (!is_within(with_air, frame.box) || crosses(frame, curves, with_air)) return std::nullopt;
  if (std::ranges::any_of(taken, [&](const Rect& one) { return overlap(one, with_air); })) return std::nullopt;
  return box;
}

}  // namespace

void draw_needle_heads(Picture& picture, const PlotFrame& frame, const std::vector<Needle>& needles, const std::vector<StripCurve>& curves, double t, double opacity) {
  for (const Needle& needle : needles) {
    if (needle.peak.x > t) continue;
    const Point tip{frame.at_x(needle.peak.x), edge_of(frame, needle)};
    const double back = needle.is_up ? -kHeadLong : kHeadLong;
    picture.add(Polygon{{tip, tip + Point{kHeadWide / 2, back}, tip + Point{-kHeadWide / 2, back}}, 3, {curves[needle.curve].style.color.faded(opacity), {}, 0}});
  }
}

std::string number_of(const Needle& needle, const std::string& unit) {
  return (needle.peak.y < 0 ? "\u2212" : "") + format_significant(std::abs(needle.peak.y), 2) + unit;
}

bool draw_needle_numbers(Picture& picture, const PlotFrame& frame, const std::vector<Needle>& needles, const std::vector<StripCurve>& curves, const std::string& unit,
                         const PlotStyle& style) {
  struct Said {
    double x;
    std::string number;
    TextLine line;
    Rect place;
  };
  // No number lies on another one's head.
  std::vector<Rect> heads;
  for (const Needle& needle : needles) {
    const double x = frame.at_x(needle.peak.x), y = edge_of(frame, needle);
    heads.push_back({x - kHeadWide / 2, y - kHeadLong, x + kHeadWide / 2, y + kHeadLong});
  }
  // All on one side of their heads: else one would be read as that of a neighbour.
  for (const double way : {1.0, -1.0}) {
    std::vector<Said> said;
    std::vector<Rect> taken = heads;
    const bool all_stand = std::ranges::all_of(needles, [&](const Needle& needle) {
      const double x = frame.at_x(needle.peak.x);
      const std::string number = number_of(needle, unit);
      if (std::ranges::any_of(said, [&](const Said& one) { return std::abs(one.x - x) < kSamePlace && one.number == number; })) return true;
      TextLine line = lay_out_text(*style.fonts, number, {Face::label, style.text(size::kTick), style.theme->muted, Align::left});
      const std::optional<Rect> place = place_of_number(frame, curves, needle, way, line, taken);
      if (!place) return false;
      taken.push_back(*place);
      said.push_back({x, number, std::move(line), *place});
      return true;
    });
    if (!all_stand) continue;
    for (const Said& one : said) draw_text(picture, one.line, {one.place.x0, one.place.y0 - one.line.box.y0});
    return true;
  }
  return false;
}

}  // namespace chainreel

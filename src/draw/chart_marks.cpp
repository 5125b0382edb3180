// Slopes: with steps of size h a method of order p has error ~ h^p and cost ~ 1/h, so that log cost falls by
// 1/p for each decade of error.
#include "draw/chart_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace chainreel {
namespace {

constexpr int kGuideSamples = 160;
constexpr double kGuideOpacity = 0.55;
constexpr double kTriangleRise = 0.045, kTriangleOffset = 0.012;
constexpr double kLongestRun = 0.28;  // of the panel's width
constexpr double kSlopeAgreement =
    0.25;  // of 1/p: more than measured times scatter, less than to the next order
constexpr double kRing = 0.0185, kRingLine = 0.0035;
constexpr double kFailureShift = 0.020, kFailureSize = 1.25;

struct LogPoint {
  double error, cost;
};

// Points of one curve that did not fail, log10, in rising order of error.
std::vector<LogPoint> good_points(const ChartCurve& curve, ChartCost cost) {
  std::vector<LogPoint> points;
  for (const ChartPoint& p : curve.points)
    if (!p.failed && p.error > 0 && cost_of(p, cost) > 0 && std::isfinite(p.error))
      points.push_back({std::log10(p.error), std::log10(cost_of(p, cost))});
  std::sort(points.begin(), points.end(),
            [](const LogPoint& a, const LogPoint& b) { return a.error < b.error; });
  return points;
}

double least_log_cost(const WorkPrecision& data, ChartCost cost, double log_error) {
  double least = std::numeric_limits<double>::infinity();
  for (const ChartCurve& curve : data.curves) {
    const std::vector<LogPoint> points = good_points(curve, cost);
    for (std::size_t i = 0; i < points.size() && points[i].error <= log_error; ++i) {
      least = std::min(least, points[i].cost);
      if (i + 1 == points.size() || points[i + 1].error <= log_error) continue;
      const double t = (log_error - points[i].error) / (points[i + 1].error - points[i].error);
      least = std::min(least, points[i].cost + t * (points[i + 1].cost - points[i].cost));
    }
  }
  return least;
}

std::vector<Point> all_page_points(const PlotFrame& frame, const WorkPrecision& data, ChartCost cost) {
  std::vector<Point> points;
  for (const ChartCurve& curve : data.curves)
    for (const ChartPoint& p : curve.points)
      if (!p.failed && frame.can_show({p.error, cost_of(p, cost)}))
        points.push_back(frame.at({p.error, cost_of(p, cost)}));
  return points;
}

int points_within(const std::vector<Point>& points, const Rect& box, double around) {
  return int(std::count_if(points.begin(), points.end(), [&](Point p) {
    return p.x > box.x0 - around && p.x < box.x1 + around && p.y > box.y0 - around && p.y < box.y1 + around;
  }));
}

bool shows_order(const LogPoint& a, const LogPoint& b, int order) {
  if (!(b.error > a.error)) return false;
  const double slope = (a.cost - b.cost) / (b.error - a.error) * order;
  return std::abs(slope - 1) < kSlopeAgreement;
}

// Below and left of the curve's middle between two of its points.
SlopeTriangle triangle_at(const PlotFrame& frame, const LogPoint& a, const LogPoint& b, int order) {
  const double per_decade_x = frame.box.width() / std::log10(frame.x.high / frame.x.low);
  const double per_decade_y = frame.box.height() / std::log10(frame.y.high / frame.y.low);
  double rise = kTriangleRise, run = rise * order * per_decade_x / per_decade_y;
  const double shrink = std::min(1.0, kLongestRun * frame.box.width() / run);
  rise *= shrink;
  run *= shrink;
  const double length = std::sqrt(run * run + rise * rise);
  const Point inward = {-kTriangleOffset * rise / length, -kTriangleOffset * run / length};
  const Point middle =
      frame.at({std::pow(10.0, (a.error + b.error) / 2), std::pow(10.0, (a.cost + b.cost) / 2)});
  return {middle + inward + Point{-run / 2, -rise / 2}, run, rise, std::to_string(order)};
}

struct Candidate {
  SlopeTriangle triangle;
  int in_the_way = std::numeric_limits<int>::max();
};

void consider(std::map<int, Candidate>& best, const PlotFrame& frame, const ChartCurve& curve, ChartCost cost,
              const std::vector<Point>& obstacles, double left, double text) {
  const std::vector<LogPoint> points = good_points(curve, cost);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (curve.order <= 0 || !shows_order(points[i], points[i + 1], curve.order)) continue;
    const SlopeTriangle triangle = triangle_at(frame, points[i], points[i + 1], curve.order);
    const Point c = triangle.corner;
    const Rect box = {c.x, c.y - text, c.x + triangle.run, c.y + triangle.rise};
    if (box.x0 < left || box.x1 > frame.box.x1 || box.y0 < frame.box.y0 || box.y1 > frame.box.y1) continue;
    const int in_the_way = points_within(obstacles, box, 0.01);
    Candidate& candidate = best[curve.order];
    if (in_the_way < candidate.in_the_way) candidate = {triangle, in_the_way};
  }
}

}  // namespace

double cost_of(const ChartPoint& point, ChartCost cost) {
  return cost == ChartCost::seconds ? point.seconds : point.evaluations;
}

std::optional<double> least_cost(const WorkPrecision& data, ChartCost cost, double error) {
  if (!(error > 0)) return {};
  const double least = least_log_cost(data, cost, std::log10(error));
  if (!std::isfinite(least)) return {};
  return std::pow(10.0, least);
}

void draw_best_guides(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                      const ChartLook& look) {
  const double low = std::log10(frame.x.low), high = std::log10(frame.x.high);
  std::vector<Point> best;
  for (int i = 0; i <= kGuideSamples; ++i) {
    const double log_error = low + i * (high - low) / kGuideSamples;
    const double least = least_log_cost(data, cost, log_error);
    if (std::isfinite(least)) best.push_back({std::pow(10.0, log_error), std::pow(10.0, least)});
  }
  if (best.size() < 2) return;
  CurveStyle style{look.theme->base.faded(kGuideOpacity), size::kPlotLineSecondary, Dash::dotted,
                   Marker::none};
  const TextStyle text{Face::label, look.plot_style().text(size::kTick), look.theme->muted, Align::right};
  const std::array<std::pair<double, const char*>, 3> guides = {
      {{1, "the best"}, {10, "10\u00D7"}, {100, "100\u00D7"}}};
  for (const auto& [factor, words] : guides) {
    std::vector<Point> curve = best;
    for (Point& p : curve) p.y *= factor;
    draw_curve(picture, frame, curve, style, *look.theme);
    const Point end = frame.at(curve.back());
    const TextLine line = lay_out_text(*look.fonts, words, text);
    const double y = factor == 1 ? end.y - 1.1 * text.size : end.y + 0.35 * text.size;
    if (y > frame.box.y0 && y + text.size < frame.box.y1) draw_text(picture, line, {end.x - 0.008, y});
  }
}

void draw_slopes(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 const ChartLook& look) {
  const std::vector<Point> obstacles = all_page_points(frame, data, cost);
  const double left = std::max(frame.box.x0, data.floor > 0 ? frame.at_x(data.floor) : frame.box.x0);
  std::map<int, Candidate> best;
  for (const ChartCurve& curve : data.curves)
    consider(best, frame, curve, cost, obstacles, left, look.plot_style().text(size::kTick));
  for (const auto& [order, candidate] : best)
    draw_slope_triangle(picture, candidate.triangle, look.plot_style());
}

void draw_failure(Picture& picture, const PlotFrame& frame, double cost, const CurveStyle& style,
                  const ChartLook& look) {
  const double y = frame.can_show({frame.x.high, cost})
                       ? std::clamp(frame.at_y(cost), frame.box.y0, frame.box.y1)
                       : frame.box.y1;  // it never came to an end
  const Color background = look.theme->background;
  draw_marker(picture, {frame.box.x1 - kFailureShift, y}, style.marker, size::kMarker, style.color,
              background);
  draw_marker(picture, {frame.box.x1, y}, Marker::cross, kFailureSize * size::kMarker, style.color,
              background);
}

void draw_choice(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 const ChartLook& look) {
  if (!data.choice) return;
  const auto curve = std::find_if(data.curves.begin(), data.curves.end(),
                                  [&](const ChartCurve& c) { return c.method == data.choice->method; });
  if (curve == data.curves.end() || data.choice->point < 0 ||
      std::size_t(data.choice->point) >= curve->points.size())
    return;
  const ChartPoint& point = curve->points[std::size_t(data.choice->point)];
  const Point data_point = {std::max(point.error, frame.x.low), cost_of(point, cost)};
  if (point.failed || !frame.can_show(data_point)) return;
  const Point at = frame.at(data_point);
  picture.add(Ellipse{at, {kRing, 0}, {0, kRing}, {{}, look.theme->ink, kRingLine}});
  // The word goes where fewest points are.
  const TextStyle text{Face::label_bold, look.plot_style().text(size::kTick), look.theme->ink, Align::center};
  const TextLine word = lay_out_text(*look.fonts, "auto", text);
  const double half = word.advance / 2, gap = 1.35 * kRing;
  const std::array<Point, 4> places = {{{0, -gap - 0.75 * text.size},
                                        {-gap - half, -0.37 * text.size},
                                        {gap + half, -0.37 * text.size},
                                        {0, gap}}};
  const std::vector<Point> obstacles = all_page_points(frame, data, cost);
  Point best = at + places[0];
  int fewest = std::numeric_limits<int>::max();
  for (const Point& place : places) {
    const Point p = at + place;
    const Rect box = {p.x - half, p.y, p.x + half, p.y + text.size};
    if (box.x0 < frame.box.x0 || box.x1 > frame.box.x1 || box.y0 < frame.box.y0 || box.y1 > frame.box.y1)
      continue;
    const int count = points_within(obstacles, box, 0.012);
    if (count < fewest) fewest = count, best = p;
  }
  draw_text(picture, word, best);
}

}  // namespace chainreel

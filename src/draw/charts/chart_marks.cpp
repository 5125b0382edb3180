// Slopes: with steps of size h a method of order p has error ~ h^p and cost ~ 1/h, so that log cost falls by
// 1/p for each decade of error.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "draw/charts/chart.hpp"
#include "draw/charts/chart_names.hpp"
#include "draw/charts/lit_colours.hpp"
#include "draw/charts/obstacles.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

constexpr int kGuideSamples = 160;
constexpr double kGuideLine = 0.0018;
constexpr double kTriangleRise = 0.042, kTriangleOffset = 0.014;
constexpr double kLeastRun = 0.037, kLongestRun = 0.11, kHighestRise = 0.20;  // H at the usual size of text: what is narrower shows no slope
constexpr double kSlopeAgreement = 0.25;  // of 1/p: more than times scatter, less than to the next order
constexpr double kRing = 0.0185, kRingLine = 0.0035;
constexpr double kFailureShift = 0.020, kFailureSize = 1.25;
constexpr double kSameCost = 1e-9;    // decades

struct LogPoint {
  double error, cost;
};

// Points of one curve that did not fail, log10, in rising order of error.
std::vector<LogPoint> good_points(const ChartCurve& curve, ChartCost cost) {
  std::vector<LogPoint> points;
  for (const ChartPoint& p : curve.points)
    if (!p.failed && !p.is_apart && p.error > 0 && cost_of(p, cost) > 0 && std::isfinite(p.error))
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

Point page_point(const PlotFrame& frame, const LogPoint& p) {
  return frame.at({std::pow(10.0, p.error), std::pow(10.0, p.cost)});
}

Obstacles obstacles_of(const PlotFrame& frame, const WorkPrecision& data, ChartCost cost) {
  Obstacles obstacles{frame.box, {}, {}};
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    const std::vector<LogPoint> points = good_points(data.curves[k], cost);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LogPoint& next = points[std::min(i + 1, points.size() - 1)];
      obstacles.lines.push_back({page_point(frame, points[i]), page_point(frame, next), int(k)});
    }
    for (const ChartPoint& p : data.curves[k].points) {
      if (!p.failed || !frame.can_show({frame.x.high, cost_of(p, cost)})) continue;
      const Point edge = frame.at({frame.x.high, cost_of(p, cost)});
      obstacles.lines.push_back({edge - Point{kFailureShift, 0}, edge, int(k)});
    }
  }
  // Nothing is written into the zone but its own words.
  if (data.least_error() > 0) obstacles.inside.x0 = std::max(frame.box.x0, frame.at_x(data.least_error()));
  return obstacles;
}

// --- guides ---

constexpr std::array<std::pair<double, const char*>, 3> kGuides = {
    {{1, "the best"}, {10, "10\u00D7"}, {100, "100\u00D7"}}};

std::vector<Point> best_curve(const PlotFrame& frame, const WorkPrecision& data, ChartCost cost) {
  // Beyond the largest answer nothing is the best.
  const double low = std::log10(frame.x.low), high = std::log10(std::min(frame.x.high, data.largest_answer));
  std::vector<Point> best;
  if (!(low < high)) return best;
  for (int i = 0; i <= kGuideSamples; ++i) {
    const double error = std::pow(10.0, low + i * (high - low) / kGuideSamples);
    if (const auto least = least_cost(data, cost, error)) best.push_back({error, *least});
  }
  return best;
}

void draw_guides(Picture& picture, const PlotFrame& frame, const std::vector<Point>& best,
                 const ChartLook& look) {
  // As the grid and dotted: methods' lines are whole, or wider.
  const CurveStyle style{look.theme->rule, kGuideLine, Dash::dotted, Marker::none};
  for (const auto& [factor, words] : kGuides) {
    std::vector<Point> curve = best;
    for (Point& p : curve) p.y *= factor;
    draw_curve(picture, frame, curve, style, *look.theme);
  }
}

// Below the best, above the others; as far right as there is room.
void draw_guide_words(Picture& picture, const PlotFrame& frame, const std::vector<Point>& best,
                      Obstacles& obstacles, const ChartLook& look) {
  const TextStyle text{Face::label, look.plot_style().text(size::kTick), look.theme->muted, Align::center};
  for (const auto& [factor, words] : kGuides)
    for (std::size_t i = 0; i + 1 < best.size(); ++i)
      obstacles.lines.push_back({frame.at({best[i].x, factor * best[i].y}),
                                 frame.at({best[i + 1].x, factor * best[i + 1].y}), kNoCurve});
  for (const auto& [factor, words] : kGuides) {
    const TextLine line = lay_out_text(*look.fonts, words, text);
    for (std::size_t i = best.size(); i-- > 0;) {
      const Point on_guide = frame.at({best[i].x, factor * best[i].y});
      const Point at = on_guide + Point{0, factor == 1 ? -1.25 * text.size : 0.6 * text.size};
      const Rect box = {at.x + line.box.x0, at.y, at.x + line.box.x1, at.y + text.size};
      if (!obstacles.is_free(box)) continue;
      draw_text(picture, line, at);
      obstacles.boxes.push_back(box);
      break;
    }
  }
}

// --- slopes ---

bool shows_order(const LogPoint& a, const LogPoint& b, int order) {
  if (order <= 0 || !(b.error > a.error)) return false;
  const double slope = (a.cost - b.cost) / (b.error - a.error) * order;
  return std::abs(slope - 1) < kSlopeAgreement;
}

// Beside the middle between two points of a curve; `side` is -1 below and left of it, 1 above and right. None where one that is wide enough to be read
// would be too high. `text`: times the usual size.
std::optional<SlopeTriangle> triangle_at(const PlotFrame& frame, const LogPoint& a, const LogPoint& b, int order,
                                         double side, double text) {
  const double per_decade_x = frame.box.width() / std::log10(frame.x.high / frame.x.low);
  const double per_decade_y = frame.box.height() / std::log10(frame.y.high / frame.y.low);
  double rise = kTriangleRise, run = rise * order * per_decade_x / per_decade_y;
  const double by = std::max(std::min(1.0, kLongestRun / run), text * kLeastRun / run);
  rise *= by;
  run *= by;
  if (rise > text * kHighestRise) return {};
  const double length = std::sqrt(run * run + rise * rise);
  const Point away = (side * kTriangleOffset / length) * Point{rise, run};
  const Point middle = page_point(frame, {(a.error + b.error) / 2, (a.cost + b.cost) / 2});
  return SlopeTriangle{middle + away + Point{side * run / 2, side * rise / 2}, -side * run, -side * rise,
                       std::to_string(order)};
}

// The triangle's box with its number; `text` is the number's height.
Rect box_of(const SlopeTriangle& triangle, double text) {
  const Point c = triangle.corner;
  Rect box = {std::min(c.x, c.x + triangle.run), std::min(c.y, c.y + triangle.rise),
              std::max(c.x, c.x + triangle.run), std::max(c.y, c.y + triangle.rise)};
  (triangle.rise > 0 ? box.y0 : box.y1) -= (triangle.rise > 0 ? 1 : -1) * text;
  return box;
}

// Free of all other curves; its own may pass the corner of the box that the triangle leaves empty, but
// neither the number nor the half-size square at the right angle.
bool triangle_is_free(const SlopeTriangle& triangle, double text, const Obstacles& obstacles, int curve) {
  const Point c = triangle.corner;
  const auto between = [](Point a, Point b) {
    return Rect{std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
  };
  const Rect square = between(c, c + Point{triangle.run / 2, triangle.rise / 2});
  const Rect number = between(c, c + Point{triangle.run, triangle.rise > 0 ? -text : text});
  return obstacles.is_free(box_of(triangle, text), curve) &&
         obstacles.is_free(widened(square, -kClearance)) && obstacles.is_free(widened(number, -kClearance));
}

bool draw_slopes(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 Obstacles& obstacles, const ChartLook& look) {
  const PlotStyle style = look.plot_style();
  const double text = 1.1 * style.text(size::kTick);
  std::set<int> drawn;
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    const ChartCurve& curve = data.curves[k];
    const std::vector<LogPoint> points = good_points(curve, cost);
    for (std::size_t i = 0; i + 1 < points.size() && !drawn.contains(curve.order); ++i) {
      if (!shows_order(points[i], points[i + 1], curve.order)) continue;
      for (const double side : {-1.0, 1.0}) {
        const auto triangle = triangle_at(frame, points[i], points[i + 1], curve.order, side, style.text(size::kTick) / size::kTick);
        if (!triangle || !triangle_is_free(*triangle, text, obstacles, int(k))) continue;
        draw_slope_triangle(picture, *triangle, style);
        obstacles.boxes.push_back(box_of(*triangle, text));
        drawn.insert(curve.order);
        break;
      }
    }
  }
  return !drawn.empty();
}

// --- the choice of `auto` ---

// No error at all is as good as the axis shows.
Point place_of(const ChartPoint& point, const PlotFrame& frame, ChartCost cost) {
  return {std::max(point.error, frame.x.low), cost_of(point, cost)};
}

// Of it the run, where the frame can show that.
const ChartPoint* chosen_point(const PlotFrame& frame, const WorkPrecision& data, ChartCost cost) {
  if (!data.choice || data.choice->point < 0) return nullptr;
  for (const ChartCurve& curve : data.curves) {
    if (curve.method != data.choice->method || std::size_t(data.choice->point) >= curve.points.size())
      continue;
    const ChartPoint& point = curve.points[std::size_t(data.choice->point)];
    if (!point.failed && frame.can_show(place_of(point, frame, cost))) return &point;
  }
  return nullptr;
}

// "auto (order 12)" of "taylor, order 12, tolerance 1e-06" where that lies off its method's curve, which is of another order.
std::string words_of_choice(const ChartPoint& point) {
  const std::size_t first = point.label.find(", "), last = point.label.rfind(", ");
  if (!point.is_apart || first == last) return "auto";
  return "auto (" + point.label.substr(first + 2, last - first - 2) + ")";
}

void draw_choice(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost,
                 Obstacles& obstacles, const ChartLook& look) {
  const ChartPoint* const chosen = chosen_point(frame, data, cost);
  if (!chosen) return;
  const Point at = frame.at(place_of(*chosen, frame, cost));
  picture.add(Ellipse{at, {kRing, 0}, {0, kRing}, {{}, look.theme->ink, kRingLine}});
  obstacles.boxes.push_back({at.x - kRing, at.y - kRing, at.x + kRing, at.y + kRing});
  const double em = look.plot_style().text(size::kTick);
  const TextLine word =
      lay_out_text(*look.fonts, words_of_choice(*chosen), {Face::label_bold, em, look.theme->ink, Align::center});
  const double half = word.advance / 2, gap = kRing + kClearance + 0.004;
  const std::array<Point, 11> places = {{{0, -gap - 0.8 * em},
                                        {0, gap + 0.1 * em},
                                        {-gap - half, -gap - 0.4 * em},
                                        {gap + half, gap - 0.4 * em},
                                        {gap + half, -gap - 0.4 * em},
                                        {-gap - half, gap - 0.4 * em},
                                        {-half / 2, -gap - 0.8 * em},
                                        {half / 2, -gap - 0.8 * em},
                                        {0, -gap - 2.2 * em},
                                        {-half / 2, -gap - 2.2 * em},
                                        {0, gap + 1.5 * em}}};
  Point best = at + places[0];
  for (const Point& place : places) {
    const Point p = at + place;
    if (!obstacles.is_free({p.x - half, p.y, p.x + half, p.y + 0.75 * em})) continue;
    best = p;
    break;
  }
  draw_text(picture, word, best);
  obstacles.boxes.push_back({best.x - half, best.y, best.x + half, best.y + em});
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

// So near to what rounding or the reference leaves, who comes nearest is chance.
constexpr double kAboveLeast = 30;

void light_curves(WorkPrecision& data, std::span<const ChartCost> panels, const std::vector<std::string>& methods) {
  for (ChartCurve& curve : data.curves) {
    curve.is_lit = std::find(methods.begin(), methods.end(), curve.method) != methods.end();
    if (!methods.empty()) continue;
    if (data.choice && data.choice->method == curve.method) curve.is_lit = true;
    for (const ChartCost cost : panels)
      for (const LogPoint& point : good_points(curve, cost))
        curve.is_lit |= !(std::pow(10, point.error) < kAboveLeast * data.least_error()) && std::pow(10, point.error) <= data.largest_answer && point.cost <= least_log_cost(data, cost, point.error) + kSameCost;
  }
  std::vector<int*> looks;
  for (std::size_t k = 0; k < data.curves.size(); ++k) {
    ChartCurve& curve = data.curves[k];
    if (!curve.is_lit) continue;
    if (curve.look < 0) curve.look = int(k);
    looks.push_back(&curve.look);
  }
  tell_colours_apart(looks);
}

DrawnMarks draw_marks(Picture& picture, const PlotFrame& frame, const WorkPrecision& data, ChartCost cost, bool names_inside,
                      const ChartLook& look) {
  const std::vector<Point> best = best_curve(frame, data, cost);
  draw_guides(picture, frame, best, look);
  Obstacles obstacles = obstacles_of(frame, data, cost);
  draw_choice(picture, frame, data, cost, obstacles, look);
  DrawnMarks drawn;
  if (names_inside) drawn.names_stand = draw_names_in_colour(picture, frame, data, cost, obstacles, look);
  drawn.triangles = draw_slopes(picture, frame, data, cost, obstacles, look);
  draw_guide_words(picture, frame, best, obstacles, look);
  draw_settings(picture, frame, data, cost, obstacles, look);
  draw_grey_names(picture, frame, data, cost, obstacles, look);
  return drawn;
}

void draw_failure(Picture& picture, const PlotFrame& frame, double cost, const CurveStyle& style,
                  const ChartLook& look) {
  const double y = frame.can_show({frame.x.high, cost})
                       ? std::clamp(frame.at_y(cost), frame.box.y0, frame.box.y1)
                       : frame.box.y1;  // it never came to an end
  const Color background = look.theme->background;
  if (style.marker != Marker::none)
    draw_marker(picture, {frame.box.x1 - kFailureShift * style.marker_size / size::kMarker, y}, style.marker, style.marker_size, style.color, background);
  draw_marker(picture, {frame.box.x1, y}, Marker::cross, kFailureSize * style.marker_size, style.color,
              background);
}

}  // namespace chainreel

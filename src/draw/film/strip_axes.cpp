#include "draw/film/strip_axes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/film/needles.hpp"

namespace chainreel {
namespace {

constexpr double kLeastSpan = 1e-9;  // of the size of the numbers: less is a constant
constexpr double kRangeAir = 0.06;        // of the range, above and below
constexpr double kShareOfSteady = 0.35;   // of its size: what changes by less is shown with zero
constexpr double kLeastOfLog = 1e-300, kLargestOfLog = 1e300;  // beyond, doubles end
constexpr double kLeastAirOfLog = 1.5;  // above and below, of one constant
constexpr double kSpanOfLog = 100;    // times the least: more has a log axis
constexpr double kMostOfLog = 1000;    // times the least: up to there
constexpr double kResolved = 2;       // times the sample beside it: what grows faster is as high as chance has it
constexpr double kLongestFrame = 0.05;  // s
constexpr double kRoundTime = 0.1;    // s: a clip ends at a multiple that its last frame nearly reaches

// Whether a run keeps what another one does not: that they differ is what is to be seen.
bool runs_differ(const StripData& data, double span) {
  constexpr double kKept = 0.5;  // of the span of all
  return data.of_runs && std::ranges::any_of(data.curves, [&](const StripCurve& curve) {
           if (!curve.decides || curve.points.empty()) return false;
           const auto [low, high] = std::ranges::minmax_element(curve.points, {}, &Point::y);
           return high->y - low->y < kKept * span;
         });
}

// Up to the highest number that samples tell: at a pole they stand ever farther apart, and the curve leaves the plot; never so high that the
// curve elsewhere is at its bottom, as samples at the pole would have it.
Axis pole_axis(const StripData& data, double low) {
  double high = low;
  for (const StripCurve& curve : data.curves) {
    const std::vector<Point>& points = curve.points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double beside = std::max(points[k > 0 ? k - 1 : k].y, points[std::min(k + 1, points.size() - 1)].y);
      const double below = std::min(points[k > 0 ? k - 1 : k].y, points[std::min(k + 1, points.size() - 1)].y);
      if (std::isfinite(beside) && beside < kResolved * points[k].y && points[k].y < kResolved * below) high = std::max(high, points[k].y);
    }
  }
  high = std::min(high, kMostOfLog * low);
  const double air = std::pow(high / low, kRangeAir);
  return {Scale::log, low / air, high, data.title};
}

// Whatever a run grows to has its place on it.
std::optional<Axis> log_axis(const StripData& data) {
  double low = HUGE_VAL, high = 0;
  for (const StripCurve& curve : data.curves)
    for (const Point& p : curve.points)
      if (p.y > 0 && std::isfinite(p.y)) low = std::min(low, p.y), high = std::max(high, p.y);
  if (!(low <= high)) return std::nullopt;
  const double air = std::max(std::pow(high / low, kRangeAir), kLeastAirOfLog);
  return Axis{Scale::log, std::max(low / air, kLeastOfLog), std::min(high * air, kLargestOfLog), data.title};
}

}  // namespace

Axis value_axis(const StripData& data) {
  if (data.is_log && !data.has_poles)
    if (const auto axis = log_axis(data)) return *axis;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const bool only_deciding : {true, false}) {
    for (const StripCurve& curve : data.curves) {
      if (only_deciding && !curve.decides) continue;
      for (const Point& p : curve.points) {
        if (!std::isfinite(p.y)) continue;
        const double shown = std::clamp(p.y, curve.shown_low, curve.shown_high);
        low = std::min(low, shown);
        high = std::max(high, shown);
      }
    }
    if (low <= high) break;
  }
  if (!(low <= high)) low = 0, high = 1;
  if (data.has_poles && low > 0 && high > kSpanOfLog * low) return pole_axis(data, low);
  if (const auto rest = range_without_needles(data, {low, high})) low = rest->low, high = rest->high;
  const double size = std::max(std::abs(low), std::abs(high));
  const bool is_constant = high - low <= kLeastSpan * size || size == 0;
  const double constant = (low + high) / 2;
  if (is_constant) {
    const double half = size > 0 ? 0.1 * size : 1;
    low -= half;
    high += half;
  }
  // What hardly changes is seen to hardly change.
  const double span = high - low;
  const bool has_zero = !data.angles && (is_constant || !runs_differ(data, span));
  if (has_zero && low > 0 && span < kShareOfSteady * high) low = 0;
  if (has_zero && high < 0 && span < kShareOfSteady * -low) high = 0;
  if (const double lacks = data.least_span - (high - low); lacks > 0) low -= lacks / 2, high += lacks / 2;
  const double air = kRangeAir * (high - low);
  Axis axis{data.angles ? Scale::angle : Scale::linear, low - air, high + air, data.title, {}};
  // Of a constant its number is what is to be read.
  if (is_constant && size > 0 && !data.angles) axis.at = {std::min(0.0, constant), constant / 2, std::max(0.0, constant)};
  return axis;
}

Axis time_axis(double end) {
  if (!(end > 0)) end = 1;
  const double round = kRoundTime * std::ceil(end / kRoundTime - 1e-6);
  return {Scale::linear, 0, round - end < kLongestFrame ? round : end, "", "s"};
}

}  // namespace chainreel

#include "picture/thin_points.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kColumn = 0.0007;  // units of H: a page of 4K has a pixel every 0.0005
constexpr double kColumnOfPixel = 0.75;  // where that is more
constexpr std::size_t kManyPoints = 3000;
constexpr std::size_t kDense = 8;  // points of a column
constexpr double kOff = 0.00005;  // units of H: a twentieth of a pixel of 1080 lines, a tenth of one of 2160

// Directions of lines from one point that pass others within kOff, and end behind them. None turns back to the left.
class Directions {
 public:
  bool hold(Point d) const {
    const double angle = std::atan2(d.y, d.x);
    return angle >= low_ && angle <= high_ && std::hypot(d.x, d.y) >= reach_ - kOff;
  }
  void narrow(Point d) {
    const double length = std::hypot(d.x, d.y), angle = std::atan2(d.y, d.x);
    reach_ = std::max(reach_, length);
    if (length <= kOff) return;
    const double half = std::asin(kOff / length);
    low_ = std::max(low_, angle - half);
    high_ = std::min(high_, angle + half);
  }

 private:
  double low_ = -HUGE_VAL, high_ = HUGE_VAL, reach_ = 0;
};

}  // namespace

std::vector<std::size_t> thin_points(const PlotFrame& frame, std::span<const Point> data, double pixel) {
  std::vector<std::size_t> kept;
  Point from{};
  Directions directions;
  bool is_open = false;  // a line has begun at the last kept point and may go on
  const auto keep = [&](std::size_t i, bool shows) {
    if (kept.empty() || kept.back() != i) kept.push_back(i);
    is_open = shows;
    if (shows) from = frame.at(data[i]), directions = {};
  };
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (!frame.can_show(data[i])) {
      if (i > 0) keep(i - 1, false);
      keep(i, false);
      continue;
    }
    Point d = is_open ? frame.at(data[i]) - from : Point{};
    // The line ends at the point before where it cannot end here.
    if (is_open && (!(d.x > 0) || !directions.hold(d)) && i > 0) {
      keep(i - 1, true);
      d = frame.at(data[i]) - from;
    }
    if (!is_open || !(d.x > 0))
      keep(i, true);
    else
      directions.narrow(d);
  }
  if (!data.empty()) keep(data.size() - 1, true);
  if (kept.size() <= kManyPoints) return kept;
  // A long film draws them in each frame: by columns, between one gap and the next.
  std::vector<std::size_t> fewer;
  for (std::size_t first = 0; first < kept.size();) {
    std::vector<Point> page;
    for (std::size_t k = first; k < kept.size() && frame.can_show(data[kept[k]]); ++k) page.push_back(frame.at(data[kept[k]]));
    for (const std::size_t k : column_points(page, pixel)) fewer.push_back(kept[first + k]);
    first += page.size();
    if (first < kept.size()) fewer.push_back(kept[first++]);
  }
  return fewer;
}

std::vector<std::size_t> column_points(std::span<const Point> page, double pixel) {
  const double width = std::max(kColumn, kColumnOfPixel * pixel);
  std::vector<std::size_t> kept;
  if (page.size() <= kManyPoints) {
    for (std::size_t i = 0; i < page.size(); ++i) kept.push_back(i);
    return kept;
  }
  for (std::size_t first = 0; first < page.size();) {
    const double column = std::floor(page[first].x / width);
    std::size_t last = first, low = first, high = first;
    for (std::size_t i = first; i < page.size() && std::floor(page[i].x / width) == column; ++i) {
      last = i;
      if (page[i].y < page[low].y) low = i;
      if (page[i].y > page[high].y) high = i;
    }
    // Of a dense column nobody sees where it is entered and left.
    const bool is_dense = last - first >= kDense && first > 0 && last + 1 < page.size();
    for (const std::size_t i : {is_dense ? std::min(low, high) : first, std::min(low, high), std::max(low, high), is_dense ? std::max(low, high) : last})
      if (kept.empty() || kept.back() != i) kept.push_back(i);
    first = last + 1;
  }
  return kept;
}

}  // namespace chainreel

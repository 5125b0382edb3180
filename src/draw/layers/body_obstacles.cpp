#include "draw/layers/body_obstacles.hpp"

#include <algorithm>

#include "draw/robot/joints.hpp"

namespace chainreel {
namespace {

constexpr double kBetweenRows = 0.012;  // units of H: rows as far apart as no letter is low

// Counterclockwise, by A. Andrew's monotone chain.
std::vector<Point> hull_of(std::vector<Point> points) {
  std::ranges::sort(points, [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Point p : points) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

}  // namespace

void add_silhouettes(std::vector<Obstacle>& obstacles, const BodyShapes& shapes, const Workspace& ws, const Camera& camera, bool may_yield) {
  for (const BodyShape& shape : shapes.shapes) {
    std::vector<Point> places;
    for (const Eigen::Vector3d& corner : shape.corners) places.push_back(camera.project(pose_of(ws, shape.body) * corner));
    const std::vector<Point> hull = hull_of(std::move(places));
    if (hull.empty()) continue;
    const auto [low, high] = std::ranges::minmax(hull, {}, &Point::y);
    for (std::size_t i = 0; i < hull.size(); ++i) obstacles.push_back({hull[i], hull[(i + 1) % hull.size()], 0, may_yield});
    for (double y = low.y + kBetweenRows; y < high.y; y += kBetweenRows) {
      double left = HUGE_VAL, right = -HUGE_VAL;
      for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point a = hull[i], b = hull[(i + 1) % hull.size()];
        if ((a.y - y) * (b.y - y) > 0 || a.y == b.y) continue;
        const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        left = std::min(left, x), right = std::max(right, x);
      }
      if (left < right) obstacles.push_back({{left, y}, {right, y}, 0, may_yield});
    }
  }
}

}  // namespace chainreel

#include "picture/thin_points.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace chainreel {
namespace {

using testing::ElementsAre;

const PlotFrame kFrame{{Scale::linear, 0, 8}, {Scale::linear, -1, 1}, {0.1, 0.2, 0.9, 0.8}};

std::vector<Point> samples(int count, double (*y)(double)) {
  std::vector<Point> points;
  for (int k = 0; k <= count; ++k) points.push_back({8.0 * k / count, y(8.0 * k / count)});
  return points;
}

double distance(Point p, Point a, Point b) {
  const Point d = b - a, e = p - a;
  const double share = std::clamp((e.x * d.x + e.y * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
  return std::hypot(e.x - share * d.x, e.y - share * d.y);
}

// Of all points, from the path through those that are kept; units of H.
double worst_distance(const std::vector<Point>& points, const std::vector<std::size_t>& kept) {
  double worst = 0;
  for (std::size_t k = 0; k + 1 < kept.size(); ++k)
    for (std::size_t i = kept[k]; i <= kept[k + 1]; ++i)
      worst = std::max(worst, distance(kFrame.at(points[i]), kFrame.at(points[kept[k]]), kFrame.at(points[kept[k + 1]])));
  return worst;
}

TEST(ThinPoints, PassTheOthersByLessThanATenthOfAPixel) {
  constexpr double kTenth = 0.1 / 1080;
  std::mt19937 random(1);
  std::normal_distribution<double> step(0, 0.01);
  std::vector<Point> walk = samples(2500, [](double) { return 0.0; });
  for (std::size_t i = 1; i < walk.size(); ++i) walk[i].y = walk[i - 1].y + step(random);
  const std::vector<Point> wave = samples(4000, [](double t) { return std::sin(3 * t); });
  const std::vector<Point> steep = samples(4000, [](double t) { return std::tanh(400 * (t - 4.0003)); });
  for (const std::vector<Point>& points : {walk, wave, steep}) EXPECT_LT(worst_distance(points, thin_points(kFrame, points)), kTenth);

  const std::vector<std::size_t> kept = thin_points(kFrame, wave);
  EXPECT_LT(kept.size(), wave.size() / 10) << "a smooth curve needs few";
  std::vector<std::size_t> fewer;
  for (std::size_t k = 0; k < kept.size(); k += 3) fewer.push_back(kept[k]);
  EXPECT_GT(worst_distance(wave, fewer), kTenth) << "negative control";
}

// Of more than a page has columns for, those that a path through all shows: ends, and the highest and the lowest of each column.
TEST(ThinPoints, OfNoiseAreItsColumns) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> height(-0.5, 0.5);
  std::vector<Point> noise = samples(100000, [](double) { return 0.0; });
  for (Point& p : noise) p.y = height(random);
  noise[54321].y = 0.9;
  const std::vector<std::size_t> kept = thin_points(kFrame, noise);
  EXPECT_LE(kept.size(), 4 * (0.8 / 0.0007 + 2));
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), noise.size() - 1);
  EXPECT_TRUE(std::ranges::binary_search(kept, 54321u)) << "a peak";
  EXPECT_TRUE(std::ranges::is_sorted(kept));
}

TEST(ThinPoints, KeepEndsPeaksJumpsAndGaps) {
  EXPECT_THAT(thin_points(kFrame, std::vector<Point>{}), ElementsAre());
  EXPECT_THAT(thin_points(kFrame, std::vector<Point>{{1, 0}}), ElementsAre(0));
  EXPECT_THAT(thin_points(kFrame, samples(8, [](double t) { return t / 8; })), ElementsAre(0, 8)) << "a straight line";
  EXPECT_THAT(thin_points(kFrame, samples(8, [](double t) { return t == 3 ? 0.01 : 0.0; })), ElementsAre(0, 2, 3, 4, 8));
  const std::vector<Point> jump{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {3, 1}, {4, 1}};
  EXPECT_THAT(thin_points(kFrame, jump), ElementsAre(0, 2, 3, 5));
  const double soon = 1e-12;
  const std::vector<Point> edge{{0, 0}, {1, 0}, {1 + soon, 0.8}, {1 + 2 * soon, 0.1}, {1.001, 0.1}, {2, 0.1}, {3, 0.1}};
  EXPECT_THAT(thin_points(kFrame, edge), ElementsAre(0, 1, 2, 3, 6)) << "a needle, and no ramp behind it";
  EXPECT_THAT(thin_points(kFrame, samples(8, [](double t) { return t == 4 ? std::nan("") : 0.0; })), ElementsAre(0, 3, 4, 5, 8));
}

}  // namespace
}  // namespace chainreel

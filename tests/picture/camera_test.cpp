#include "picture/camera.hpp"

#include <gtest/gtest.h>

namespace chainreel {
namespace {

// Coordinates are sums and products of a few numbers of size 1: some units of 2^-52.
constexpr double kRoundOff = 1e-14;

const Rect kArea = {0.1, 0.2, 1.6, 0.9};

Rect projected(const Camera& camera, const Rect& box_m) {
  const Point low = camera.project({box_m.x0, box_m.y0, 0}), high = camera.project({box_m.x1, box_m.y1, 0});
  return {low.x, low.y, high.x, high.y};
}

TEST(Camera, FitTouchesTheAreaInItsTighterDirectionAndIsCentredInTheOther) {
  Camera camera;
  const Rect wide = {-3, -1, 5, 1}, tall = {2, 0, 3, 7};
  fit(camera, wide, kArea, 0);
  Rect seen = projected(camera, wide);
  EXPECT_NEAR(seen.x0, kArea.x0, kRoundOff);
  EXPECT_NEAR(seen.x1, kArea.x1, kRoundOff);
  EXPECT_NEAR(seen.y0 - kArea.y0, kArea.y1 - seen.y1, kRoundOff);
  EXPECT_GT(seen.y0, kArea.y0);

  fit(camera, tall, kArea, 0);
  seen = projected(camera, tall);
  EXPECT_NEAR(seen.y0, kArea.y0, kRoundOff);
  EXPECT_NEAR(seen.y1, kArea.y1, kRoundOff);
  EXPECT_NEAR(seen.x0 - kArea.x0, kArea.x1 - seen.x1, kRoundOff);
  EXPECT_GT(seen.x0, kArea.x0);
}

TEST(Camera, MarginIsAFractionOfTheBoxOnEverySide) {
  Camera camera;
  const Rect box = {-3, -1, 5, 1};
  fit(camera, box, kArea, 0.06);
  const Rect seen = projected(camera, box);
  EXPECT_NEAR(seen.x0 - kArea.x0, 0.06 * seen.width(), kRoundOff);
  EXPECT_NEAR(kArea.x1 - seen.x1, 0.06 * seen.width(), kRoundOff);
}

TEST(Camera, ABoxThatIsALineFillsTheAreaAlongIt) {
  Camera camera;
  fit(camera, {0, 2, 0, 6}, kArea, 0);
  EXPECT_NEAR(camera.scale, kArea.height() / 4, kRoundOff);
  fit(camera, {-1, 2, 2, 2}, kArea, 0);
  EXPECT_NEAR(camera.scale, kArea.width() / 3, kRoundOff);
}

TEST(Camera, ABoxThatIsAPointGetsOneMetre) {
  Camera camera;
  fit(camera, {4, 5, 4, 5}, kArea, 0.06);
  EXPECT_NEAR(camera.scale, kArea.height(), kRoundOff);
  const Point center = camera.project({4, 5, 0});
  EXPECT_NEAR(center.x, (kArea.x0 + kArea.x1) / 2, kRoundOff);
  EXPECT_NEAR(center.y, (kArea.y0 + kArea.y1) / 2, kRoundOff);
}

TEST(Camera, ProjectionForgetsDepthAndVectorsForgetTheOrigin) {
  Camera camera;  // looks along +y: x to the right, z up
  camera.up = Eigen::Vector3d::UnitZ();
  camera.toward_viewer = -Eigen::Vector3d::UnitY();
  camera.scale = 0.5;
  camera.origin = {0.8, 0.4};
  const Point near = camera.project({1, -3, 2}), far = camera.project({1, 9, 2});
  EXPECT_EQ(near.x, far.x);
  EXPECT_EQ(near.y, far.y);
  EXPECT_NEAR(near.x, 0.8 + 0.5 * 1, kRoundOff);
  EXPECT_NEAR(near.y, 0.4 + 0.5 * 2, kRoundOff);
  EXPECT_GT(camera.depth({1, -3, 2}), camera.depth({1, 9, 2}));
  EXPECT_EQ(camera.project_vector({0, 5, 0}, {0, 0, 0}).x, 0);
  EXPECT_EQ(camera.project_vector({0, 5, 0}, {0, 0, 0}).y, 0);
}

TEST(Camera, ABoxLargerThanTheFittedOneLeavesTheArea) {
  Camera camera;  // negative control: what was not fitted does not fit
  fit(camera, {-1, -1, 1, 1}, kArea, 0.06);
  EXPECT_LT(projected(camera, {-1, -1.2, 1, 1}).y0, kArea.y0);
}

}  // namespace
}  // namespace chainreel

#include "draw/robot/view.hpp"

#include <gtest/gtest.h>

#include "draw/chains.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr double kViewRoundOff = 1e-14;  // a few operations on unit vectors

void expect_axes(const Camera& camera, const Vector3d& right, const Vector3d& up) {
  EXPECT_LT((camera.right - right).norm(), kViewRoundOff) << camera.right.transpose();
  EXPECT_LT((camera.up - up).norm(), kViewRoundOff) << camera.up.transpose();
  EXPECT_LT((camera.toward_viewer - right.cross(up)).norm(), kViewRoundOff);
}

TEST(View, ShowsTheXyPlaneWithGravityDownThePage) {
  expect_axes(view_of(test::model("rr")), Vector3d::UnitX(), Vector3d::UnitY());
}

TEST(View, WithoutGravityPutsYUp) {
  expect_axes(view_of(test::model("pp", Vector3d::Zero())), Vector3d::UnitX(), Vector3d::UnitY());
  // Gravity along the normal does no work in the plane: it does not tilt the page either.
  expect_axes(view_of(test::model("rr", {0, 0, -9.81})), Vector3d::UnitX(), Vector3d::UnitY());
}

TEST(View, TurnsThePageWhereGravityPointsAlongPlusY) {
  expect_axes(view_of(test::model("rr", {0, 9.81, 0})), Vector3d::UnitX(), -Vector3d::UnitY());
}

TEST(View, ShowsAnUprightPlaneFromTheSideWhereXPointsRight) {
  const Chain chain = test::two_links(Vector3d::UnitX(), Vector3d::UnitY(), {0, 0, -9.81});
  ASSERT_TRUE(chain.planar);
  expect_axes(view_of(chain), Vector3d::UnitX(), Vector3d::UnitZ());
}

TEST(View, ShowsTurnsFromTheFrontWhereGravityPointsAlongX) {
  expect_axes(view_of(test::model("rr", {-9.81, 0, 0})), -Vector3d::UnitY(), Vector3d::UnitX());
  expect_axes(view_of(test::model("rr", {9.81, 0, 0})), Vector3d::UnitY(), -Vector3d::UnitX());
}

TEST(View, PointsTheFirstLinkRightWhereXIsNotInThePlane) {
  const Chain ahead = test::two_links(Vector3d::UnitY(), Vector3d::UnitX(), {0, 0, -9.81});
  ASSERT_TRUE(ahead.planar);
  expect_axes(view_of(ahead), Vector3d::UnitY(), Vector3d::UnitZ());
  // The other way round the page is seen from the other side.
  const Chain back = test::two_links(-Vector3d::UnitY(), Vector3d::UnitX(), {0, 0, -9.81});
  expect_axes(view_of(back), -Vector3d::UnitY(), Vector3d::UnitZ());
}

TEST(View, LooksAtSpatialChainsFromAboveWithZUp) {
  Chain chain = test::model("rr", {0, 0, -9.81});
  chain.planar.reset();
  const Camera camera = view_of(chain);
  EXPECT_NEAR(camera.right.z(), 0, kViewRoundOff);
  EXPECT_GT(camera.right.x(), 0.5);
  EXPECT_NEAR(camera.toward_viewer.z(), std::sin(20 * M_PI / 180), kViewRoundOff);
  EXPECT_GT(camera.up.z(), 0.9);
  EXPECT_LT((camera.right.cross(camera.up) - camera.toward_viewer).norm(), kViewRoundOff);
}

TEST(View, SpatialChainsStandUprightWhereGravityIsAlongAnAxis) {
  CameraEntry level;
  level.azimuth = level.elevation = 0;
  const auto seen = [&](const Vector3d& gravity) {
    Chain chain = test::model("rr", gravity);
    chain.planar.reset();
    return view_of(chain, level);
  };
  expect_axes(seen({0, 0, -9.81}), Vector3d::UnitX(), Vector3d::UnitZ());
  expect_axes(seen({0, -9.81, 0}), Vector3d::UnitX(), Vector3d::UnitY());
  expect_axes(seen({9.81, 0, 0}), Vector3d::UnitY(), -Vector3d::UnitX());
  for (const Vector3d& aslant : {Vector3d(0, -7, -7), Vector3d(0, 0, 0)}) expect_axes(seen(aslant), Vector3d::UnitX(), Vector3d::UnitZ());
}

}  // namespace
}  // namespace chainreel

// Arcs of torques about joints that come close to one another.
#include "draw/layers/arcs_apart.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "picture/point.hpp"
#include "picture/theme.hpp"

namespace chainreel {
namespace {

constexpr double kArc = size::kTorqueArc;
constexpr double kArcRoundOff = 1e-12;  // of sums of numbers below 1

std::vector<double> radii_at(double distance, double second = kArc) {
  std::vector<double> radii = arcs_apart({{{0.3, 0.3}, kArc}, {{0.3 + distance, 0.3}, second}}, 1);
  radii[0] *= kArc;
  radii[1] *= second;
  return radii;
}

TEST(ArcsApart, LieBesideEachOtherOrOneInTheOther) {
  int beside = 0, inside = 0, crossing = 0;
  for (double distance = 0; distance < 0.3; distance += 0.001) {
    const std::vector<double> radii = radii_at(distance);
    // The head of an arc takes half of its width to both sides.
    const bool is_beside = radii[0] + radii[1] + size::kArrowHeadWidth < distance + kArcRoundOff;
    const bool is_inside = distance + radii[1] + size::kArrowHeadWidth < radii[0] + kArcRoundOff;
    ++(is_beside ? beside : is_inside ? inside : crossing);
    if (distance > 2 * kArc + 0.03) EXPECT_EQ(radii[0], kArc) << distance;
  }
  EXPECT_GT(inside, 20);
  // Without it they would cross up to twice their radius.
  EXPECT_LT(crossing, 55);
  EXPECT_GT(beside, 200);
}

TEST(ArcsApart, NoJointThatMovesALittleMakesAnArcJump) {
  for (double distance = 0; distance < 0.3; distance += 0.001) {
    const std::vector<double> before = radii_at(distance), now = radii_at(distance + 0.001);
    for (const std::size_t i : {0u, 1u}) EXPECT_LT(std::abs(now[i] - before[i]), 0.0015) << distance;
  }
}

TEST(ArcsApart, WhatIsHardlySeenIsNotInTheWay) {
  EXPECT_NEAR(radii_at(0.04, 1e-9)[0], kArc, 1e-6 * kArc);
  EXPECT_LT(radii_at(0.08, kArc)[0], 0.8 * kArc);  // negative control
}

}  // namespace
}  // namespace chainreel

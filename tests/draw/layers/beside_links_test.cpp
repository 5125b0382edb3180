// Arrows that would hide a link stand beside it, tied to where they act, without a jump.

#include "draw/layers/beside_links.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

constexpr double kBesideRoundOff = 1e-9;  // of places that are sums of a few numbers of size 1
constexpr double kFps = 60;

LiesAlong at_angle(double degrees, double length = 0.12) {
  const double angle = degrees * std::numbers::pi / 180;
  return lies_along({{0, 0}, {0, -length}}, {{0, 0}, {0.3 * std::sin(angle), -0.3 * std::cos(angle)}}, 0.0125);
}

TEST(BesideLinks, OnlyWhatLiesAlongALinkHidesIt) {
  EXPECT_EQ(at_angle(0).much, 1);
  EXPECT_EQ(at_angle(5).much, 1);
  EXPECT_GT(at_angle(14).much, 0);
  EXPECT_LT(at_angle(14).much, 1);
  EXPECT_EQ(at_angle(25).much, 0);
  EXPECT_EQ(at_angle(90).much, 0);
  EXPECT_EQ(at_angle(180).much, 0) << "it goes on where the link ends";
  EXPECT_EQ(at_angle(0, 1.2).much, 0) << "most of it lies beyond the link";
  EXPECT_EQ(at_angle(0, 0.02).much, 0) << "so short a one hides little";
  // The link leans to the left of an arrow that hangs: to the right on the page.
  EXPECT_NEAR(at_angle(5).leans, std::sin(5 * std::numbers::pi / 180), kBesideRoundOff);
  EXPECT_NEAR(at_angle(-5).leans, -std::sin(5 * std::numbers::pi / 180), kBesideRoundOff);
}

std::vector<LiesAlong> hidden_between(int from, int to, double leans) {
  std::vector<LiesAlong> along(120);
  for (int k = from; k < to; ++k) along[std::size_t(k)] = {1, leans};
  return along;
}

TEST(BesideLinks, ArrowsAreAsideInTimeAndGoThereWithoutAJump) {
  const std::vector<double> ways = ways_aside(hidden_between(50, 80, 0.1), kFps);
  for (int k = 50; k < 80; ++k) EXPECT_EQ(ways[std::size_t(k)], -1) << "to the right of a link that leans to the left";
  EXPECT_EQ(ways_aside(hidden_between(50, 80, -0.1), kFps)[60], 1);
  for (std::size_t k = 1; k < ways.size(); ++k)
    // 0.3 s for the way, at most 1.5 times as fast as evenly.
    EXPECT_LE(std::abs(ways[k] - ways[k - 1]), 1.5 / (0.3 * kFps) + kBesideRoundOff) << k;
  EXPECT_EQ(ways[20], 0);
  EXPECT_EQ(ways[110], 0);
}

TEST(BesideLinks, ALinkThatSwingsPastLeavesArrowsWhereTheyAct) {
  for (const double way : ways_aside(hidden_between(50, 60, 0.1), kFps)) EXPECT_EQ(way, 0);
  // But in the first picture and in the last one, which are looked at for long.
  EXPECT_EQ(ways_aside(hidden_between(0, 10, 0.1), kFps).front(), -1);
  EXPECT_EQ(ways_aside(hidden_between(110, 120, 0.1), kFps).back(), -1);
}

// Shafts of weights in the picture of an RR at rest, and the dots where they act.
struct HangingWeights {
  explicit HangingWeights(std::vector<double> q) : scene(), simulation() {
    scene.draw = {"chain", "gravity"};
    simulation.chain = test::model("rr");
    simulation.torque = make_torque_law(simulation.chain, {}, {});
    run = test::run_of([q](double) { return q; }, 60);
    const Film film(scene, {{scene, simulation.chain, run, &simulation}}, run.t, fonts);
    camera = film.camera();
    const auto is_force = [](Color color) { return color == light_theme().force; };
    for (const Item& item : film.frame(30).items) {
      if (item.clip < 0) continue;
      if (const auto* line = std::get_if<Capsule>(&item.shape); line && is_force(line->paint.fill)) lines.push_back(*line);
      if (const auto* dot = std::get_if<Ellipse>(&item.shape); dot && is_force(dot->paint.fill)) dots.push_back(dot->center);
    }
  }

  Scene scene;
  Simulation simulation;
  Trajectory run;
  Fonts fonts;
  Camera camera;
  std::vector<Capsule> lines;
  std::vector<Point> dots;
};

TEST(BesideLinks, TheWeightOfALinkAboveOneThatHangsStandsBesideThat) {
  const double down = -std::numbers::pi / 2;
  const HangingWeights hanging({down, 0});
  const Point elbow = hanging.camera.project({0, -1, 0}), tip = hanging.camera.project({0, -2, 0});
  ASSERT_EQ(hanging.lines.size(), 3u) << "a tie and two shafts";
  ASSERT_EQ(hanging.dots.size(), 1u);
  EXPECT_LT(test::distance(hanging.dots[0], elbow), kBesideRoundOff);
  EXPECT_LT(test::distance(hanging.lines[0].a, elbow), kBesideRoundOff) << "the tie begins where the weight acts";
  EXPECT_LT(test::distance(hanging.lines[0].b, hanging.lines[1].a), kBesideRoundOff) << "... and ends at its arrow";
  EXPECT_NEAR(hanging.lines[1].a.y, elbow.y, kBesideRoundOff);
  // The link, as wide as look_of has it, and the arrow do not touch.
  const double half_of_link = kLinkWidthOfShortest * hanging.camera.scale / 2;
  EXPECT_GT(std::abs(hanging.lines[1].a.x - elbow.x), half_of_link + size::kArrowHeadWidth / 2);
  EXPECT_LT(test::distance(hanging.lines[2].a, tip), kBesideRoundOff) << "below the tip is no link";

  const HangingWeights bent({down, -down});
  EXPECT_EQ(bent.lines.size(), 2u) << "nothing lies along a link";
  EXPECT_TRUE(bent.dots.empty());
  EXPECT_LT(test::distance(bent.lines[0].a, bent.camera.project({0, -1, 0})), kBesideRoundOff);
}

}  // namespace
}  // namespace chainreel

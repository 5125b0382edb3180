#include "draw/layers/past.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "draw/film/film.hpp"
#include "draw/robot/chain.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/theme.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

constexpr double kOmega = 2.0;  // rad/s

// A circle on the page, sampled at 60 frames a second.
TipPath circle(int frames) {
  TipPath path;
  for (int k = 0; k < frames; ++k) {
    const double t = k / 60.0, c = std::cos(kOmega * t), s = std::sin(kOmega * t);
    path.add(t, {0.8 + 0.3 * c, 0.5 + 0.3 * s}, {-0.3 * kOmega * s, 0.3 * kOmega * c});
  }
  return path;
}

Point on_circle(double t) {
  return {0.8 + 0.3 * std::cos(kOmega * t), 0.5 + 0.3 * std::sin(kOmega * t)};
}

TEST(Trail, GoesBackOneSecondAndNoFurther) {
  const TipPath path = circle(200);
  Picture picture;
  draw_trail(picture, path, 150, light_theme().curve[1], -1);
  const auto trails = test::all_of<Trail>(picture);
  ASSERT_EQ(trails.size(), 1u);
  const auto& points = trails[0].points;
  // Between frames the cubic misses the circle by (h omega)^4 / 384 of its radius: 1e-9.
  EXPECT_LT(test::distance(points.front().p, on_circle(150 / 60.0 - 1)), 1e-8);
  EXPECT_LT(test::distance(points.back().p, on_circle(150 / 60.0)), 1e-8);
  for (const TrailPoint& p : points) EXPECT_NEAR(test::distance(p.p, {0.8, 0.5}), 0.3, 1e-8);
}

TEST(Trail, GoesBackAsFarAsAStyleSays) {
  const TipPath path = circle(200);
  for (const double length : {0.4, 2.0, 60.0}) {
    Picture picture;
    draw_trail(picture, path, 150, light_theme().curve[1], -1, 1, length);
    const std::vector<TrailPoint> points = test::all_of<Trail>(picture).at(0).points;
    const double from = std::max(0.0, 150 / 60.0 - length);
    EXPECT_LT(test::distance(points.front().p, on_circle(from)), 1e-8) << length;
    EXPECT_NEAR(points.front().alpha, kTrailOpacity * (1 - (150 / 60.0 - from) / length), 1e-12);
  }
}

// 0.3 H kOmega in a second: a bound of half of that is half a second of the circle, faded over that; a longer one changes nothing.
TEST(Trail, OfAFastEndEffectorIsBoundedByItsWay) {
  const TipPath path = circle(200);
  const double way = 0.3 * kOmega;
  Picture bounded, free, unbounded;
  draw_trail(bounded, path, 150, light_theme().curve[1], -1, 1, kTrailSeconds, kTrailOpacity, way / 2);
  draw_trail(free, path, 150, light_theme().curve[1], -1, 1, kTrailSeconds, kTrailOpacity, 1.01 * way);
  draw_trail(unbounded, path, 150, light_theme().curve[1], -1);
  const std::vector<TrailPoint> points = test::all_of<Trail>(bounded).at(0).points;
  // Chords of at most kPiece = 0.006 H are shorter than the circle's arc by (0.02)^2 / 24 of it.
  EXPECT_LT(test::distance(points.front().p, on_circle(150 / 60.0 - 0.5)), 1e-4);
  EXPECT_NEAR(points.front().alpha, 0, 1e-12);
  EXPECT_NEAR(points.back().alpha, kTrailOpacity, 1e-12);
  const std::vector<TrailPoint> one = test::all_of<Trail>(free).at(0).points, other = test::all_of<Trail>(unbounded).at(0).points;
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].alpha, other[i].alpha);
}

TEST(Trail, IsAsWideAsTheLinesOfAStyle) {
  const TipPath path = circle(200);
  Picture plain, wide;
  draw_trail(plain, path, 150, light_theme().curve[1], -1);
  draw_trail(wide, path, 150, light_theme().curve[1], -1, 1.5);
  const Trail one = test::all_of<Trail>(plain).at(0), other = test::all_of<Trail>(wide).at(0);
  ASSERT_EQ(one.points.size(), other.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) EXPECT_DOUBLE_EQ(other.points[i].width, 1.5 * one.points[i].width);
  const Ellipse dot = test::all_of<Ellipse>(plain).at(0), wide_dot = test::all_of<Ellipse>(wide).at(0);
  EXPECT_DOUBLE_EQ(wide_dot.u.x, 1.5 * dot.u.x);
}

TEST(Trail, ThinsAndFadesFromHeadToEnd) {
  const TipPath path = circle(200);
  Picture picture;
  draw_trail(picture, path, 150, light_theme().curve[1], -1);
  const auto points = test::all_of<Trail>(picture).at(0).points;
  EXPECT_DOUBLE_EQ(points.back().width, size::kTrailHead);
  EXPECT_DOUBLE_EQ(points.back().alpha, kTrailOpacity);
  EXPECT_NEAR(points.front().width, size::kTrailTail, 1e-12);
  EXPECT_NEAR(points.front().alpha, 0, 1e-12);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_GT(points[i].width, points[i - 1].width);
    EXPECT_GT(points[i].alpha, points[i - 1].alpha);
  }
}

TEST(Trail, HasDotsAtWholeTenthsOfASecondThatStandStill) {
  const TipPath path = circle(200);
  const auto dots_at = [&](int k) {
    Picture picture;
    draw_trail(picture, path, k, light_theme().curve[1], -1);
    return test::all_of<Ellipse>(picture);
  };
  const auto dots = dots_at(150);  // t = 2.5 s: dots at 1.6 .. 2.5 s, the one at 1.5 s has faded
  ASSERT_EQ(dots.size(), 10u);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    EXPECT_LT(test::distance(dots[i].center, on_circle(1.6 + 0.1 * double(i))), 1e-8);
    EXPECT_DOUBLE_EQ(test::length(dots[i].u), size::kTrailDot / 2);
  }
  EXPECT_LT(test::distance(dots_at(151).at(0).center, dots[0].center), 1e-12);
}

TEST(Trail, IsShorterAtTheBeginningAndAbsentAtTheStart) {
  const TipPath path = circle(40);
  Picture start, early;
  draw_trail(start, path, 0, light_theme().curve[0], -1);
  EXPECT_TRUE(start.items.empty());
  draw_trail(early, path, 30, light_theme().curve[0], -1);
  EXPECT_LT(test::distance(test::all_of<Trail>(early).at(0).points.front().p, on_circle(0)), 1e-12);
}

// A pause repeats its instant: what was drawn there was no number, and no vector file had a trail.
TEST(Trail, GoesOnThroughAPause) {
  TipPath path;
  for (int k = 0; k < 60; ++k) path.add(std::min(k, 30) / 60.0, on_circle(std::min(k, 30) / 60.0), {});
  Picture picture;
  draw_trail(picture, path, 45, light_theme().curve[0], -1);
  EXPECT_TRUE(test::all_finite(picture));
  const auto points = test::all_of<Trail>(picture).at(0).points;
  EXPECT_LT(test::distance(points.front().p, on_circle(0)), 1e-12);
  EXPECT_LT(test::distance(points.back().p, on_circle(0.5)), 1e-12);
}

TEST(Trail, NeverCrossesAGap) {
  TipPath path;
  for (int k = 0; k < 60; ++k) {
    const bool wild = k == 20;
    path.add(k / 60.0, {wild ? 1e9 : 0.5 + 0.005 * k, wild ? std::nan("") : 0.5}, {0.3, 0});
  }
  Picture picture;
  draw_trail(picture, path, 50, light_theme().curve[0], -1);
  const auto points = test::all_of<Trail>(picture).at(0).points;
  EXPECT_NEAR(points.front().p.x, 0.5 + 0.005 * 21, 1e-12);
  EXPECT_TRUE(test::all_finite(picture));
  Picture at_gap;
  draw_trail(at_gap, path, 20, light_theme().curve[0], -1);
  EXPECT_TRUE(at_gap.items.empty());
}

// Negative control: the check above does see a trail that is too long.
TEST(Trail, OfATwiceAsFastClockWouldReachTwiceAsFarBack) {
  TipPath path;
  for (int k = 0; k < 200; ++k) path.add(k / 120.0, on_circle(k / 60.0), {});
  Picture picture;
  draw_trail(picture, path, 150, light_theme().curve[1], -1);
  EXPECT_GT(test::distance(test::all_of<Trail>(picture).at(0).points.front().p, on_circle(150 / 60.0 - 1)),
            0.1);
}

// Two arms that swing at a free trunk.
constexpr char kTwoEnds[] = R"(<robot name="two">
  <link name="trunk"><inertial><mass value="3"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="left"><inertial><origin xyz="0 0 -0.4"/><mass value="1"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="right"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="l" type="continuous"><origin xyz="0 0.3 0"/><axis xyz="1 0 0"/><parent link="trunk"/><child link="left"/></joint>
  <joint name="r" type="continuous"><origin xyz="0 -0.3 0"/><axis xyz="1 0 0"/><parent link="trunk"/><child link="right"/></joint>
</robot>
)";

class FreeRobot : public ::testing::Test {
 protected:
  explicit FreeRobot(const std::string& base = "floating") {
    folder_.write("two.urdf", kTwoEnds);
    scene = read_scene(folder_.write("two.yaml", "model: two.urdf\nbase: " + base + "\ngravity: [0, 0, -9.81]\nduration: 1\nlayout: scene\nmethod: rk4\nstep: 1ms\nstart: {qd: [" +
                                                (base == "floating" ? "0, 0, 0, 0, 0, 0, " : "") + "3, -5]}\n"));
    simulation = prepare(scene, false);
    for (int k = 0; k < 60; ++k) times.push_back(k / 60.0);
    run = simulate(simulation, times);
  }
  Film film() const { return Film(scene, {{scene, simulation.chain, run, &simulation}}, times, fonts); }
  std::vector<TrailPoint> trail_at(int k) const {
    const auto trails = test::all_of<Trail>(film().frame(k), [](const Trail& trail) { return trail.color == light_theme().ink; });
    return trails.empty() ? std::vector<TrailPoint>() : trails.front().points;
  }

  Scene scene;
  Simulation simulation;
  std::vector<double> times;
  Trajectory run;
  Fonts fonts;

 private:
  TemporaryFolder folder_;
};

// What moves within does not move it: however the arms swing it falls as a point does, g t^2 / 2.
TEST_F(FreeRobot, WithSeveralEndsIsFollowedByItsCentreOfMass) {
  Workspace ws(simulation.chain);
  compute_kinematics(simulation.chain, ws, run.q_at(0), run.qd_at(0));
  const Eigen::Vector3d start = center_of_mass(simulation.chain, ws), speed = center_velocity(simulation.chain, ws);
  EXPECT_GT(speed.norm(), 0.1) << "negative control: it is not at rest";
  const Camera camera = film().camera();
  constexpr double kOfRun = 1e-5;  // units of H: the state is of RK4 at 1 ms, between frames the cubic has a parabola to (g h^2) / 8 of its eye's bend
  for (const int k : {6, 30, 59}) {
    const std::vector<TrailPoint> points = trail_at(k);
    ASSERT_GT(points.size(), 2u) << k;
    const auto place = [&](double t) { return camera.project(start + t * speed - Eigen::Vector3d(0, 0, 9.81 * t * t / 2)); };
    EXPECT_LT(test::distance(points.back().p, place(times[std::size_t(k)])), kOfRun) << k;
    EXPECT_LT(test::distance(points.front().p, place(0)), kOfRun) << "it goes back all of the fall, many times its size";
  }
}

class HeldRobot : public FreeRobot {
 protected:
  HeldRobot() : FreeRobot("fixed") {}
};

TEST_F(HeldRobot, WithSeveralEndsHasNoTrail) {
  EXPECT_TRUE(trail_at(30).empty());
  EXPECT_EQ(std::ranges::count(scene.draw, "trail"), 0);
}

}  // namespace
}  // namespace chainreel

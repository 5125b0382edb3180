// What films say of events, and the foot with what the ground answers.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

class FallingHuman : public ::testing::Test {
 protected:
  FallingHuman()
      : scene_(read_scene("assets/scenes/humanoid_fall.yaml")), simulation_(prepare(scene_, false)) {
    for (int k = 0; k < 120; ++k) times_.push_back(k / 60.0);
    run_ = simulate(simulation_, times_);
  }

  Film film(const Simulation* simulation) {
    return {scene_, {{scene_, simulation_.chain, run_, simulation}}, times_, fonts_};
  }

  Scene scene_;
  Simulation simulation_;
  std::vector<double> times_;
  Trajectory run_;
  Fonts fonts_;
};

TEST_F(FallingHuman, IsNotedFromTheInstantOn) {
  const Film film = this->film(&simulation_);
  ASSERT_EQ(run_.events.size(), 2);
  for (int k = 0; k < run_.size(); ++k) {
    const std::string note = film.panel(0).note(k);
    const double t = run_.t[std::size_t(k)];
    EXPECT_EQ(note.empty(), t < run_.events.t[0]) << t;
    EXPECT_EQ(note.find("hip where the knee was") != std::string::npos, t >= run_.events.t[1]) << t;
  }
  EXPECT_EQ(film.panel(0).note(119),
            "centre of pressure leaves the foot at t = 1.53 s;  hip where the knee was at t = 1.65 s");
  EXPECT_EQ(film.panel(0).title(), "A standing human falls in 1.65 s");
}

TEST_F(FallingHuman, IsNotNotedOnNothing) {
  EXPECT_THAT(test::words_of(film(&simulation_).frame(119)), HasSubstr("hip where the knee was"));
  std::erase(scene_.draw, "torque");
  scene_.layout = PageLayout::transparent;
  const Film film = this->film(&simulation_);
  EXPECT_EQ(test::words_of(film.static_layer()) + test::words_of(film.frame(119)), "");
  const double height = film.scene_area().height();
  scene_.events.clear();
  EXPECT_DOUBLE_EQ(height, this->film(&simulation_).scene_area().height()) << "no row is kept for it";
}

TEST_F(FallingHuman, HasAnArrowWhereTheGroundPushes) {
  std::erase(scene_.draw, "torque");
  const auto shapes = [&](const Simulation* simulation, int k) {
    return film(simulation).frame(k).items.size();
  };
  EXPECT_GT(shapes(&simulation_, 60), shapes(nullptr, 60)) << "negative control: nothing to compute it from";
  // At the end the fixed foot is pulled down: no ground does that.
  const Color force = theme_named("light").constraint;
  const auto forces = [&](int k) {
    const Picture frame = film(&simulation_).frame(k);
    const std::vector<Ellipse> discs = test::all_of<Ellipse>(frame);
    return std::ranges::count_if(discs, [&](const Ellipse& disc) { return disc.paint.stroke == force; });
  };
  EXPECT_EQ(forces(60), 1);
  EXPECT_EQ(forces(run_.size() - 1), 0);
}

// Its line ends on the ground below the centre of mass: within the foot at the start, ahead of it in the end.
TEST_F(FallingHuman, APlumbLineFallsFromTheCentreOfMass) {
  scene_.draw = {"chain"};
  const Film film = this->film(&simulation_);
  const double ground = [&] {
    double y = 0;
    for (const Ellipse& disc : test::all_of<Ellipse>(film.frame(60)))
      if (disc.paint.stroke == theme_named("light").constraint) y = disc.center.y;
    return y;
  }();
  std::vector<double> places;
  for (const int k : {0, run_.size() - 1}) {
    std::optional<Capsule> lowest;
    for (const Capsule& dash : test::all_of<Capsule>(film.frame(k)))
      if (dash.paint.fill == theme_named("light").ink && std::abs(dash.a.x - dash.b.x) < 1e-9 && (!lowest || dash.b.y < lowest->b.y)) lowest = dash;
    ASSERT_TRUE(lowest);
    EXPECT_NEAR(lowest->b.y, ground, 0.008) << "to the ground, but for a gap of the dashes";
    places.push_back(lowest->b.x);
  }
  EXPECT_GT(places[1], places[0] + 0.1);
}

// Where a real foot would tip the picture says that this one is held, and nowhere else.
TEST_F(FallingHuman, IsSaidToBeHeldWhereARealFootWouldTip) {
  EXPECT_THAT(test::words_of(film(&simulation_).frame(run_.size() - 1)), HasSubstr("foot held"));
  EXPECT_THAT(test::words_of(film(&simulation_).frame(0)), Not(HasSubstr("held")));
}

TEST_F(FallingHuman, TheGroundPushesFromBelowWhereThePressureIsMarked) {
  scene_.draw = {"chain"};
  const Film film = this->film(&simulation_);
  const Color force = theme_named("light").constraint;
  std::optional<Point> mark;
  const Picture frame = film.frame(60);
  for (const Ellipse& disc : test::all_of<Ellipse>(frame))
    if (disc.paint.stroke == force) mark = disc.center;
  ASSERT_TRUE(mark);
  double highest = -HUGE_VAL, lowest = HUGE_VAL;
  Picture in_scene = frame;  // the arrow of its scale is in the foot
  std::erase_if(in_scene.items, [](const Item& item) { return item.clip < 0; });
  for (const Polygon& part : test::all_of<Polygon>(in_scene))
    for (int i = 0; part.paint.fill == force && i < part.count; ++i) highest = std::max(highest, part.corners[std::size_t(i)].y);
  for (const Capsule& part : test::all_of<Capsule>(in_scene))
    if (part.paint.fill == force) lowest = std::min({lowest, part.a.y, part.b.y});
  EXPECT_NEAR(highest, mark->y, 0.002) << "the head ends there";
  EXPECT_LT(lowest, mark->y - 0.1) << "the shaft comes from below";
  EXPECT_GT(lowest, film.scene_area().y0) << "the camera holds it";
  // The ground goes from side to side.
  double left = HUGE_VAL, right = -HUGE_VAL;
  for (const Capsule& line : test::all_of<Capsule>(film.static_layer()))
    if (std::abs(line.a.y - line.b.y) < 1e-9) left = std::min({left, line.a.x, line.b.x}), right = std::max({right, line.a.x, line.b.x});
  EXPECT_NEAR(left, film.scene_area().x0, 1e-6);
  EXPECT_NEAR(right, film.scene_area().x1, 1e-6);
}

}  // namespace
}  // namespace chainreel

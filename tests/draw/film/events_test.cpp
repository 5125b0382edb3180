// What films say of events, and the foot with what the ground answers.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/torques_along.hpp"

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
            "t = 1.53 s: centre of pressure leaves the foot;  t = 1.65 s: hip where the knee was");
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
  const Color force = theme_named("light").constraint;
  const auto forces = [&](int k) {
    const Picture frame = film(&simulation_).frame(k);
    const std::vector<Ellipse> discs = test::all_of<Ellipse>(frame);
    return std::ranges::count_if(discs, [&](const Ellipse& disc) { return disc.paint.stroke == force; });
  };
  EXPECT_EQ(forces(60), 1);
  EXPECT_EQ(forces(run_.size() - 1), 0) << "the foot is held";
}

// At the end the fixed foot is pulled down at its heel, by an arrow into the ground, and the ground presses at the toe.
TEST_F(FallingHuman, IsHeldByAPullAtTheHeel) {
  scene_.draw = {"chain"};
  const Film film = this->film(&simulation_);
  const Color force = theme_named("light").constraint;
  struct Arrow {
    double pressed = NAN, ground = NAN, left = HUGE_VAL, right = -HUGE_VAL, below = HUGE_VAL;
  };
  const auto arrow_at = [&](int k) {
    Arrow arrow;
    Picture frame = film.frame(k);
    std::erase_if(frame.items, [](const Item& item) { return item.clip < 0; });
    for (const Ellipse& disc : test::all_of<Ellipse>(frame))
      if (disc.paint.fill == force) arrow.pressed = disc.center.x, arrow.ground = disc.center.y;
    for (const Polygon& head : test::all_of<Polygon>(frame)) {
      if (head.paint.fill != force) continue;
      const Point tip = head.corners[0];
      arrow.right = std::max(arrow.right, tip.x);
      if (tip.x < arrow.left) arrow.left = tip.x, arrow.below = tip.y;
    }
    return arrow;
  };
  const Arrow stands = arrow_at(60), held = arrow_at(run_.size() - 1);
  EXPECT_NEAR(stands.left, stands.pressed, 0.002) << "negative control: the only arrow ends where the ground presses";
  const Camera& camera = film.panel(0).camera();
  EXPECT_NEAR(held.right, camera.project({0.1995, 0, 0}).x, 0.002) << "the toe";
  EXPECT_NEAR(held.left, camera.project({-0.0665, 0, 0}).x, 1e-9) << "the heel";
  EXPECT_LT(held.below, stands.ground - 0.02);
}

// The height that counts as a fall is a line with the event's name, which the ring at the hip has come to at the end.
TEST_F(FallingHuman, MeetsTheHeightThatCountsAsAFall) {
  scene_.draw = {"chain"};
  scene_.layout = PageLayout::scene;
  const Color ink = theme_named("light").ink, muted = theme_named("light").muted;
  const auto rings = [&](const Film& film, int k) {
    std::vector<Point> found;
    for (const Ellipse& ring : test::all_of<Ellipse>(film.frame(k)))
      if (ring.paint.stroke == ink && ring.paint.fill == theme_named("light").background && norm(ring.u) < 0.009 && norm(ring.u) > 0.008) found.push_back(ring.center);
    return found;
  };
  const auto has_line = [&](const Film& film, double y) {
    return std::ranges::any_of(test::all_of<Capsule>(film.frame(0)), [&](const Capsule& dash) {
      return dash.paint.fill == muted && std::abs(dash.a.y - y) < 1e-9 && std::abs(dash.b.y - y) < 1e-9;
    });
  };
  {
    const Film film = this->film(&simulation_);
    const double height = film.panel(0).camera().project({0, 0.5, 0}).y;
    EXPECT_TRUE(has_line(film, height));
    EXPECT_THAT(test::words_of(film.frame(0)), HasSubstr("hip where the knee was"));
    ASSERT_EQ(rings(film, 0).size(), 1);
    EXPECT_GT(rings(film, 0).front().y, height + 0.1);
    ASSERT_EQ(rings(film, run_.size() - 1).size(), 1);
    EXPECT_NEAR(rings(film, run_.size() - 1).front().y, height, 1e-6);  // the instant is known to 1e-12 s
  }
  // Negative controls: what only is marked counts as no fall, and what two numbers decide on has no height.
  for (const auto& [kind, when] : {std::pair{EventKind::stop, "y_H < 0.5"}, {EventKind::fall, "y_H + 0.001 * q1 < 0.5"}, {EventKind::fall, "y_H > 3"}}) {
    scene_.events.back().kind = kind;
    scene_.events.back().when = when;
    const Simulation other = prepare(scene_, false);
    const Film film = this->film(&other);
    EXPECT_EQ(rings(film, 0).size(), 0) << when;
  }
}

// Without a plot of the scene's own the page tells where the ground presses, between the ends of the foot.
TEST_F(FallingHuman, IsToldByTheCentreOfPressure) {
  const std::string words = test::words_of(film(&simulation_).static_layer());
  for (const char* word : {"centre of pressure", "heel", "toe"}) EXPECT_THAT(words, HasSubstr(word));
  EXPECT_THAT(words, Not(HasSubstr("to 0."))) << "it runs off to a pole, and no sample there tells how far";
  scene_.layout = PageLayout::scene;
  EXPECT_THAT(test::words_of(film(&simulation_).static_layer()), Not(HasSubstr("heel")));
}

// Where the foot is held no ground presses there: the arrow of the pull is named, and no centre of pressure stands at the toe.
TEST_F(FallingHuman, HasNoCentreOfPressureWhereTheFootIsHeld) {
  const Film film = this->film(&simulation_);
  const auto centres = [&](int k) {
    return test::all_of<Ellipse>(film.frame(k), [](const Ellipse& disc) { return disc.paint.stroke == theme_named("light").constraint; }).size();
  };
  EXPECT_EQ(centres(0), 1u);
  EXPECT_EQ(centres(run_.size() - 1), 0u);
  EXPECT_THAT(test::words_of(film.static_layer()), HasSubstr("holds the foot"));
  times_.resize(30), run_ = simulate(simulation_, times_);
  EXPECT_THAT(test::words_of(this->film(&simulation_).static_layer()), Not(HasSubstr("holds the foot"))) << "before it has to be";
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

// The last picture has the number of its instant, which is narrower than that of the peak in the film's frames: it keeps off the line of the fall, too.
TEST_F(FallingHuman, NoLineStrikesTheNumbersOfTheLastPicture) {
  scene_.video.width = 1920, scene_.video.height = 1080;
  const Picture last = film(&simulation_).still(run_.size() - 1);
  const Theme& theme = theme_named("light");
  int numbers = 0, dashes = 0;
  for (const Capsule& dash : test::all_of<Capsule>(last)) {
    if (dash.paint.fill != theme.muted || std::abs(dash.a.y - dash.b.y) > 1e-9) continue;
    ++dashes;
    for (const GlyphRun& run : test::all_of<GlyphRun>(last)) {
      if (run.color != theme.torque || run.glyphs.empty()) continue;
      ++numbers;
      const bool is_beside = dash.b.x < run.origin.x || dash.a.x > run.origin.x + run.glyphs.back().x;
      EXPECT_TRUE(is_beside || dash.a.y < run.origin.y || dash.a.y > run.origin.y + 0.7 * run.size) << dash.a.y << " through letters on " << run.origin.y;
    }
  }
  EXPECT_GT(dashes, 0);
  EXPECT_GT(numbers, 0);
}

// Where a real foot would tip the picture says that this one is held, and nowhere else.
TEST_F(FallingHuman, IsSaidToBeHeldWhereARealFootWouldTip) {
  EXPECT_THAT(test::words_of(film(&simulation_).frame(run_.size() - 1)), HasSubstr("holds the foot: a real one would tip"));
  EXPECT_THAT(test::words_of(film(&simulation_).frame(0)), Not(HasSubstr("a real one")));
}

// The mark of the centre of mass lies over the arcs of torques, which the last pose has about it; the page names the mark where the ground presses.
TEST_F(FallingHuman, HasItsCentreOfMassOverArcsAndNamesWhereTheGroundPresses) {
  const Film film = this->film(&simulation_);
  const Theme& theme = theme_named("light");
  const Picture frame = film.frame(run_.size() - 1);
  std::optional<std::size_t> arcs, center;
  for (std::size_t i = 0; i < frame.items.size(); ++i) {
    const auto* head = std::get_if<Polygon>(&frame.items[i].shape);
    if (head && head->paint.fill == theme.torque) arcs = i;
    const auto* rim = std::get_if<Ellipse>(&frame.items[i].shape);
    if (rim && rim->paint.stroke == theme.ink && std::abs(norm(rim->u) - film.panel(0).look().marks * size::kCenterOfMass / 2) < 1e-9) center = i;
  }
  ASSERT_TRUE(arcs && center);
  EXPECT_GT(*center, *arcs);
  EXPECT_THAT(test::words_of(film.static_layer()), HasSubstr("ground reaction 200 Ncentre of pressure"));
}

// Words have the size of a torque whose arc is cut a while before it is, so that no number is there for one frame; it is that of the
// peak, and does not run.
TEST_F(FallingHuman, NumbersOfTorquesComeBeforeTheirArcsAreCut) {
  const Film film = this->film(&simulation_);
  const std::string sign = "3=\u2212";
  const auto size_at = [&](int k) {
    const std::string words = test::words_of(film.frame(k));
    const std::size_t at = words.find(sign);
    return at == std::string::npos ? NAN : std::stod(words.substr(at + sign.size()));
  };
  EXPECT_TRUE(std::isnan(size_at(0))) << "negative control";
  int first = 0;
  while (first < run_.size() && std::isnan(size_at(first))) ++first;
  ASSERT_LT(first, run_.size());
  double largest = 0;
  const std::vector<double> tau = torques_along(simulation_, run_);
  for (int k = 0; k < run_.size(); ++k) largest = std::max(largest, std::abs(tau[std::size_t(3 * k + 2)]));
  for (int k = first; k < run_.size(); ++k) EXPECT_NEAR(size_at(k), largest, 0.5) << k;  // two digits
  // Of arcs the widest is 300 of 240 degrees for the 95th percentile, which at the end is passed by far.
  EXPECT_LT(std::abs(tau[std::size_t(3 * first + 2)]), 0.5 * largest);
}

// At the end the note has the name of the height, which its line has until then.
TEST_F(FallingHuman, NamesTheHeightOnce) {
  const Film film = this->film(&simulation_);
  for (int k = 0; k < run_.size(); ++k) {
    const std::string words = test::words_of(film.frame(k)), name = "hip where the knee was";
    int count = 0;
    for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at + 1)) ++count;
    EXPECT_LE(count, 1) << k;
    if (k + 1 == run_.size()) {
      EXPECT_EQ(count, 1);
    }
  }
}

TEST_F(FallingHuman, TheGroundPushesFromBelowWhereThePressureIsMarked) {
  scene_.draw = {"chain"};
  scene_.layout = PageLayout::scene;
  const Film film = this->film(&simulation_);
  const Color force = theme_named("light").constraint;
  std::optional<Point> mark;
  const Picture frame = film.frame(60);
  for (const Ellipse& disc : test::all_of<Ellipse>(frame))
    if (disc.paint.stroke == force) mark = disc.center;
  ASSERT_TRUE(mark);
  double highest = -HUGE_VAL, lowest = HUGE_VAL;
  Picture in_scene = frame;  // the arrow of its scale is below it
  std::erase_if(in_scene.items, [](const Item& item) { return item.clip < 0; });
  for (const Polygon& part : test::all_of<Polygon>(in_scene))
    for (int i = 0; part.paint.fill == force && i < part.count; ++i) highest = std::max(highest, part.corners[std::size_t(i)].y);
  for (const Capsule& part : test::all_of<Capsule>(in_scene))
    if (part.paint.fill == force) lowest = std::min({lowest, part.a.y, part.b.y});
  EXPECT_NEAR(highest, mark->y, 0.002) << "the head ends there";
  EXPECT_LT(lowest, mark->y - 0.08) << "the shaft comes from below: a weight is 0.09 H";
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

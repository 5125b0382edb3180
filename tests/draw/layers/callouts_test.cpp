// What films say by themselves beside what it concerns, and the words that go with it.
#include "draw/layers/callouts.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kLinesUp = 0.39275;  // s: when the linkage first lies on one line

int times_in(const std::string& words, const std::string& part) {
  int count = 0;
  for (std::size_t at = words.find(part); at != std::string::npos; at = words.find(part, at + 1)) ++count;
  return count;
}

class FourBarOnALine : public ::testing::Test {
 protected:
  FourBarOnALine() : scene(read_scene("assets/scenes/four_bar_singular.yaml")) {
    scene.layout = PageLayout::scene;
    scene.plot.clear();
    for (int k = 0; k < 100; ++k) times.push_back(k / 60.0);
  }

  Film film() {
    simulation.emplace(prepare(scene, false));
    run = simulate(*simulation, times);
    PanelRun panel{scene, simulation->chain, run, &*simulation};
    panel.change_points = {kLinesUp};
    return {scene, {panel}, times, fonts};
  }

  // Where lines from words end in a dot.
  static std::vector<Point> dots(const Picture& picture) {
    std::vector<Point> found;
    for (const Ellipse& one : test::all_of<Ellipse>(picture))
      if (std::abs(norm(one.u) - 0.0055) < 1e-9) found.push_back(one.center);
    return found;
  }

  Scene scene;
  std::optional<Simulation> simulation;
  std::vector<double> times;
  Trajectory run;
  Fonts fonts;
};

TEST_F(FourBarOnALine, SaysAtTheTieThatRankIsLostForASecondOfTheFilm) {
  const Film film = this->film();
  int seen = 0;
  for (int k = 0; k < 100; ++k) {
    const bool stands = times[std::size_t(k)] >= kLinesUp - kBeforeCallout && times[std::size_t(k)] <= kLinesUp + kAfterCallout;
    const bool is_noted = times[std::size_t(k)] >= kLinesUp;
    const Picture frame = film.frame(k);
    const std::vector<Point> ends = dots(frame);
    ASSERT_LE(ends.size(), stands ? 1u : 0u) << k;  // there may be no room while links pass
    EXPECT_EQ(times_in(test::words_of(frame), kRankLost), int(ends.size()) + is_noted) << k;
    // The pin on the ground is 1 m from the base; oracle: models/four_bar_parallel.urdf.
    for (const Point& end : ends) {
      EXPECT_LT(norm(end - film.camera().project({1, 0, 0})), 1e-6) << k;
    }
    seen += int(ends.size());
  }
  EXPECT_GE(seen, 15) << "a quarter of a second";
}

TEST_F(FourBarOnALine, EventsStandAtTheOneJointThatTheyReadWhereTheyHaveANameAndAPlace) {
  scene.events = {{"q1 < 50deg", EventKind::mark, "lower", Crossing::either, {}},
                  {"t > 0.2", EventKind::mark, "later", Crossing::either, {}},
                  {"q1 < 40deg", EventKind::mark, "", Crossing::either, {}},
                  {"q1 + q2 < 30deg", EventKind::mark, "of two joints", Crossing::either, {}}};
  const Film film = this->film();
  ASSERT_GT(run.events.size(), 2);
  int k = 0;
  while (times[std::size_t(k)] < run.events.t[0]) ++k;
  const std::vector<Point> ends = dots(film.frame(k));
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_LT(norm(ends[0] - film.camera().project({0, 0, 0})), 1e-12);
  for (k = 0; k < 100; ++k)
    for (const char* name : {"later", "of two joints", "40deg"}) EXPECT_LE(times_in(test::words_of(film.frame(k)), name), 1) << name << k;
}

TEST_F(FourBarOnALine, WhatAnnotateIsAboutIsSaidOnce) {
  scene.events = {{"q1 < 50deg", EventKind::mark, "lower", Crossing::either, {}}};
  AnnotationEntry own;
  own.event = "lower";
  own.text = "now";
  own.spot = {0.5, 0.3};
  own.hold = 0;
  const auto most = [this] {
    const Film film = this->film();
    int count = 0;
    for (int k = 0; k < 100; ++k) count = std::max(count, times_in(test::words_of(film.frame(k)), "lower"));
    return count;
  };
  EXPECT_EQ(most(), 2) << "negative control: there and in the note";
  scene.annotate = {own};
  EXPECT_EQ(most(), 1);
}

// A run that a limit ended says so in its note and at the joint.
TEST(StopAtLimit, IsSaidWhereItHappens) {
  Scene scene;
  scene.duration = 1;
  const Chain chain = test::model("rr");
  std::vector<double> times;
  for (int k = 0; k <= 30; ++k) times.push_back(k / 60.0);
  Trajectory run = test::run_at(times, test::swing);
  run.end_time = times.back();
  const auto words = [&] {
    const Film film(scene, {{scene, chain, run}}, run.t, fonts());
    return std::pair(film.panel(0).note(30), test::words_of(film.frame(30)));
  };
  EXPECT_EQ(words().first, "") << "negative control";
  run.status = RunStatus::stopped;
  run.limits = {{"joint2", "position", times.back(), 1, 1}};
  EXPECT_EQ(words().first, "t = 0.50 s: limit of joint2 reached");
  EXPECT_EQ(times_in(words().second, "limit of joint2 reached"), 2);
  run.limits[0].quantity = "velocity";
  EXPECT_THAT(words().first, HasSubstr("velocity limit of joint2 reached"));
  run.ending_event = 0;
  EXPECT_THAT(words().second, Not(HasSubstr("limit")));
}

// Negative control: of a run that is accurate to the end nothing is said.
TEST(Callouts, SayAtTheEndEffectorUntilWhenARunIsAccurate) {
  Scene scene = read_scene("assets/scenes/rr_free.yaml", {"layout=scene", "draw=[chain]"});
  const Simulation simulation = prepare(scene, false);
  std::vector<double> times;
  for (int k = 0; k < 120; ++k) times.push_back(k / 60.0);
  const Trajectory run = simulate(simulation, times);
  const Fonts fonts;
  for (const double until : {1.0, 2.0}) {
    PanelRun panel{scene, simulation.chain, run, &simulation};
    panel.accurate_until = until;
    const Film film(scene, {panel}, times, fonts);
    int said = 0;
    for (int k = 0; k < 120; ++k) {
      const bool stands = times[std::size_t(k)] >= until - kBeforeCallout - 1e-9 && times[std::size_t(k)] <= until + kAfterCallout + 1e-9;
      const int here = times_in(test::words_of(film.frame(k)), "accurate until here");
      EXPECT_LE(here, stands) << k;
      said += here;
    }
    EXPECT_EQ(said > 15, until < 2) << "a quarter of a second";
  }
}

}  // namespace
}  // namespace chainreel

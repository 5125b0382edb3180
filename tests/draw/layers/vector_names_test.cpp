// Names of torques, of what ties exert and of axes, over films: where no link passes, about where they act, off what is new of a trail.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "draw/film/film.hpp"
#include "draw/page/word_plan.hpp"
#include "draw/shapes.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

constexpr double kNamesRate = 60;

struct NamedFilm {
  NamedFilm(const std::string& name, int frames, const std::vector<std::string>& overrides = {})
      : scene(read_scene("assets/scenes/" + name + ".yaml", overrides)), simulation(prepare(scene, false)) {
    if (scene.chooses_method()) {
      simulation.method = &find_method("rk4");
      simulation.step = 0.001;
    }
    for (int k = 0; k < frames; ++k) times.push_back(k / kNamesRate);
    run = simulate(simulation, times);
    film = std::make_unique<Film>(scene, std::vector<PanelRun>{{scene, simulation.chain, run, &simulation}}, times, fonts);
  }
  Scene scene;
  Simulation simulation;
  std::vector<double> times;
  Trajectory run;
  Fonts fonts;
  std::unique_ptr<Film> film;
};

// Of the first word of each frame: how often it begins to go, and at how many frames it is not there.
struct Going {
  int goes = 0, away = 0;
};
Going going_of(const Film& film) {
  Going found;
  for (int k = 1; k < film.frame_count(); ++k) {
    const auto before = film.words(0, k - 1), now = film.words(0, k);
    if (before.empty() || now.empty()) continue;
    found.goes += before.front().opacity == 1 && now.front().opacity < 1;
    found.away += !(now.front().opacity > 0);
  }
  return found;
}

// The crank of slider_crank turns once in 0.84 s.
TEST(VectorNames, OfATorqueAtTheGroundStandOutsideOfTheCircleOfItsLink) {
  const Going beside = going_of(*NamedFilm("slider_crank", 240).film);
  EXPECT_LE(beside.goes, 1) << "from where the crank was at rest";
  EXPECT_EQ(beside.away, 0);
  // Negative control: on a page whose circle is too large for a name outside of it.
  const Going large = going_of(*NamedFilm("slider_crank", 240, {"camera.fit=[-0.45, -0.45, 0.45, 0.45]"}).film);
  EXPECT_GT(large.goes + large.away, 5);
}

TEST(VectorNames, OfTiesStandAboutWhereTheyAct) {
  const NamedFilm pen("pen", 120);
  // The last one is the tie's, whose anchor is where it acts.
  const Film& film = *pen.film;
  for (int k = 0; k < film.frame_count(); ++k) {
    const auto words = film.words(0, k);
    ASSERT_EQ(words.size(), 3u);
    EXPECT_TRUE(std::ranges::any_of(words, [&](const StandingWord& word) {
      const auto arrows = test::all_of<Polygon>(film.frame(k), [&](const Polygon& head) { return head.paint.fill == light_theme().constraint; });
      return word.anchor && !arrows.empty() && norm(*word.anchor - test::middle_of(test::box_of(arrows.front()))) > 0.1 &&
             norm(nearest_in(word.box, *word.anchor) - *word.anchor) < 0.08;
    })) << k;
  }
}

// How many words of a film lie on what is new of its trail, `later` frames behind them.
int words_on_trail(const Film& film, int later) {
  int found = 0;
  for (int k = 0; k + later < film.frame_count(); ++k) {
    Picture seen;
    for (const Trail& trail : test::all_of<Trail>(film.frame(k + later), [](const Trail& one) { return one.points.size() > 2 && one.points.front().alpha < one.points.back().alpha; }))
      seen.add(trail, -1);
    const auto newest = obstacles_of(seen);
    for (const StandingWord& word : film.words(0, k)) found += word.opacity > 0 && lies_on(word.box, newest);
  }
  return found;
}

TEST(VectorNames, KeepOffWhatIsNewOfATrail) {
  const NamedFilm swings("rr_ellipse", 300);
  const int now = words_on_trail(*swings.film, 0);
  EXPECT_LT(now, 55) << "of some four hundred";
  EXPECT_GT(words_on_trail(*swings.film, 20), 2 * now) << "negative control: of what comes they know nothing";
}

}  // namespace
}  // namespace chainreel

// Names of torques and of what ties exert, over films: where no link passes, and about where they act.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "draw/film/film.hpp"
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

}  // namespace
}  // namespace chainreel

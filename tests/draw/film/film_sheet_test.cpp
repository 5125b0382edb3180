// What stands around a film's scenes, and the room that it leaves them.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

// A film with a plot below its scene, and where its time stands.
struct WithPlotBelow {
  explicit WithPlotBelow(const std::vector<std::string>& overrides, double last_picture = 10) {
    std::vector<std::string> all{"layout=scene-below", "plot=[energy]", "duration=10", "method=rk4", "step=1ms"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    Scene scene = read_scene("assets/scenes/rr_free.yaml", all);
    const Simulation simulation = prepare(scene, false);
    const std::vector<double> times{0, last_picture}, whole{0, 5, 10};
    Trajectory run = simulate(simulation, times);
    run.between = std::make_shared<Trajectory>(simulate(simulation, whole));
    const Fonts fonts;
    const Film film(scene, {{scene, simulation.chain, run, &simulation}}, times, fonts);
    height = film.scene_area().height();
    double time = NAN, em = 1;
    for (const GlyphRun& words : test::all_of<GlyphRun>(film.static_layer()))
      if (words.text.starts_with("10") && words.text.ends_with("s")) last_number = words.origin;
    for (const GlyphRun& words : test::all_of<GlyphRun>(film.frame(1)))
      if (words.text.starts_with("t")) time = words.origin.y, em = words.size;
    rows_below = (last_number.y - time) / em;
  }

  double rows_below = 0;  // the plot's numbers, ems
  double height = 0;      // of the scene, H
  Point last_number{NAN, NAN};
};

TEST(FilmSheet, PutsTheTimeBesideTheNumbersOfAPlotWhereARowWouldBeForItAlone) {
  const WithPlotBelow alone({"draw=[time, chain]"});
  EXPECT_NEAR(alone.rows_below, 0, 0.05) << "on their base line";
  const WithPlotBelow with_legend({"draw=[time, chain, com, legend]"});
  EXPECT_GT(with_legend.rows_below, 1);
  EXPECT_LT(with_legend.height, alone.height);
}

// It may take eight hundredths of the frame's width, no more: what stands beside curves of short names is wider.
TEST(FilmSheet, KeepsARowForTheTimeWhereThePlotWouldBeNarrow) {
  EXPECT_GT(WithPlotBelow({"draw=[time, chain]", "plot=[q]", "text_scale=1.2"}).rows_below, 1);
}

// "t = 10.00 s" is wider than "t = 5.00 s", for which the plot is narrower.
TEST(FilmSheet, OfAPictureOfAnEarlierInstantIsThatOfTheFilm) {
  const std::vector<std::string> words{"draw=[time, chain]"};
  ASSERT_LT(WithPlotBelow(words).last_number.x, WithPlotBelow({"draw=[chain]"}).last_number.x);
  EXPECT_EQ(WithPlotBelow(words, 5).last_number.x, WithPlotBelow(words).last_number.x);
}

}  // namespace
}  // namespace chainreel

// What stands around a film's scenes, and the room that it leaves them.

#include <gtest/gtest.h>

#include <cmath>

#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

// A film with a plot below its scene, and where its time stands.
struct WithPlotBelow {
  explicit WithPlotBelow(const std::vector<std::string>& overrides) {
    std::vector<std::string> all{"layout=scene-below", "plot=[q]", "duration=0.5", "method=rk4", "step=1ms"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    Scene scene = read_scene("assets/scenes/rr_free.yaml", all);
    const Simulation simulation = prepare(scene, false);
    const std::vector<double> times{0, 0.25, 0.5};
    const Trajectory run = simulate(simulation, times);
    const Fonts fonts;
    const Film film(scene, {{scene, simulation.chain, run, &simulation}}, times, fonts);
    height = film.scene_area().height();
    double numbers = NAN, time = NAN, em = 1;
    for (const GlyphRun& words : test::all_of<GlyphRun>(film.static_layer()))
      if (words.text.starts_with("0.5") && words.text.ends_with("s")) numbers = words.origin.y;
    for (const GlyphRun& words : test::all_of<GlyphRun>(film.frame(1)))
      if (words.text.starts_with("t")) time = words.origin.y, em = words.size;
    rows_below = (numbers - time) / em;
  }

  double rows_below = 0;  // the plot's numbers, ems
  double height = 0;      // of the scene, H
};

TEST(FilmSheet, PutsTheTimeBesideTheNumbersOfAPlotWhereARowWouldBeForItAlone) {
  const WithPlotBelow alone({"draw=[time, chain]"});
  EXPECT_NEAR(alone.rows_below, 0, 0.05) << "on their base line";
  const WithPlotBelow with_legend({"draw=[time, chain, com, legend]"});
  EXPECT_GT(with_legend.rows_below, 1);
  EXPECT_LT(with_legend.height, alone.height);
}

// It may take six hundredths of the frame's width, no more.
TEST(FilmSheet, KeepsARowForTheTimeWhereThePlotIsNarrow) {
  EXPECT_GT(WithPlotBelow({"draw=[time, chain]", "video.width=720", "video.height=720", "text_scale=1.6"}).rows_below, 1);
}

}  // namespace
}  // namespace chainreel

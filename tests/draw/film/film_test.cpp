#include <algorithm>

#include "draw/film/film.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/robot/joints.hpp"
#include "draw/shapes.hpp"
#include "sim/instant.hpp"

namespace chainreel {
namespace {

Scene scene_of(const std::string& title, std::vector<std::string> more_layers = {}) {
  Scene scene;
  scene.title = title;
  scene.file = "scenes/test.yaml";
  scene.draw.insert(scene.draw.end(), more_layers.begin(), more_layers.end());
  return scene;
}

// The end effector's disc: ink, no outline, the theme's size.
std::vector<Ellipse> grippers(const Picture& picture) {
  return test::all_of<Ellipse>(picture, [](const Ellipse& e) {
    return e.paint.fill == light_theme().ink && std::abs(test::length(e.u) - size::kEndEffector / 2) < 1e-12;
  });
}

Point closed_form_tip(const Film& film, double t) {
  const auto q = test::swing(t);
  return film.camera().project(
      {std::cos(q[0]) + std::cos(q[0] + q[1]), std::sin(q[0]) + std::sin(q[0] + q[1]), 0});
}

class RrFilm : public ::testing::Test {
 protected:
  Chain chain = test::model("rr");
  Trajectory run = test::run_of(test::swing, 300);
  Scene scene = scene_of("RR swings");
};

TEST_F(RrFilm, ShowsTheGripperWhereTheClosedFormSays) {
  const Film film(scene, chain, run, run.size(), fonts());
  for (const int k : {0, 17, 150, 299}) {
    const auto discs = grippers(film.frame(k));
    ASSERT_EQ(discs.size(), 1u);
    EXPECT_LT(test::distance(discs[0].center, closed_form_tip(film, k / 60.0)), 1e-12);
  }
  // Negative control: a frame later it is elsewhere.
  EXPECT_GT(test::distance(grippers(film.frame(17))[0].center, closed_form_tip(film, 18 / 60.0)), 1e-3);
}

TEST_F(RrFilm, DrawsTheGripperAboveAllThatIsInTheScene) {
  scene.draw.push_back("ellipse");
  const Film film(scene, chain, run, run.size(), fonts());
  const Picture picture = film.frame(40);
  std::size_t gripper = 0;
  for (std::size_t i = 0; i < picture.items.size(); ++i) {
    if (const auto* e = std::get_if<Ellipse>(&picture.items[i].shape)) {
      if (e->paint.fill == light_theme().ink && e->u.x > 0.9 * size::kEndEffector / 2) gripper = i;
    }
  }
  for (std::size_t i = gripper + 1; i < picture.items.size(); ++i) {
    EXPECT_TRUE(std::holds_alternative<GlyphRun>(picture.items[i].shape));
    EXPECT_EQ(picture.items[i].clip, -1);  // the running time, outside the scene
  }
}

TEST_F(RrFilm, HasOneCameraThatHoldsAllFramesTightly) {
  const Film film(scene, chain, run, run.size(), fonts());
  const Rect& area = film.scene_area();
  Rect seen{1e9, 1e9, -1e9, -1e9};
  const auto see = [&](Point p, double r) {
    EXPECT_TRUE(test::is_inside(area, p, -r));
    seen = {std::min(seen.x0, p.x - r), std::min(seen.y0, p.y - r), std::max(seen.x1, p.x + r),
            std::max(seen.y1, p.y + r)};
  };
  const auto see_all = [&](const Picture& picture) {
    for (const Item& item : picture.items) {
      if (item.clip < 0) continue;
      if (const auto* c = std::get_if<Capsule>(&item.shape)) {
        see(c->a, c->radius + c->paint.stroke_width / 2);
        see(c->b, c->radius + c->paint.stroke_width / 2);
      }
      if (const auto* e = std::get_if<Ellipse>(&item.shape)) see(e->center, test::length(e->u));
    }
  };
  see_all(film.static_layer());
  for (int k = 0; k < run.size(); ++k) see_all(film.frame(k));
  // Tight: what is seen fills the area but for the margin on both sides. What may be missing is the room kept
  // for outlines and joints of full size: a hundredth.
  const double filled = std::max(seen.width() / area.width(), seen.height() / area.height());
  EXPECT_GT(filled * (1 + 2 * size::kFitMargin), 0.99);
  EXPECT_LE(filled * (1 + 2 * size::kFitMargin), 1 + 1e-12);
}

// It has no bound near singular poses.
TEST_F(RrFilm, LetsTheEllipseTakeLittleOfTheScale) {
  const double scale = Film(scene, chain, run, run.size(), fonts()).camera().scale;
  scene.draw.push_back("ellipse");  // its bar stands in the footer, which is there for the time anyway
  const double with = Film(scene, chain, run, run.size(), fonts()).camera().scale;
  EXPECT_LE(with, scale);
  EXPECT_GE(with, (1 - 1e-12) * kKeptForWishes * scale);
}

TEST_F(RrFilm, StaticLayerHoldsWhatNoFrameChanges) {
  const Film film(scene, chain, run, run.size(), fonts());
  const std::string words = test::words_of(film.static_layer());
  EXPECT_THAT(words, testing::HasSubstr("RR swings"));
  EXPECT_EQ(test::words_of(film.frame(60)), "t = 1.00 s");
  EXPECT_FALSE(film.static_layer().items.empty());
  EXPECT_EQ(film.static_layer().aspect, film.frame(0).aspect);
  // The ground is in the static layer alone.
  const auto is_base = [](const Capsule& c) { return c.paint.fill == light_theme().base; };
  EXPECT_GT(test::all_of<Capsule>(film.static_layer(), is_base).size(), 5u);
  EXPECT_TRUE(test::all_of<Capsule>(film.frame(100), is_base).empty());
}

TEST_F(RrFilm, DrawsOnlyTheLayersThatTheSceneNames) {
  scene.draw = {"chain"};
  const Film chain_only(scene, chain, run, run.size(), fonts());
  EXPECT_EQ(test::words_of(chain_only.static_layer()) + test::words_of(chain_only.frame(90)), "");
  EXPECT_TRUE(test::all_of<Trail>(chain_only.frame(90)).empty());
  scene.draw = {"trail"};
  const Film trail_only(scene, chain, run, run.size(), fonts());
  EXPECT_TRUE(trail_only.static_layer().items.empty());
  EXPECT_EQ(test::all_of<Trail>(trail_only.frame(90)).size(), 1u);
  EXPECT_TRUE(test::all_of<Capsule>(trail_only.frame(90)).empty());
}

TEST_F(RrFilm, TrailOfAFrameIsItsLastSecond) {
  const Film film(scene, chain, run, run.size(), fonts());
  const auto points = test::all_of<Trail>(film.frame(200)).at(0).points;
  // At frames the trail has the closed form's places; its ends are frames here.
  EXPECT_LT(test::distance(points.front().p, closed_form_tip(film, 140 / 60.0)), 1e-9);
  EXPECT_LT(test::distance(points.back().p, closed_form_tip(film, 200 / 60.0)), 1e-9);
}

TEST_F(RrFilm, DrawsTheTrailAboveCarriedRailsAndBelowSliders) {
  const Chain pp = test::model("pp");
  const Trajectory slide = test::run_of([](double t) { return std::vector<double>{t, std::sin(t)}; }, 120);
  const Film film(scene, pp, slide, slide.size(), fonts());
  std::vector<char> order;
  const Picture picture = film.frame(100);
  for (const Item& item : picture.items) {
    if (std::holds_alternative<Trail>(item.shape)) order.push_back('t');
    if (const auto* p = std::get_if<Polygon>(&item.shape))
      order.push_back(p->paint.stroke_width > 0 ? 'b' : 'r');
  }
  EXPECT_EQ(order, (std::vector<char>{'b', 'r', 't', 'b'}));  // carriage, its rail, trail, slider
}

// On the one rail that the end effector goes along a trail would be taken for a rod.
TEST_F(RrFilm, HasNoTrailAlongTheOnlyRailThatMoves) {
  const Chain pp = test::model("pp");
  const auto trails = [&](const Trajectory& slide) { return test::all_of<Trail>(Film(scene, pp, slide, slide.size(), fonts()).frame(100)).size(); };
  const Trajectory one = test::run_of([](double t) { return std::vector<double>{0.3, std::sin(t)}; }, 120);
  EXPECT_EQ(trails(one), 0u);
  EXPECT_EQ(trails(test::run_of([](double t) { return std::vector<double>{0.3 * t, std::sin(t)}; }, 120)), 1u);
  scene.draw = {"trail"};
  EXPECT_EQ(trails(one), 1u) << "no rail is drawn";
}

TEST_F(RrFilm, NamesItsEllipseAndItsScale) {
  scene.draw.insert(scene.draw.end(), {"ellipse", "legend"});
  const Film film(scene, chain, run, run.size(), fonts());
  const std::string words = test::words_of(film.static_layer());
  EXPECT_THAT(words, testing::HasSubstr("effective mass ellipse"));
  EXPECT_THAT(words, testing::HasSubstr(" kg"));
  // One scale for the whole clip: Lambda of RR depends on q2 alone, so equal q2 give equal ellipses.
  const auto ellipse_at = [&](int k) {
    return test::all_of<Ellipse>(film.frame(k),
                                 [](const Ellipse& e) { return e.paint.stroke == light_theme().ellipse && !e.fade.any(); });
  };
  int compared = 0;
  for (int k = 0; k < 100; ++k) {
    for (const Ellipse& e : ellipse_at(k)) {
      const double c = std::cos(test::swing(k / 60.0)[1]);
      // det Lambda = det M / det J^2 = 1 / (1 - c^2) * ... : M = [[3 + 2c, 1 + c], [1 + c, 1]], det = 2 - c^2
      // - ...
      const double det_M = (3 + 2 * c) - (1 + c) * (1 + c), det_J2 = 1 - c * c;
      const double per_kg = test::per_unit_of_bar(film.static_layer());
      EXPECT_NEAR(test::length(e.u) * test::length(e.v) / (per_kg * per_kg), det_M / det_J2,
                  1e-9 * det_M / det_J2);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

// Bars between two ticks, with the words to their right.
struct ScaleBar {
  double length = 0;  // H
  double value = 0;   // of the unit that is asked for
};
ScaleBar scale_bar(const Picture& page, Color color, const std::string& unit) {
  ScaleBar bar;
  for (const Capsule& c : test::all_of<Capsule>(page, [&](const Capsule& one) {
         return one.paint.fill == color && one.a.y == one.b.y && one.radius == size::kScaleBar / 2;
       }))
    bar.length = std::max(bar.length, c.b.x - c.a.x);
  for (const GlyphRun& run : test::all_of<GlyphRun>(page))
    if (run.text.ends_with(" " + unit)) bar.value = std::stod(run.text);
  return bar;
}

TEST_F(RrFilm, HasBarsAsLongAsTheirWordsSay) {
  scene.draw.insert(scene.draw.end(), {"ellipse", "scale_bar"});
  const Film film(scene, chain, run, run.size(), fonts());
  const ScaleBar metres = scale_bar(film.static_layer(), light_theme().ink, "m");
  EXPECT_GT(metres.value, 0);
  EXPECT_NEAR(metres.length, metres.value * film.camera().scale, 1e-12);
  EXPECT_LE(metres.length, 0.25 * film.scene_area(0).width());
  EXPECT_GT(metres.length, 0.09 * film.scene_area(0).width()) << "the next of 1, 2, 5 would be beyond a quarter";
  const ScaleBar masses = scale_bar(film.static_layer(), light_theme().ellipse, "kg");
  EXPECT_GT(masses.value, 0);
  EXPECT_LE(masses.length, kLongestBar);
  EXPECT_GT(masses.length, 0.3 * kLongestBar) << "the next of 1, 2, 5 would be longer than that";
  // The ellipses are drawn by it: their bounded axes are the mass that the pose says.
  Workspace ws(chain);
  const EffectiveMass mass = TipMass(chain).at(ws, run.q_at(100));
  const auto ellipses = test::all_of<Ellipse>(film.frame(100), [](const Ellipse& e) { return e.paint.stroke == light_theme().ellipse; });
  ASSERT_FALSE(ellipses.empty());
  EXPECT_NEAR(test::length(ellipses[0].v), *mass_axes(mass).back().mass * masses.length / masses.value, 1e-9);
}

TEST_F(RrFilm, IsNotSpoiltByTheWildEndOfADivergedRun) {
  const double scale = Film(scene, chain, run, run.size(), fonts()).camera().scale;
  const Chain pp = test::model("pp");
  Trajectory wild = test::run_of([](double t) { return std::vector<double>{t, 0.5 * t}; }, 60);
  const double calm_scale = Film(scene, pp, wild, wild.size(), fonts()).camera().scale;
  for (const double q : {1e12, 1e200, std::nan("")}) {
    wild.t.push_back(wild.t.back() + 1 / 60.0);
    wild.q.insert(wild.q.end(), {q, -q});
    wild.qd.insert(wild.qd.end(), {q, q});
  }
  wild.status = RunStatus::diverged;
  const Film film(scene, pp, wild, wild.size(), fonts());
  EXPECT_EQ(film.camera().scale, calm_scale);
  for (const int k : {59, 60, 61, 62}) EXPECT_TRUE(test::all_finite(film.frame(k)));
  EXPECT_GT(scale, 0);
  // Negative control: the same numbers in a run that finished are part of the film.
  wild.status = RunStatus::finished;
  wild.q[120] = 1e3;
  wild.q[121] = 0;
  wild.q.resize(122);
  wild.qd.resize(122);
  wild.t.resize(61);
  EXPECT_LT(Film(scene, pp, wild, wild.size(), fonts()).camera().scale, 0.01 * calm_scale);
}

TEST_F(RrFilm, StandsStillBehindItsLastSample) {
  const Film film(scene, chain, run, 10000, fonts());
  EXPECT_EQ(grippers(film.frame(9999)).at(0).center.x, grippers(film.frame(299)).at(0).center.x);
  EXPECT_EQ(test::words_of(film.frame(9999)), time_text(299 / 60.0));
}

TEST_F(RrFilm, NeedsAFrame) {
  EXPECT_THROW(Film(scene, chain, run, 0, fonts()), Error);
}

TEST_F(RrFilm, TellsWhichSceneHasATitleThatDoesNotFit) {
  scene.title = std::string(150, 'm');
  try {
    const Film film(scene, chain, run, run.size(), fonts());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("scenes/test.yaml: the title"));
  }
}

TEST_F(RrFilm, GrowsItsLettersWithTextScale) {
  const Film small(scene, chain, run, run.size(), fonts());
  scene.text_scale = 1.5;
  const Film large(scene, chain, run, run.size(), fonts());
  const auto size_of = [](const Film& film) { return test::all_of<GlyphRun>(film.frame(0)).at(0).size; };
  EXPECT_NEAR(size_of(large), 1.5 * size_of(small), 1e-12);
  EXPECT_LT(large.scene_area().height(), small.scene_area().height());
}

}  // namespace
}  // namespace chainreel

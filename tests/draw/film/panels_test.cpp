// Films of several panels: one camera and one scale, words above and below, and runs that leave the picture.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<double> sliding(double t) {
  return {0, std::cos(3 * t)};
}
// Grows by e each third of a second.
std::vector<double> growing(double t) {
  return {0, std::exp(3 * t) * std::cos(9 * t)};
}

class PanelFilm : public ::testing::Test {
 protected:
  PanelFilm() {
    page.title = "Whole";
    page.file = "scenes/test.yaml";
    page.layout = PageLayout::compare;
  }

  // A run of PP with its panel's title; a wild one diverges at its last sample.
  void add(const std::string& title, const std::function<std::vector<double>(double)>& q, bool wild = false,
           int frames = kFrames) {
    scenes.push_back(std::make_unique<Scene>(page));
    scenes.back()->title = title;
    runs.push_back(std::make_unique<Trajectory>(test::run_of(q, frames)));
    if (wild) runs.back()->status = RunStatus::diverged;
    if (scenes.size() > 2) page.layout = PageLayout::grid;
  }

  Film film() const {
    std::vector<PanelRun> panels;
    for (std::size_t i = 0; i < runs.size(); ++i) panels.push_back({*scenes[i], chain, *runs[i]});
    std::vector<double> times;
    for (int k = 0; k < kFrames; ++k) times.push_back(frame_time(k, {}));
    return Film(page, panels, times, fonts());
  }

  static std::vector<Ellipse> grippers(const Picture& picture) {
    return test::all_of<Ellipse>(picture, [](const Ellipse& e) {
      return e.paint.fill == light_theme().ink && e.paint.stroke_width == 0 &&
             test::length(e.u) < 0.6 * size::kEndEffector;
    });
  }

  static constexpr int kFrames = 120;
  Chain chain = test::model("pp");
  Scene page;
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<std::unique_ptr<Trajectory>> runs;
};

TEST_F(PanelFilm, ShowsEveryRunAtTheSameScaleInPanelsOfTheSameSize) {
  add("left", sliding);
  add("right", [](double t) { return std::vector<double>{0.5 * t, 0.2}; });
  const Film both = film();
  const Rect &a = both.scene_area(0), &b = both.scene_area(1);
  EXPECT_NEAR(a.width(), b.width(), 1e-12);
  EXPECT_EQ(a.y0, b.y0);
  EXPECT_EQ(a.y1, b.y1);
  EXPECT_NEAR(b.x0 - a.x1, size::kGutter, 1e-12);
  EXPECT_EQ(both.camera(0).scale, both.camera(1).scale);
  // The same place of the world lies at the same place of each panel.
  const Eigen::Vector3d place(0.3, 0.4, 0);
  const Point in_a = both.camera(0).project(place) - Point{a.x0, a.y0};
  const Point in_b = both.camera(1).project(place) - Point{b.x0, b.y0};
  EXPECT_LT(test::distance(in_a, in_b), 1e-12);
}

// What stands still since its run went wrong is paler than what moves, from that frame on and in its own panel alone.
TEST_F(PanelFilm, VeilsAPanelWhoseRunCameToABadEnd) {
  add("calm", sliding);
  add("wild", growing, true);
  const Film both = film();
  const auto veils = [&](int k) {
    std::vector<int> clips;
    for (const Item& item : both.frame(k).items)
      if (const auto* p = std::get_if<Polygon>(&item.shape);
          p && p->count == 4 && p->paint.fill.a > 0.3 && p->paint.fill == light_theme().background.faded(p->paint.fill.a))
        clips.push_back(item.clip);
    return clips;
  };
  EXPECT_TRUE(veils(0).empty());
  EXPECT_EQ(veils(kFrames - 1), std::vector<int>{1});
}

// Whoever wrote a title is told that it does not fit; one that was made up is cut in its middle, so that panels stay apart.
TEST_F(PanelFilm, AbbreviatesTitlesThatWereMadeUp) {
  const std::string end = " and a long way to what differs at its end, which nobody could have in a panel as narrow as this one is: k = ";
  add("torque" + end + "10", sliding);
  add("torque" + end + "60", sliding);
  const std::string words = test::words_of(film().static_layer());
  EXPECT_THAT(words, HasSubstr("torque"));
  EXPECT_THAT(words, HasSubstr("\u2026"));
  EXPECT_THAT(words, HasSubstr("k = 10"));
  EXPECT_THAT(words, HasSubstr("k = 60"));
  scenes[0]->title = "Said in so many words that no panel could hold them, however small their letters, as small as they may be, and smaller";
  scenes[0]->places["title"] = {"scenes/test.yaml", 3, 4};
  EXPECT_THROW(film(), Error);
}

// Up to four variants have colours of their own; of more, that no plot tells apart, links look as always.
TEST_F(PanelFilm, ColoursFewVariantsAndNotMany) {
  const auto colours_of_titles = [this] {
    std::set<std::array<int, 3>> colours;
    for (const GlyphRun& run : test::all_of<GlyphRun>(film().static_layer(), [](const GlyphRun& run) { return run.face == Face::label_bold && run.text.starts_with("run"); }))
      colours.insert({run.color.r, run.color.g, run.color.b});
    return colours.size();
  };
  for (const char* title : {"run a", "run b", "run c", "run d"}) add(title, [](double t) { return std::vector<double>{t, 0.1}; });
  EXPECT_EQ(colours_of_titles(), 4u);
  for (const char* title : {"run e", "run f"}) add(title, [](double t) { return std::vector<double>{t, 0.1}; });
  EXPECT_EQ(colours_of_titles(), 1u);
}

TEST_F(PanelFilm, ShowsEachGripperWhereItsOwnRunHasIt) {
  add("left", sliding);
  add("right", [](double t) { return std::vector<double>{0.5 * t, 0.2}; });
  const Film both = film();
  const std::vector<Ellipse> discs = grippers(both.frame(50));
  ASSERT_EQ(discs.size(), 2u);
  const double t = 50 / 60.0;
  EXPECT_LT(test::distance(discs[0].center, both.camera(0).project({0, std::cos(3 * t), 0})), 1e-12);
  EXPECT_LT(test::distance(discs[1].center, both.camera(1).project({0.5 * t, 0.2, 0})), 1e-12);
  EXPECT_GT(test::distance(discs[1].center, both.camera(0).project({0.5 * t, 0.2, 0})), 0.1);  // control
}

TEST_F(PanelFilm, HasOneScaleForAllEllipsesSmallerThanThatOfAWholePage) {
  page.draw.push_back("ellipse");
  add("left", sliding);
  const double alone = test::per_unit_of_bar(film().static_layer());
  for (int i = 1; i < 4; ++i) add("more", sliding);
  const double bar = test::per_unit_of_bar(film().static_layer());
  // Half of it, rounded to a bar of 1, 2 or 5 x 10^n kg.
  EXPECT_LT(bar, 0.8 * alone);
  EXPECT_GT(bar, 0.2 * alone);
}

TEST_F(PanelFilm, HasArrowsThatShrinkWithThePanelsSides) {
  page.draw.push_back("velocity");
  add("left", sliding);
  // From the tail of a shaft to the tip of the head that is drawn behind it.
  const auto longest = [&] {
    double most = 0;
    const Film pictures = film();
    for (int k = 0; k < kFrames; ++k) {
      Point tail;
      for (const Item& item : pictures.frame(k).items) {
        if (item.clip < 0) continue;
        const auto* shaft = std::get_if<Capsule>(&item.shape);
        if (shaft && shaft->paint.fill == light_theme().velocity) tail = shaft->a;
        const auto* head = std::get_if<Polygon>(&item.shape);
        if (head && head->paint.fill == light_theme().velocity)
          most = std::max(most, test::distance(tail, head->corners[0]));
      }
    }
    return most;
  };
  const double alone = longest();
  EXPECT_GE(alone, 0.20);
  EXPECT_LE(alone, 0.25);
  add("right", sliding);
  EXPECT_NEAR(longest(), alone / std::sqrt(2), 1e-12);
  for (int i = 2; i < 4; ++i) add("more", sliding);
  EXPECT_NEAR(longest(), alone / 2, 1e-12);
}

TEST_F(PanelFilm, FitsTheUnionOfItsRuns) {
  add("small", [](double) { return std::vector<double>{0, 0.1}; });
  add("large", [](double t) { return std::vector<double>{0, 3 * std::sin(t)}; });
  const double both = film().camera().scale;
  runs[1] = std::make_unique<Trajectory>(*runs[0]);
  EXPECT_GT(film().camera().scale, 2 * both);
}

TEST_F(PanelFilm, LeavesARunThatDivergesOutOfTheFit) {
  add("calm", sliding);
  add("calm, too", sliding);
  const double calm = film().camera().scale;
  runs.pop_back();
  scenes.pop_back();
  add("wild", growing, true);
  const Film with_wild = film();
  // The row for the note below the panels takes a part of their height, and that is all.
  EXPECT_LT(with_wild.camera().scale, calm);
  EXPECT_GT(with_wild.camera().scale, 0.85 * calm);
  runs[1]->status = RunStatus::finished;  // negative control: now it counts
  EXPECT_LT(film().camera().scale, 0.1 * calm);
}

TEST_F(PanelFilm, ARunThatLeavesThePictureStandsStillAndSaysWhen) {
  add("calm", sliding);
  add("wild", growing, true);
  const Film both = film();
  const Rect& area = both.scene_area(1);
  // The first frame at which the slider, half a carriage long on both sides, is not all inside: from the
  // formula.
  const double half = size::kCarriageLength / 2;
  int left = 0;
  while (test::is_inside(area, both.camera(1).project({0, growing(left / 60.0)[1], 0}), -half)) ++left;
  ASSERT_GT(left, 2);
  ASSERT_LT(left, kFrames - 10);
  EXPECT_THAT(test::words_of(both.frame(left - 1)), Not(HasSubstr("left the picture")));
  const std::string note = "left the picture at " + time_text(left / 60.0);
  EXPECT_THAT(test::words_of(both.frame(left)), HasSubstr(note));
  EXPECT_THAT(test::words_of(both.frame(kFrames - 1)), HasSubstr(note));
  EXPECT_EQ(both.panel(1).left_at(), left / 60.0);
  EXPECT_FALSE(both.panel(0).left_at());
  // It stands still where it was last inside, while the other goes on.
  const auto last_inside = grippers(both.frame(left - 1)), later = grippers(both.frame(left + 8));
  ASSERT_EQ(later.size(), 2u);
  EXPECT_EQ(later[1].center.y, last_inside[1].center.y);
  EXPECT_TRUE(test::is_inside(area, later[1].center));
  EXPECT_NE(later[0].center.y, last_inside[0].center.y);
}

// What plots see between frames counts, too.
TEST_F(PanelFilm, HowFarARunHasBeenIsToldOfItsCurves) {
  add("calm", sliding);
  add("wild", growing, true);
  const int last = kFrames - 1;
  runs[1]->q.back() = 1e5;
  EXPECT_THAT(test::words_of(film().frame(last)), HasSubstr("up to 1\u00D710\u2075 m away"));
  auto curves = std::make_shared<Trajectory>(*runs[1]);
  curves->q[std::size_t(2 * last - 1)] = 4e6;
  runs[1]->between = curves;
  EXPECT_THAT(test::words_of(film().frame(last)), HasSubstr("up to 4\u00D710\u2076 m away"));
  EXPECT_THAT(test::words_of(film().frame(last - 2)), HasSubstr("up to 4\u00D710\u2076 m away")) << "one number for all of the clip";
  for (double& q : curves->q) q = std::clamp(q, -3.0, 3.0);
  EXPECT_THAT(test::words_of(film().frame(last)), Not(HasSubstr("m away"))) << "negative control: it stays near";
}

TEST_F(PanelFilm, HowFarARunHasBeenStandsOnAPageHigherThanWideToo) {
  add("calm", sliding);
  add("wild", growing, true);
  page.video.width = 1080;
  page.video.height = 1920;
  runs[1]->q.back() = 1e5;
  EXPECT_THAT(test::words_of(film().frame(kFrames - 1)), HasSubstr("1\u00D710\u2075 m away"));
}

// An arrow at the edge points to where it left, and its rails are those of the same machine beside it.
TEST_F(PanelFilm, ARunThatLeftThePictureHasAnArrowTowardsIt) {
  add("first", sliding);
  add("wild", growing, true);
  const Film two = film();
  const auto heads = [&](const Picture& picture) {
    return test::all_of<Polygon>(picture, [&](const Polygon& one) { return one.paint.fill == light_theme().side_b; }).size();
  };
  const int last = kFrames - 1;
  EXPECT_GT(heads(two.frame(last)), heads(two.frame(0)));
  // It stays, wherever the run swings to.
  const auto tips = [&] {
    const Film film = this->film();
    std::vector<Point> found;
    for (const int k : {last - 1, last})
      for (const Polygon& one : test::all_of<Polygon>(film.frame(k)))
        if (one.paint.fill == light_theme().side_b) found.push_back(one.corners[0]);
    return found;
  };
  const std::vector<Point> before = tips();
  for (const double far : {-1e5, 1e5, 0.0}) {
    runs[1]->q.back() = far;
    const std::vector<Point> now = tips();
    ASSERT_EQ(now.size(), before.size()) << far;
    for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LT(test::distance(now[i], before[i]), 1e-12) << far;
  }
}

TEST_F(PanelFilm, ARunThatEndsInsideThePictureIsDatedByItsEnd) {
  add("calm", sliding);
  add("wild", sliding, true, 40);
  runs[1]->end_time = 0.66;
  EXPECT_THAT(test::words_of(film().frame(40)), HasSubstr("diverged at t = 0.66 s"));
  runs[1]->status = RunStatus::not_converged;
  EXPECT_THAT(test::words_of(film().frame(40)), HasSubstr("ended at t = 0.66 s"));
  EXPECT_THAT(test::words_of(film().frame(39)), Not(HasSubstr("ended")));
}

TEST_F(PanelFilm, WhereAllDivergeTheCameraHoldsThemAll) {
  add("wild", growing, true);
  add("wild, too", growing, true);
  const Film both = film();
  EXPECT_TRUE(test::all_finite(both.frame(kFrames - 1)));
  EXPECT_THAT(test::words_of(both.frame(kFrames - 1)), HasSubstr("left the picture"));
}

TEST_F(PanelFilm, AloneStandsStillOnlyWhereItIsToDiverge) {
  add("", sliding, true, 40);
  scenes[0]->expect = page.expect = Outcome::diverge;
  EXPECT_THAT(test::words_of(film().frame(60)), HasSubstr("diverged at"));
  EXPECT_THAT(test::words_of(film().frame(60)), HasSubstr("t = 1.00 s"));
  scenes[0]->expect = page.expect = Outcome::finish;
  EXPECT_THAT(test::words_of(film().frame(60)), Not(HasSubstr("diverged")));
}

TEST_F(PanelFilm, HasOneTitleOneTimeAndATitleForEachPanelInTheColourOfItsSide) {
  add("left", sliding);
  add("right", sliding);
  const Film both = film();
  const std::string words = test::words_of(both.static_layer());
  for (const char* title : {"Whole", "left", "right"}) EXPECT_THAT(words, HasSubstr(title));
  EXPECT_EQ(test::words_of(both.frame(30)), "t = 0.50 s");
  for (const GlyphRun& run : test::all_of<GlyphRun>(both.static_layer())) {
    if (run.text == "left") {
      EXPECT_EQ(run.color, light_theme().side_a);
    }
    if (run.text == "right") {
      EXPECT_EQ(run.color, light_theme().side_b);
    }
    if (run.text == "Whole") {
      EXPECT_EQ(run.color, light_theme().ink);
    }
  }
}

TEST_F(PanelFilm, WritesAllPanelTitlesAtOneSize) {
  add("left", sliding);
  add("a title that is so long that it has to be smaller", sliding);
  std::vector<double> sizes;
  for (const GlyphRun& run : test::all_of<GlyphRun>(film().static_layer()))
    if (run.color == light_theme().side_a || run.color == light_theme().side_b) sizes.push_back(run.size);
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_EQ(sizes[0], sizes[1]);
  EXPECT_LT(sizes[0], size::kSymbol);
}

TEST_F(PanelFilm, SaysTheTorqueOnlyWhereAllPanelsHaveTheSame) {
  add("left", sliding);
  add("right", sliding);
  const auto torque_of = [](Scene& scene, const std::string& second) {
    scene.torque = {{"7", {}, {}}, {second, {}, {}}};
  };
  torque_of(*scenes[0], "8");
  torque_of(*scenes[1], "8");
  EXPECT_THAT(test::words_of(film().static_layer()), HasSubstr("7"));
  torque_of(*scenes[1], "9");
  EXPECT_THAT(test::words_of(film().static_layer()), Not(HasSubstr("7")));
}

TEST_F(PanelFilm, KeepsEverythingThatMovesInsideItsPanelAndWordsOutside) {
  for (int i = 0; i < 5; ++i) add("panel", sliding);
  const Film five = film();
  for (const Picture& picture : {five.static_layer(), five.frame(70)}) {
    ASSERT_EQ(picture.clips.size(), 5u);
    for (const Item& item : picture.items) {
      if (item.clip < 0) continue;
      const Rect& clip = picture.clips[std::size_t(item.clip)];
      if (const auto* c = std::get_if<Capsule>(&item.shape)) {
        EXPECT_TRUE(test::is_inside(clip, c->a) && test::is_inside(clip, c->b));
      }
      if (const auto* e = std::get_if<Ellipse>(&item.shape)) {
        EXPECT_TRUE(test::is_inside(clip, e->center));
      }
    }
  }
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < i; ++j) EXPECT_FALSE(test::overlap(five.scene_area(i), five.scene_area(j)));
}

// On a page higher than wide what is tall stands side by side, with titles on two lines; negative control: what is flat does not.
TEST_F(PanelFilm, OnAHighPageStandAsTheyAreLargest) {
  page.video.width = 1080;
  page.video.height = 1920;
  for (const bool is_tall : {true, false}) {
    scenes.clear();
    runs.clear();
    const auto swinging = [&](double t) { return is_tall ? std::vector<double>{0, 3 * std::cos(3 * t)} : std::vector<double>{3 * std::cos(3 * t), 0}; };
    add("is as bounded as it can be", swinging);
    add("grows by half from step to step", swinging);
    const Film both = film();
    EXPECT_EQ(both.scene_area(0).y0 == both.scene_area(1).y0, is_tall);
    EXPECT_EQ(both.scene_area(0).x0 == both.scene_area(1).x0, !is_tall);
    EXPECT_THAT(test::words_of(both.static_layer()), testing::Not(testing::HasSubstr("\u2026")));
  }
}

// Negative control: a name of one word that is wider than its panel is cut.
TEST_F(PanelFilm, OfASheetHaveNamesOnSeveralLines) {
  page.video.panel_names = 0.05;
  add("truth (Taylor series)", sliding);
  add("explicit Euler, 20 ms", sliding);
  add("semi-implicit Euler, 20 ms", sliding);
  EXPECT_THAT(test::words_of(film().static_layer()), testing::Not(testing::HasSubstr("\u2026")));
  scenes.back()->title = "semiimplicitEulerwithstepsof20ms";
  EXPECT_THAT(test::words_of(film().static_layer()), testing::HasSubstr("\u2026"));
}

TEST_F(PanelFilm, BlamesThePanelWhoseTitleDoesNotFit) {
  add("left", sliding);
  add(std::string(120, 'm'), sliding);
  scenes[1]->places["title"] = {"scenes/test.yaml", 7, 5};
  try {
    film();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("scenes/test.yaml:7:5: the title of panel 2"));
  }
}

// Two tones of the variant's colour; the page's own link colours are nowhere.
TEST(Variants, BearTheirColourInTheirLinks) {
  for (const bool ghost : {false, true})
    for (int i = 0; i < 2; ++i) {
      const Variant variant = variant_of(i, 2, ghost, light_theme());
      EXPECT_EQ(variant.color, i == 0 ? light_theme().side_a : light_theme().side_b);
      EXPECT_EQ(variant.outlined, ghost && i == 1);
      const auto& link = variant.theme->link;
      EXPECT_NE(link[0], link[1]);
      EXPECT_EQ(link[0], link[2]);
      const auto spread = [](Color c) { return std::array{c.r - c.g, c.g - c.b}; };
      for (std::size_t tone = 0; tone < 2; ++tone)
        for (std::size_t part = 0; part < 2; ++part)  // the same order of red, green and blue
          EXPECT_GT(spread(link[tone])[part] * spread(variant.color)[part], 0) << i << " " << tone;
    }
}

TEST(PanelGrid, TakesTheArrangementInWhichThingsAreLargest) {
  const auto box_of = [](double width, double height) {
    FitBox box;
    box.add({}, {0, 0});
    box.add({}, {width, height});
    return box;
  };
  const Rect area{0, 0, 1.6, 0.8};
  const auto columns = [&](double width, double height, int count) {
    const std::vector<PanelCell> cells = best_cells(area, count, {}, box_of(width, height));
    int n = 0;
    while (n < count && cells[std::size_t(n)].scene.y0 == cells[0].scene.y0) ++n;
    return n;
  };
  EXPECT_EQ(columns(1, 3, 4), 4);  // tall things stand side by side
  EXPECT_EQ(columns(3, 1, 4), 2);
  EXPECT_EQ(columns(9, 1, 4), 1);  // flat ones lie above each other
  EXPECT_EQ(columns(1, 1, 12), 4);
  EXPECT_TRUE(best_cells({0, 0, 0.2, 0.2}, 12, {}, box_of(1, 1)).empty());
  // Three in two by two would be a little larger, but leave a cell empty; unless their titles would not fit above one.
  const Rect upright{0, 0, 0.5, 0.5};
  EXPECT_EQ(best_cells(upright, 3, {}, box_of(1.4, 1))[1].scene.x0, 0);
  EXPECT_GT(best_cells(upright, 3, {}, box_of(1.4, 1), 1)[1].scene.x0, 0);
}

TEST(PanelGrid, OfOnePanelIsTheWholeArea) {
  const Rect area{0.045, 0.1, 1.7, 0.9};
  const Rect scene = panel_cells(area, 1, 1, {}).at(0).scene;
  EXPECT_EQ(scene.x0, area.x0);
  EXPECT_EQ(scene.x1, area.x1);
  EXPECT_EQ(scene.y0, area.y0);
  EXPECT_EQ(scene.y1, area.y1);
}

}  // namespace
}  // namespace chainreel

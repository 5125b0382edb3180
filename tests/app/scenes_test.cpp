// Every scene of assets/scenes: it runs, its film is what it promises, and its picture is the golden one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/theme.hpp"
#include "support/picture_compare.hpp"
#include "support/scene_names.hpp"

namespace chainreel {
namespace {

constexpr int kWidth = 640, kHeight = 360;
constexpr double kLeastFilled = 0.25;  // of a scene's width or height: what joints, words and arrows have around them is not counted

class EveryScene : public ::testing::TestWithParam<std::string> {
 protected:
  EveryScene()
      : prepared_(load_film("assets/scenes/" + GetParam() + ".yaml",
                            {"video.width=640", "video.height=360", "text_scale=1.5"})),
        times_(frame_times(prepared_.scene)),
        runs_(prepared_, {}, times_),
        film_(runs_.pictures(int(times_.size()), fonts_)) {}

  // The frame at 1.2 s: chaos has not begun anywhere.
  static constexpr int kFrame = 72;

  Image image(int frame) const {
    Picture picture = film_.static_layer();
    picture.append(film_.frame(frame));
    return rasterise(picture, kWidth, kHeight, fonts_);
  }

  Pixel pixel_at(const Image& image, int panel, const Eigen::Vector3d& x) const {
    const Point page = film_.camera(panel).project(x);
    return image.at(int(page.x * kHeight), int((1 - page.y) * kHeight));
  }

  Eigen::Vector3d gripper(int panel, int frame) const {
    const Chain& chain = prepared_.panels[std::size_t(panel)].simulation.chain;
    const Trajectory& run = runs_[std::size_t(panel)];
    Workspace ws(chain);
    compute_kinematics(chain, ws, run.q_at(frame), run.qd_at(frame));
    return frame_position(chain, ws, chain.end_effector);
  }

  // Panels that still show their run at that frame.
  std::vector<int> moving_panels(int frame) const {
    std::vector<int> panels;
    // Where panels lie over one another the first alone has its end effector filled.
    const int count = prepared_.scene.layout == PageLayout::ghost ? 1 : film_.panel_count();
    for (int i = 0; i < count; ++i)
      if (const auto left = film_.panel(i).left_at(); !left || times_[std::size_t(frame)] < *left)
        panels.push_back(i);
    return panels;
  }

  Fonts fonts_;
  PreparedFilm prepared_;
  std::vector<double> times_;
  Runs runs_;
  Film film_;
};

INSTANTIATE_TEST_SUITE_P(Assets, EveryScene, ::testing::ValuesIn(test::scene_names()),
                         [](const auto& p) { return p.param; });

TEST_P(EveryScene, RunsToTheEndThatItExpects) {
  EXPECT_NO_THROW(runs_.require_expected_ends());
  EXPECT_EQ(film_.frame_count(), frame_count(prepared_.scene.duration, prepared_.scene.video.fps));
}

TEST_P(EveryScene, LooksLikeItsGoldenAndKeepsItsMargins) {
  // The same pixels are expected everywhere; another build of FreeType may move a glyph's edge, and one of Mesa a pixel.
  const Image picture = image(kFrame);
  EXPECT_TRUE(matches_golden(picture, GetParam(), {.max = 24, .mean = 0.05}));
  // Negative control: a tenth of a second later is another picture.
  EXPECT_FALSE(pictures_agree(picture, image(kFrame + 6), {.max = 24, .mean = 0.05}, GetParam() + "_control"));
  const Color background = light_theme().background;
  for (const auto& [x, y] : {std::pair{1, 1}, {kWidth - 2, 1}, {1, kHeight - 2}, {kWidth - 2, kHeight - 2}})
    EXPECT_EQ(picture.at(x, y), (Pixel{background.r, background.g, background.b, 255}));
}

TEST_P(EveryScene, ShowsTheGripperWhereThePhysicsHasItAndNotElsewhere) {
  // Where the model's own shapes are drawn the axes of the ellipse cross there.
  const Color ink = prepared_.panels.front().shapes ? light_theme().ellipse : light_theme().ink;
  const Image picture = image(kFrame);
  ASSERT_FALSE(moving_panels(kFrame).empty());
  // A disc of 5 px: its centre pixel is flat ink. Lines that cross are hardly wider than a pixel, and cover nine tenths of that in
  // which they do, wherever in it the point lies: a tenth of the way to the paper is 17 levels.
  const int step = prepared_.panels.front().shapes ? 17 : 0;
  const std::vector<std::string>& drawn = prepared_.scene.draw;
  const bool is_marked = step == 0 || std::find(drawn.begin(), drawn.end(), "ellipse") != drawn.end();
  const Color paper = light_theme().background;
  for (const int panel : moving_panels(kFrame)) {
    const Pixel seen = pixel_at(picture, panel, gripper(panel, kFrame));
    if (!is_marked) {
      // At the end of a shape, whose line goes along there.
      EXPECT_LT(seen.g, paper.g - 50) << panel;
      continue;
    }
    EXPECT_NEAR(seen.r, ink.r, step) << panel;
    EXPECT_NEAR(seen.g, ink.g, step) << panel;
    EXPECT_NEAR(seen.b, ink.b, step) << panel;
  }
  // Negative control: some disc's widths away there is no gripper.
  const Color disc = light_theme().ink;
  for (const int panel : moving_panels(kFrame)) {
    const Eigen::Vector3d elsewhere = Eigen::Vector3d(0.012, 0.07, 0) / film_.camera(panel).scale;
    EXPECT_NE(pixel_at(picture, panel, gripper(panel, kFrame) + elsewhere), (Pixel{disc.r, disc.g, disc.b, 255}))
        << panel;
  }
}

// The part of a panel's scene in which its joints and its end move, and the part of the page that its scene has.
TEST_P(EveryScene, FillsItsPageWithItsMotion) {
  const double aspect = double(kWidth) / kHeight;
  double page = 0;
  for (int i = 0; i < film_.panel_count(); ++i) {
    const Chain& chain = prepared_.panels[std::size_t(i)].simulation.chain;
    const Trajectory& run = runs_[std::size_t(i)];
    const Rect& scene = film_.scene_area(i);
    Workspace ws(chain);
    Rect filled{1e9, 1e9, -1e9, -1e9};
    const auto left = film_.panel(i).left_at();
    for (int k = 0; k < std::min(run.size(), film_.frame_count()) && !(left && times_[std::size_t(k)] >= *left); ++k) {
      compute_kinematics(chain, ws, run.q_at(k), run.qd_at(k));
      std::vector<Eigen::Vector3d> places;
      for (std::size_t b = 1; b < chain.bodies.size(); ++b) places.push_back(pose_of(ws, int(b)).translation());
      if (chain.end_effector >= 0) places.push_back(frame_position(chain, ws, chain.end_effector));
      for (const Eigen::Vector3d& place : places) {
        const Point p = film_.camera(i).project(place);
        filled = {std::min(filled.x0, p.x), std::min(filled.y0, p.y), std::max(filled.x1, p.x), std::max(filled.y1, p.y)};
      }
    }
    const double wide = filled.width() / scene.width(), high = filled.height() / scene.height();
    page += scene.width() * scene.height() / aspect;
    std::printf("%-20s panel %d: motion %3.0f x %3.0f %% of its scene, which is %3.0f x %3.0f %% of the page\n", GetParam().c_str(),
                i + 1, 100 * wide, 100 * high, 100 * scene.width() / aspect, 100 * scene.height());
    EXPECT_GE(std::max(wide, high), kLeastFilled) << "panel " << i + 1;
  }
}

TEST(Scenes, OfTheLectureAreAllThere) {
  for (const char* name :
       {"pp_free", "pp_spring", "rr_free", "rr_torque", "rrr_free", "rrr_torque", "rr_ellipse"})
    EXPECT_THAT(test::scene_names(), testing::Contains(name));
}

// The page of a scene in layout auto, and the same with `layout: scene`.
struct TwoPages {
  Rect area, whole;
  double kept = 0;  // of the motion's size

  explicit TwoPages(const std::string& name, const std::vector<std::string>& more = {}) {
    const Fonts fonts;
    std::vector<double> scales;
    for (const char* layout : {"layout=auto", "layout=scene"}) {
      std::vector<std::string> overrides{"duration=2", layout};
      overrides.insert(overrides.end(), more.begin(), more.end());
      const PreparedFilm film = load_film("assets/scenes/" + name + ".yaml", overrides);
      const Runs runs(film);
      const Film pictures = runs.pictures(runs.clock().frame_count(), fonts);
      (scales.empty() ? area : whole) = pictures.scene_area();
      scales.push_back(pictures.camera().scale);
    }
    kept = scales[0] / scales[1];
  }
  bool is_whole() const { return area.x0 == whole.x0 && area.x1 == whole.x1 && area.y0 == whole.y0 && area.y1 == whole.y1; }
};

TEST(LayoutAuto, TellsTheStoryBesideANarrowMotionAndBelowAFlatOne) {
  for (const char* narrow : {"pp_spring", "particle", "rrr_torque"}) {
    const TwoPages pages(narrow, {"plot=null"});  // of a scene that names plots itself, too
    EXPECT_LT(pages.area.width(), 0.65 * pages.whole.width()) << narrow;
    EXPECT_EQ(pages.area.height(), pages.whole.height()) << narrow;
    EXPECT_GE(pages.kept, 0.85) << narrow;
  }
  const TwoPages flat("pp_spring", {"camera.fit=[-2, -0.5, 2, 0.5]"});
  EXPECT_EQ(flat.area.width(), flat.whole.width());
  EXPECT_LT(flat.area.height(), 0.75 * flat.whole.height());
  EXPECT_GE(flat.kept, 0.9);
}

TEST(LayoutAuto, OnAPageHigherThanWideANarrowMotionGivesMoreToItsPlot) {
  const TwoPages spring("pp_spring", {"video.width=1080", "video.height=1920"});
  EXPECT_LT(spring.area.height(), 0.8 * spring.whole.height());
  EXPECT_GE(spring.kept, 0.6);
  const TwoPages parabola("pp_free", {"video.width=1080", "video.height=1920"});
  EXPECT_FALSE(parabola.is_whole());
  EXPECT_GE(parabola.kept, 0.75) << "that motion fills the page";
}

// Steps so long that both runs err have the exact motion in their plot; of runs of which one is exact there is no more to say.
TEST(Plots, OfMethodsThatErrShowWhatIsExact) {
  const auto words_of = [](const std::string& name, const std::vector<std::string>& more) {
    const PreparedFilm film = load_film("assets/scenes/" + name + ".yaml", more);
    const Runs runs(film);
    return test::words_of(runs.pictures(runs.clock().frame_count(), Fonts()).static_layer());
  };
  EXPECT_THAT(words_of("big_steps", {}), testing::HasSubstr("exact"));
  EXPECT_THAT(words_of("big_steps", {"compare.1.start.q=[0, 0.5]"}), testing::Not(testing::HasSubstr("exact"))) << "two motions";
  EXPECT_THAT(words_of("euler_gains_energy", {}), testing::Not(testing::HasSubstr("exact"))) << "the Taylor series is";
}

// A plot of one driven coordinate has its name; of two that of all. Numbers at the axes of an ellipse say which curve they are where the page has the
// plot of them, and are bare where it has not.
TEST(Plots, AndWhatTheyTellOfHaveOneName) {
  const auto words_of = [](const std::string& name, const std::vector<std::string>& more, bool is_title) {
    const PreparedFilm film = load_film("assets/scenes/" + name + ".yaml", more);
    const Runs runs(film);
    const Fonts fonts;
    const Film pictures = runs.pictures(runs.clock().frame_count(), fonts);
    return test::words_of(is_title ? pictures.static_layer() : pictures.frame(0));
  };
  EXPECT_THAT(words_of("pp_spring", {}, true), testing::HasSubstr("2 [m]"));
  EXPECT_THAT(words_of("pp_spring", {"torque=[\"-50 * q1\", \"-100 * y_G\"]"}, true), testing::Not(testing::HasSubstr("2 [m]")));
  EXPECT_THAT(words_of("rr_ellipse", {}, false), testing::HasSubstr("= 1.00 kg"));
  EXPECT_THAT(words_of("rr_ellipse", {"layout=scene"}, false), testing::AllOf(testing::HasSubstr("1.00 kg"), testing::Not(testing::HasSubstr("= 1.00 kg"))));
}

// A torque beyond its scale has a number beside its arc, or where arcs have no names, as those of seven joints, one beside the scale.
TEST(Legend, TellsThePeaksThatNoNumberStandsBeside) {
  const auto words_of = [](const std::string& model, const std::string& torque, const char* start = "start={q: [0, 0, 0, 0, 0, 0, 0]}") {
    const PreparedFilm film = load_film("assets/scenes/rr_torque.yaml", {"model=" + model, start, "duration=2", "torque=" + torque});
    const Runs runs(film);
    return test::words_of(runs.pictures(runs.clock().frame_count(), Fonts()).static_layer());
  };
  const std::string peak = "2 + 60*exp(-((t-1)/0.06)^2)", seven = "{links: [0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2]}";
  EXPECT_THAT(words_of(seven, "[\"" + peak + "\", 1, 1, 1, 1, 1, 1]"), testing::HasSubstr("up to 62"));
  EXPECT_THAT(words_of(seven, "[1, 1, 1, 1, 1, 1, 1]"), testing::Not(testing::HasSubstr("up to"))) << "nothing is cut";
  EXPECT_THAT(words_of("{links: [0.5, 0.5]}", "[\"" + peak + "\", 1]", "start={q: [0, 0]}"), testing::Not(testing::HasSubstr("up to"))) << "its number stands there";
}

// Panels of a motion that is narrow are as tall as the page, and their plot stands beside them; those of a wide one keep it below.
TEST(LayoutCompare, HasThePlotBesidePanelsOfANarrowMotion) {
  const auto area_of = [](const std::vector<std::string>& more) {
    const PreparedFilm film = load_film("assets/scenes/big_steps.yaml", more);
    const Runs runs(film);
    return runs.pictures(runs.clock().frame_count(), Fonts()).scene_area();
  };
  const Rect narrow = area_of({}), wide = area_of({"camera.fit=[-2, -0.5, 2, 0.5]"}), upright = area_of({"video.width=1080", "video.height=1920"});
  EXPECT_GT(narrow.height(), 1.5 * wide.height());
  EXPECT_LT(narrow.width(), 0.65 * wide.width());
  EXPECT_LT(upright.width(), 0.5 * 1080 / 1920.0) << "side by side, above their plot";
  EXPECT_GT(upright.height(), 0.4);
}

// The clip's end is no frame: a picture of it has a sample more, and a time with a digit more, and its panels where the film has them.
TEST(LayoutCompare, StandsAtTheEndAsInTheFilm) {
  const PreparedFilm film = load_film("assets/scenes/big_steps.yaml", {});
  std::vector<double> times = frame_times(film.scene);
  ASSERT_LT(times.back(), film.scene.duration);
  std::vector<Rect> areas;
  for (int i = 0; i < 2; ++i, times.push_back(film.scene.duration)) {
    const Runs runs(film, {}, times);
    areas.push_back(runs.pictures(int(times.size()), Fonts()).scene_area());
  }
  EXPECT_EQ(areas[0].width(), areas[1].width());
  EXPECT_EQ(areas[0].height(), areas[1].height());
}

TEST(LayoutAuto, TakesNothingFromAMotionAndNothingIsToldOfPicturesOfMassesOrWithoutWords) {
  EXPECT_FALSE(TwoPages("rr_ellipse").is_whole()) << "what its axes measure";
  EXPECT_TRUE(TwoPages("rr_ellipse", {"draw=[ellipse, mass_matrix]"}).is_whole()) << "the numbers are in the picture";
  EXPECT_TRUE(TwoPages("pp_spring", {"camera.fit=[-1.6, -1, 1.6, 0.8]"}).is_whole()) << "what is asked for fills the page";
  EXPECT_FALSE(TwoPages("pp_spring", {"camera.fit=[-0.5, -1, 0.5, 0.8]"}).is_whole());
  EXPECT_FALSE(TwoPages("pp_spring", {"plot=energy"}).is_whole()) << "the scene's own plot";
}

}  // namespace
}  // namespace chainreel

// Words of `annotate:` and their leader lines.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

class AnnotatedRr : public ::testing::Test {
 protected:
  AnnotatedRr() {
    scene.file = "scenes/test.yaml";
    scene.duration = 2;
    AnnotationEntry entry;
    entry.at = 1;
    entry.text = "heaviest along $Lambda^{-1}$";
    entry.spot = {0.5, -0.75};
    entry.hold = 1;
    scene.annotate = {entry};
  }

  Film film() {
    const FilmClock clock(2, {10, 1}, {}, pauses_of(scene.annotate, {}));
    run = test::run_at(clock.frame_times(), motion);
    return Film(scene, {{scene, chain, run}}, run.t, fonts(), clock);
  }

  // The ends of lines and the dots at them, which are of the leader alone.
  static std::vector<Point> dots(const Picture& picture) {
    std::vector<Point> found;
    for (const Item& item : picture.items)
      if (const auto* e = std::get_if<Ellipse>(&item.shape); e && std::abs(norm(e->u) - 0.0055) < 1e-9)
        found.push_back(e->center);
    return found;
  }

  Chain chain = test::model("rr");
  std::function<std::vector<double>(double)> motion = test::swing;
  Scene scene;
  Trajectory run;
};

TEST_F(AnnotatedRr, HasALeaderToItsPointWhileTheClockStandsStillAndALittleBehind) {
  const Film one = film();
  ASSERT_EQ(one.frame_count(), 30);
  const Camera& camera = one.camera();
  for (int k = 0; k < 30; ++k) {
    const std::vector<Point> ends = dots(one.frame(k));
    ASSERT_EQ(ends.size(), k >= 10 && k <= 21 ? 1u : 0u) << k;
    if (!ends.empty()) {
      EXPECT_LT(norm(ends[0] - camera.project({0.5, -0.75, 0})), 1e-12) << k;
    }
  }
}

// Rods of 1 m: their middle, and the joint by its own name; oracle by hand.
TEST_F(AnnotatedRr, ALinkIsPointedAtInItsMiddleAndAJointWhereItTurns) {
  motion = [](double) { return std::vector<double>{0.3, 0.5}; };
  const auto pointed = [this](const std::string& name) {
    scene.annotate[0].spot.clear();
    scene.annotate[0].point = name;
    const Film one = film();
    const std::vector<Point> ends = dots(one.frame(15));
    return ends.size() == 1 ? (1 / one.camera().scale) * (ends[0] - one.camera().project({0, 0, 0})) : Point{9, 9};
  };
  const Point joint{std::cos(0.3), std::sin(0.3)}, along{std::cos(0.8), std::sin(0.8)};
  EXPECT_LT(norm(pointed("joint2") - joint), 1e-9);
  EXPECT_LT(norm(pointed("link2") - (joint + 0.5 * along)), 1e-9);
  EXPECT_LT(norm(pointed("gripper") - (joint + along)), 1e-9);
}

TEST_F(AnnotatedRr, FramesOfAPauseAreOnePictureAndAnyFrameIsDrawnAlone) {
  const Film one = film(), other = film();
  const std::size_t items = one.frame(15).items.size();
  for (int k = 11; k < 20; ++k) EXPECT_EQ(one.frame(k).items.size(), items) << k;
  EXPECT_EQ(other.frame(15).items.size(), items);
}

// Of words that hold nothing none is true before their instant; here frame k shows k / 10 s.
TEST_F(AnnotatedRr, WordsThatDoNotHoldTheFilmBeginAtTheirInstant) {
  scene.annotate[0].hold = 0;
  const Film one = film();
  for (int k = 0; k < one.frame_count(); ++k) EXPECT_EQ(dots(one.frame(k)).size(), k >= 10 ? 1u : 0u) << k;
}

// A line that would lead out of the picture is none: it used to be left out, and its words stood alone.
TEST_F(AnnotatedRr, APointBeyondThePictureIsAnErrorThatSaysWhatIsShown) {
  scene.annotate[0].place = {"scenes/test.yaml", 7, 3};
  for (const std::vector<double>& spot : {std::vector<double>{50, 50}, {0, -9}, {50, 50, 0}}) {
    scene.annotate[0].spot = spot;
    try {
      film();
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("scenes/test.yaml:7:3: 'annotate.1.point' lies outside of the picture, which shows "));
    }
  }
}

TEST_F(AnnotatedRr, WordsWiderThanThePictureAreAnErrorAtTheirEntry) {
  scene.annotate[0].text = std::string(200, 'w');
  scene.annotate[0].place = {"scenes/test.yaml", 7, 3};
  try {
    film().frame(15);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("scenes/test.yaml:7:3: 'annotate.1.text' has no room in its panel, one word of it being wider"));
  }
}

// As many words as there is room for stand in a line; formulas stay whole.
TEST_F(AnnotatedRr, LongWordsAreBrokenIntoLinesAboutEquallyLong) {
  scene.draw = {"chain"};
  const auto lines_of = [&](const std::string& text) {
    scene.annotate[0].text = text;
    std::set<double> lines;
    for (const Item& item : film().frame(15).items)
      if (const auto* run_of = std::get_if<GlyphRun>(&item.shape)) lines.insert(run_of->origin.y);
    return lines.size();
  };
  EXPECT_EQ(lines_of("heaviest along the arm"), 1u);
  std::string words;
  for (int i = 0; i < 12; ++i) words += "heavier ";
  EXPECT_EQ(lines_of(words), 2u);
  EXPECT_EQ(lines_of(words + words), 4u);
}

// Whatever the words' length, and wherever the arm is: of one shape, near their point alone, they lay on links in 5 of these 20
// pictures.
TEST_F(AnnotatedRr, LongWordsTakeTheShapeAndPlaceThatKeepOffTheChain) {
  chain = test::model("rrr");
  motion = [](double t) { return std::vector<double>{1.6 - 0.2 * t, -1 - 0.3 * t, -2 + 0.5 * t}; };
  scene.draw = {"chain"};
  scene.text_scale = 1.3;
  scene.video.width = 860;
  scene.video.height = 640;
  int pictures = 0;
  for (const int count : {8, 12, 16, 20})
    for (const double at : {0.2, 0.6, 1.0, 1.4, 1.8}) {
      AnnotationEntry& entry = scene.annotate[0];
      entry.at = at;
      entry.spot.clear();
      entry.point = "gripper";
      entry.text.clear();
      for (int i = 0; i < count; ++i) entry.text += "heavier ";
      const Picture picture = film().frame(int(std::lround(10 * at)) + 5);
      std::vector<Capsule> links;
      int compared = 0;
      for (const Item& item : picture.items)
        if (const auto* link = std::get_if<Capsule>(&item.shape); link && link->radius > 0.005) links.push_back(*link);
      for (const Item& item : picture.items) {
        const auto* run_of = std::get_if<GlyphRun>(&item.shape);
        if (run_of == nullptr || run_of->stroke_width > 0) continue;
        for (const auto& glyph : run_of->glyphs)
          for (const Capsule& link : links) {
            ++compared;
            EXPECT_GT(distance_to(run_of->origin + Point{glyph.x, 0.3 * run_of->size}, link.a, link.b), link.radius)
                << count << " words at " << at << " s";
          }
      }
      pictures += compared > 0;
    }
  EXPECT_EQ(pictures, 20);
}
}  // namespace
}  // namespace chainreel

// What a film says of its speed, and what stays where it is while that changes.

#include <gmock/gmock.h>

#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/layers/speed_box.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(SpeedText, HasTheSignOfMultiplication) {
  EXPECT_EQ(speed_text(0.25), "0.25\u00D7");
  EXPECT_EQ(speed_text(4), "4\u00D7");
  EXPECT_EQ(speed_text(1.0 / 3), "0.333\u00D7");
  EXPECT_EQ(speed_text(99.96), "100\u00D7");
  EXPECT_EQ(speed_text(123.4), "123\u00D7");
  EXPECT_EQ(speed_text(1000), "1000\u00D7");
  EXPECT_EQ(speed_text(1234), "1234\u00D7");
}

TEST(TimeDecimals, TellAnyTwoFramesApart) {
  const auto of = [](double speed, int fps = 60) { return time_decimals({2, {fps, 1}, {{0, 1, speed}}}); };
  EXPECT_EQ(time_decimals({2, {120, 1}}), 2) << "as ever where nothing is slowed down";
  EXPECT_EQ(of(4), 2);
  EXPECT_EQ(of(0.6), 2);   // exactly 0.01 s
  EXPECT_EQ(of(0.5), 3);   // 0.0083 s
  EXPECT_EQ(of(0.05), 4);  // 0.00083 s
  EXPECT_EQ(of(0.001), 5);
}

class SlowRr : public ::testing::Test {
 protected:
  SlowRr() {
    scene.title = "RR";
    scene.file = "scenes/test.yaml";
    run = test::run_at(clock.frame_times(), test::swing);
  }
  Film film() const { return Film(scene, {{scene, chain, run}}, run.t, fonts(), clock); }

  // Boxes outside the scene: capsules with an outline.
  static std::vector<Capsule> boxes(const Picture& picture) {
    std::vector<Capsule> found;
    for (const Item& item : picture.items)
      if (const auto* c = std::get_if<Capsule>(&item.shape); c && item.clip < 0 && c->paint.stroke_width > 0)
        found.push_back(*c);
    return found;
  }
  static GlyphRun time_of(const Picture& picture) {
    const auto words =
        test::all_of<GlyphRun>(picture, [](const GlyphRun& r) { return r.text.starts_with("t = "); });
    EXPECT_EQ(words.size(), 1u);
    return words.at(0);
  }

  // 0.5 s, then half a second at a tenth, half a second at 8, half a second.
  FilmClock clock{2, {60, 1}, {{0.5, 1, 0.1}, {1, 1.5, 8}}};
  Chain chain = test::model("rr");
  Trajectory run;
  Scene scene;
};

TEST_F(SlowRr, ShowsItsSpeedInTheSameBoxFromTheFrameOfTheChangeOn) {
  const Film slow = film();
  ASSERT_EQ(slow.frame_count(), 30 + 300 + 4 + 30);  // 3.75 frames of the fast part, then 30
  for (const auto& [k, words] : {std::pair{29, ""},
                                 {30, "0.1\u00D7"},
                                 {329, "0.1\u00D7"},
                                 {330, "8\u00D7"},
                                 {333, "8\u00D7"},
                                 {334, ""},
                                 {363, ""}}) {
    const Picture picture = slow.frame(k);
    const std::string said = test::words_of(picture);
    if (std::string(words).empty())
      EXPECT_THAT(said, Not(HasSubstr("\u00D7"))) << k;
    else
      EXPECT_THAT(said, HasSubstr(words)) << k;
    EXPECT_EQ(boxes(picture).size(), std::string(words).empty() ? 0u : 1u) << k;
  }
}

TEST_F(SlowRr, KeepsTheRunningTimeInItsPlaceBesideTheBox) {
  const Film slow = film();
  const Capsule first = boxes(slow.frame(31)).at(0), second = boxes(slow.frame(332)).at(0);
  EXPECT_EQ(first.a.x, second.a.x);
  EXPECT_EQ(first.b.x, second.b.x);
  EXPECT_EQ(first.a.y, second.a.y);
  const GlyphRun before = time_of(slow.frame(0)), during = time_of(slow.frame(31));
  EXPECT_EQ(before.origin.x, during.origin.x);
  EXPECT_EQ(before.origin.y, during.origin.y);
  EXPECT_EQ(before.text, "t = 0.000 s");
  EXPECT_LT(first.b.x + first.radius, during.origin.x + during.glyphs.front().x) << "they do not touch";
  // The scene keeps its size: the box stands in the footer.
  EXPECT_GE(slow.scene_area().y0, first.a.y + first.radius);
  const Film plain(scene, {{scene, chain, run}}, run.t, fonts());
  EXPECT_EQ(plain.scene_area().y0, slow.scene_area().y0);
  EXPECT_TRUE(boxes(plain.frame(31)).empty());
}

TEST_F(SlowRr, HasABoxWithoutTheTimeButNoneOnNothing) {
  scene.draw = {"chain", "title"};
  EXPECT_EQ(boxes(film().frame(31)).size(), 1u);
  scene.layout = PageLayout::transparent;
  EXPECT_TRUE(boxes(film().frame(31)).empty());
}

// Frames a fifth of a second apart do not say how the way went between them: no trail is made up.
TEST_F(SlowRr, HasNoTrailAcrossFramesThatAreFarApart) {
  const auto trails = [](const Picture& picture) { return test::all_of<Trail>(picture); };
  const Film slow = film();
  EXPECT_EQ(trails(slow.frame(329)).size(), 1u);
  EXPECT_EQ(trails(slow.frame(332)).size(), 0u);
  const auto later = trails(slow.frame(340));
  ASSERT_EQ(later.size(), 1u);
  // It begins anew where the motion passes at its own speed again.
  EXPECT_LT(test::distance(later[0].points.front().p, slow.camera().project([&] {
              const auto q = test::swing(run.t[334]);
              return Eigen::Vector3d(std::cos(q[0]) + std::cos(q[0] + q[1]),
                                     std::sin(q[0]) + std::sin(q[0] + q[1]), 0);
            }())),
            1e-6);
}

}  // namespace
}  // namespace chainreel

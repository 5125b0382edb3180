// Where words stand over a film: off what is drawn, off one another, and without jumps.
#include "draw/page/word_plan.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chainreel {
namespace {

constexpr Rect kPlanArea{0, 0, 1, 1};
constexpr double kPlanFps = 60;
constexpr double kHalfWidth = 0.03, kHalfHeight = 0.02;

Rect box_at(Point middle) {
  return {middle.x - kHalfWidth, middle.y - kHalfHeight, middle.x + kHalfWidth, middle.y + kHalfHeight};
}

MarkWord word_at(const std::string& name, const std::vector<Point>& middles) {
  MarkWord word{name, {}, {}};
  for (const Point p : middles) word.places.push_back(box_at(p));
  return word;
}

Obstacle bar(double x) {
  return {{x, 0}, {x, 1}, 0.01, false};
}

bool lies_on(const StandingWord& word, const Obstacle& obstacle) {
  const Rect wide = widened(word.box, obstacle.radius);
  Point a = obstacle.a, b = obstacle.b;
  return word.opacity > 0 && cut_segment(wide, a, b);
}

TEST(WordPlan, StaysAtTheBestPlaceWhileItIsFree) {
  WordPlan plan(kPlanArea, kPlanFps);
  for (int k = 0; k < 50; ++k) plan.add({word_at("v", {{0.5, 0.5}, {0.2, 0.5}})}, {bar(0.9)});
  for (const auto& frame : plan.standing()) {
    EXPECT_EQ(frame[0].box.x0, 0.5 - kHalfWidth);
    EXPECT_EQ(frame[0].opacity, 1);
  }
}

// A word with a line stands where that crosses nothing, but at its end, where what it speaks of is.
TEST(WordPlan, LinesOfWordsKeepOffWhatIsDrawn) {
  const std::vector<Obstacle> bars{bar(0.35), {{0.48, 0.2}, {0.52, 0.8}, 0.01, false}};
  MarkWord word = word_at("v", {{0.2, 0.5}, {0.8, 0.5}});
  word.leader = Leader{{0.5, 0.5}, {}};
  WordPlan plan(kPlanArea, kPlanFps);
  for (int k = 0; k < 30; ++k) plan.add({word}, bars);
  EXPECT_EQ(plan.standing()[15][0].box.x0, 0.8 - kHalfWidth);
  // Negative control: without that bar it has its best place.
  WordPlan free(kPlanArea, kPlanFps);
  for (int k = 0; k < 30; ++k) free.add({word}, {bars[1]});
  EXPECT_EQ(free.standing()[15][0].box.x0, 0.2 - kHalfWidth);
}

// Words that were asked for come first: others yield to their lines, whichever is drawn above.
TEST(WordPlan, OtherWordsKeepOffLinesOfThoseThatInsist) {
  MarkWord asked = word_at("asked", {{0.5, 0.9}});
  asked.leader = Leader{{0.5, 0.1}, {}};
  const MarkWord name = word_at("name", {{0.5, 0.5}, {0.8, 0.5}});
  for (const bool is_above : {false, true}) {
    WordPlan plan(kPlanArea, kPlanFps);
    for (int k = 0; k < 30; ++k) plan.add(is_above ? std::vector{asked, name} : std::vector{name, asked}, {});
    EXPECT_EQ(plan.standing()[15][is_above ? 1 : 0].box.x0, 0.8 - kHalfWidth) << is_above;
  }
  // Negative control: a word without a line is passed by.
  asked.leader.reset();
  WordPlan free(kPlanArea, kPlanFps);
  for (int k = 0; k < 30; ++k) free.add({asked, name}, {});
  EXPECT_EQ(free.standing()[15][1].box.x0, 0.5 - kHalfWidth);
}

// A bar comes over the best place for a second: the word is elsewhere before it comes, and fades on its way.
TEST(WordPlan, LeavesForWhatComesAndFades) {
  WordPlan plan(kPlanArea, kPlanFps);
  std::vector<Obstacle> bars;
  for (int k = 0; k < 240; ++k) {
    bars.push_back(bar(std::min(0.9, 0.1 + 0.004 * std::max(0, k - 60))));
    plan.add({word_at("v", {{0.5, 0.5}, {0.2, 0.5}})}, {bars.back()});
  }
  const auto frames = plan.standing();
  int elsewhere = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const StandingWord& now = frames[k][0];
    EXPECT_FALSE(lies_on(now, bars[k])) << k;
    elsewhere += now.opacity == 1 && now.box.x0 < 0.3;
    if (k == 0 || frames[k - 1][0].box.x0 == now.box.x0) continue;
    EXPECT_LT(now.opacity, 0.5) << k;
    EXPECT_LT(frames[k - 1][0].opacity, 0.5) << k;
  }
  EXPECT_GT(elsewhere, 10);
  EXPECT_EQ(frames.back()[0].opacity, 1);
}

// A bar is at the best place for one frame. Where another place is free all the time the word stands there from the
// beginning; else it is left out for a moment.
TEST(WordPlan, DoesNotChangePlacesForWhatPassesAtOnce) {
  for (const bool other_is_free : {true, false}) {
    WordPlan plan(kPlanArea, kPlanFps);
    for (int k = 0; k < 120; ++k) {
      std::vector<Obstacle> bars;
      if (k == 100) bars.push_back(bar(0.5));
      if (k > 60 && !other_is_free) bars.push_back(bar(0.2));
      plan.add({word_at("v", {{0.5, 0.5}, {0.2, 0.5}})}, bars);
    }
    const auto frames = plan.standing();
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (k == 100 && !other_is_free) {
        EXPECT_EQ(frames[k][0].opacity, 0);
      } else {
        EXPECT_NEAR(center_of(frames[k][0].box).x, other_is_free ? 0.2 : 0.5, 1e-12) << k;
        EXPECT_GT(frames[k][0].opacity, 0);
      }
    }
  }
}

TEST(WordPlan, KeepsWordsOffOneAnother) {
  WordPlan plan(kPlanArea, kPlanFps);
  for (int k = 0; k < 100; ++k) {
    const double x = 0.3 + 0.004 * k;
    plan.add({word_at("a", {{0.5, 0.5}, {0.5, 0.6}}), word_at("b", {{x, 0.5}, {x, 0.4}})}, {});
  }
  for (const auto& frame : plan.standing()) {
    ASSERT_EQ(frame.size(), 2u);
    if (frame[0].opacity > 0 && frame[1].opacity > 0) {
      EXPECT_FALSE(chainreel::overlap(frame[0].box, frame[1].box));
    }
  }
}

// Of one name, they are told apart by where they are, in whatever order they come.
TEST(WordPlan, FollowsWordsThatComeInAnotherOrder) {
  WordPlan plan(kPlanArea, kPlanFps);
  for (int k = 0; k < 60; ++k) {
    const MarkWord left = word_at("x", {{0.2, 0.5}}), right = word_at("x", {{0.8, 0.5}});
    if (k % 7 < 3)
      plan.add({left, right}, {});
    else
      plan.add({right, left}, {});
  }
  for (const auto& frame : plan.standing())
    for (const StandingWord& word : frame) EXPECT_EQ(word.opacity, 1);
}

TEST(WordPlan, IsSilentWhileItsMarkRunsFasterThanCanBeRead) {
  WordPlan plan(kPlanArea, kPlanFps);
  double x = 0.1;
  for (int k = 0; k < 90; ++k) {
    x += k >= 30 && k < 40 ? 0.05 : 0.002;
    plan.add({word_at("v", {{x, 0.5}})}, {});
  }
  const auto frames = plan.standing();
  EXPECT_EQ(frames[10][0].opacity, 1);
  for (std::size_t k = 31; k < 39; ++k) EXPECT_EQ(frames[k][0].opacity, 0) << k;
  EXPECT_EQ(frames[70][0].opacity, 1);
}

// The same run is none for a word that rides along with its mark, as long as an eye can follow that.
TEST(WordPlan, RidesAlongWithItsMark) {
  for (const double step : {0.05, 0.11}) {
    WordPlan plan({0, 0, 3, 1}, kPlanFps);
    double x = 0.1;
    for (int k = 0; k < 90; ++k) {
      x += k >= 30 && k < 40 ? step : 0.002;
      MarkWord word = word_at("v", {{x, 0.5}});
      word.anchor = Point{x - 0.04, 0.5};
      plan.add({word}, {});
    }
    const auto frames = plan.standing();
    for (std::size_t k = 31; k < 39; ++k) EXPECT_EQ(frames[k][0].opacity, step < kAnchorStep ? 1 : 0) << k;
  }
  // It may not run about its anchor.
  WordPlan plan(kPlanArea, kPlanFps);
  for (int k = 0; k < 90; ++k) {
    MarkWord word = word_at("v", {{k < 45 ? 0.3 : 0.4, 0.5}});
    word.anchor = Point{0.35, 0.5};
    plan.add({word}, {});
  }
  EXPECT_LT(plan.standing()[45][0].opacity, 0.5);
}

// What is free for less than 0.3 s is no place, but at the first frame and the last one, which stand longer.
TEST(WordPlan, DoesNotFlicker) {
  const auto shown = [](int from, int to) {
    WordPlan plan(kPlanArea, kPlanFps);
    for (int k = 0; k < 120; ++k) plan.add({word_at("v", {{0.5, 0.5}})}, {bar(k >= from && k < to ? 0.9 : 0.5)});
    int frames = 0;
    for (const auto& words : plan.standing()) frames += words[0].opacity > 0;
    return frames;
  };
  EXPECT_EQ(shown(50, 67), 0);
  EXPECT_EQ(shown(50, 68), 18);
  EXPECT_EQ(shown(0, 10), 10);
  EXPECT_EQ(shown(110, 120), 10);
}

TEST(WordPlan, LinesOfWordsKeepOffOtherWords) {
  for (const bool has_line : {true, false}) {
    MarkWord far = word_at("far", {{0.8, 0.5}});
    if (has_line) far.tie = Tie{{0.1, 0.5}, 0, {}};
    WordPlan plan(kPlanArea, kPlanFps);
    for (int k = 0; k < 30; ++k) plan.add({word_at("near", {{0.4, 0.5}, {0.4, 0.8}}), far}, {});
    EXPECT_NEAR(center_of(plan.standing()[15][0].box).y, has_line ? 0.8 : 0.5, 1e-12);
  }
}

// A name whose tie costs stands near what it names, and goes while something passes; one whose tie does not stands far from it all along.
TEST(WordPlan, WordsWhoseTiesCostStandNearAndGoWhileSomethingPasses) {
  for (const double cost : {0.0, 30.0}) {
    MarkWord word = word_at("tau", {{0.5, 0.5}, {0.8, 0.5}});
    word.tie = Tie{{0.42, 0.5}, 0.05, {}, {}, 0.018};
    word.tie->cost = cost;
    WordPlan plan(kPlanArea, kPlanFps);
    for (int k = 0; k < 200; ++k) plan.add({word}, {bar(k % 50 >= 20 && k % 50 < 32 ? 0.5 : 0.1)});
    int near = 0, far = 0;
    for (const auto& frame : plan.standing())
      if (frame[0].opacity > 0) ++(frame[0].box.x0 < 0.5 ? near : far);
    EXPECT_EQ(near, cost > 0 ? 4 * 38 : 0) << cost;
    EXPECT_EQ(far, cost > 0 ? 0 : 200) << cost;
  }
}

TEST(WordPlan, StandsOnWhatMayYieldWhereNothingElseIsFree) {
  Obstacle rail = bar(0.5);
  rail.may_yield = true;
  for (const bool other_is_free : {true, false}) {
    WordPlan plan(kPlanArea, kPlanFps);
    for (int k = 0; k < 60; ++k)
      plan.add({word_at("tau", {{0.5, 0.5}, {0.2, 0.5}})}, {rail, bar(other_is_free ? 0.8 : 0.2)});
    const auto frames = plan.standing();
    EXPECT_NEAR(center_of(frames[30][0].box).x, other_is_free ? 0.2 : 0.5, 1e-12);
    EXPECT_EQ(frames[30][0].opacity, 1);
  }
}

TEST(WordPlan, TellsWhatIsInTheWay) {
  Picture picture;
  const Color ink = color_of(0);
  picture.add(Capsule{{0, 0}, {1, 0}, 0.01, {ink, {}, 0}});
  picture.add(Capsule{{0, 0}, {1, 0}, 0.01, {ink.faded(0.2), {}, 0}});  // pale
  picture.add(Polygon{{Point{0, 0}, {1, 0}, {0, 1}}, 3, {ink, {}, 0}});
  picture.add(Ellipse{{0.5, 0.5}, {0.1, 0}, {0, 0.1}, {ink, {}, 0}});
  EXPECT_EQ(obstacles_of(picture).size(), 1u + 6u + 1u);
}

// A long film is planned by stretches. Bars come over both places again and again, also where one stretch ends: everywhere the word
// keeps off them and fades before it goes.
TEST(WordPlan, KeepsItsPromisesWhereStretchesMeet) {
  constexpr int kFrames = 6000, kPeriod = 137;  // the seams meet all of its phases
  WordPlan plan(kPlanArea, kPlanFps);
  const MarkWord word = word_at("v", {{0.5, 0.5}, {0.2, 0.5}});
  std::vector<Obstacle> bars;
  for (int k = 0; k < kFrames; ++k) {
    bars.push_back(bar(0.1 + 0.5 * std::abs(std::sin(std::numbers::pi * k / kPeriod))));
    plan.add({word}, {bars.back()});
  }
  const PlannedWords planned = plan.planned();
  int shown = 0, moves = 0;
  StandingWord before = standing_at(word, planned.at(0)[0], kPlanArea);
  for (int k = 0; k < kFrames; ++k) {
    const StandingWord now = standing_at(word, planned.at(k)[0], kPlanArea);
    EXPECT_FALSE(lies_on(now, bars[std::size_t(k)])) << k;
    EXPECT_LE(std::abs(now.opacity - before.opacity), 0.251) << k << ": fades take seven frames";
    const bool is_moved = now.opacity > 0 && before.opacity > 0 && now.box.x0 != before.box.x0;
    if (is_moved) EXPECT_LT(std::max(now.opacity, before.opacity), 0.5) << k;
    moves += is_moved;
    shown += now.opacity > 0;
    before = now;
  }
  EXPECT_GT(moves, 2 * kFrames / kPeriod - 3) << "negative control: it had to move all the time";
  EXPECT_GT(shown, kFrames / 2);
}

// What comes behind a stretch counts within it: the word is gone from where a bar will be before that is decided.
TEST(WordPlan, OfOneStretchIsThatOfAll) {
  constexpr int kFrames = 1500;
  WordPlan plan(kPlanArea, kPlanFps);
  const MarkWord word = word_at("v", {{0.5, 0.5}, {0.2, 0.5}});
  for (int k = 0; k < kFrames; ++k) plan.add({word}, {bar(0.1 + 0.5 * std::abs(std::sin(0.01 * k)))});
  const auto standing = plan.standing();
  const PlannedWords planned = plan.planned();
  for (int k = 0; k < kFrames; ++k) {
    const StandingWord now = standing_at(word, planned.at(k)[0], kPlanArea);
    ASSERT_EQ(now.opacity, float(standing[std::size_t(k)][0].opacity)) << k;
    if (now.opacity > 0) ASSERT_EQ(now.box.x0, standing[std::size_t(k)][0].box.x0) << k;
  }
}

}  // namespace
}  // namespace chainreel

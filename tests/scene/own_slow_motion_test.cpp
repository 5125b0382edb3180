// Slow motion that films have by themselves: eased stretches, the rule that finds them, and the key that sets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scene/slow_motion.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr FrameRate kTen{10, 1};
const double kDegree = std::numbers::pi / 180;

// Over 0.5 s of the motion the speed falls evenly from 1 to 0.5, which takes 0.5 / 0.75 s of the film.
TEST(EasedStretch, ChangesItsSpeedEvenlyInFilmTime) {
  const FilmClock clock(10, {1000, 1}, {{2, 5, 0.5, 0.5}});
  const double ramp = 0.5 / 0.75;
  EXPECT_NEAR(clock.film_seconds(), 7 + 2 * ramp + 2 / 0.5, 1e-12);
  EXPECT_EQ(clock.speed_at(1.999), 1);
  EXPECT_EQ(clock.speed_at(2), 1) << "it begins without a jump";
  EXPECT_EQ(clock.speed_at(2.5), 0.5);
  EXPECT_EQ(clock.speed_at(4.4), 0.5);
  EXPECT_EQ(clock.speed_at(5), 1);
  EXPECT_NEAR(clock.film_time(2.5), 2 + ramp, 1e-12);
  EXPECT_NEAR(clock.film_time(4.5), 2 + ramp + 4, 1e-12);
  // Half of the way in film time: the speed is half of the way, too.
  EXPECT_NEAR(clock.speed_at(clock.time_of_frame(int(std::lround(1000 * (2 + ramp / 2))))), 0.75, 1e-3);
  // Steps of frames shrink and grow by a little at a time.
  const std::vector<double> times = clock.frame_times();
  for (std::size_t k = 2; k < times.size(); ++k)
    EXPECT_LT(std::abs(times[k] - 2 * times[k - 1] + times[k - 2]), 0.001 * 0.5 / (1000 * ramp) * 1.01) << k;
}

TEST(EasedStretch, FilmTimeIsTheInverseOfTheMotions) {
  const FilmClock clock(10, {60, 1}, {{2, 3, 0.25, 0.2}, {6, kInfinity, 0.001, 1}, {0, 1, 4, 0.3}}, {{2.1, 0.5}, {2.95, 0.25}, {6.5, 1}});
  for (int k = 0; k < clock.frame_count(); k += 7) {
    const double t = clock.time_of_frame(k);
    const bool stands = t == 2.1 || t == 2.95 || t == 6.5;
    EXPECT_LE(clock.film_time(t), k / 60.0 + 1e-9) << k;
    if (!stands) {
      EXPECT_NEAR(clock.film_time(t), k / 60.0, 1e-9) << k;
      EXPECT_EQ(clock.frame_at(t + 1e-12), k);
    }
  }
}

TEST(EasedStretch, IsNotEasedAtTheEndsOfTheMotion) {
  const FilmClock clock(10, kTen, {{-1, 1, 0.5, 0.4}, {9, kInfinity, 0.5, 0.4}});
  EXPECT_EQ(clock.speed_at(0), 0.5);
  EXPECT_EQ(clock.speed_at(9.9), 0.5);
  EXPECT_THAT(clock.stretches(), ElementsAre(Stretch{0, 1, 0.5, 0.4}, Stretch{9, 10, 0.5, 0.4}));
  EXPECT_EQ(clock.stretch_at(1), nullptr);
  EXPECT_EQ(clock.stretch_at(9.95)->from, 9);
}

TEST(EasedStretch, TooShortForBothEasesIsAllEase) {
  const FilmClock clock(10, kTen, {{2, 3, 0.25, 7}});
  EXPECT_NEAR(clock.film_seconds(), 9 + 1 / 0.625, 1e-12);
  EXPECT_NEAR(clock.speed_at(2.5), 0.25, 1e-12);
  EXPECT_EQ(clock.shortest_step(), 0.025);
}

const SlowMotionRule kRule;
// That of a scene that asks for it, which long motions may be slowed by.
const SlowMotionRule kAsked{.is_asked = true};

Haste event_at(double t, const char* name = "touch") {
  return {t, t, false, {name}};
}
Haste turn_of(double from, double until) {
  return {from, until, true, {}};
}

TEST(OwnSlowMotion, IsAroundWhatAsksForIt) {
  EXPECT_THAT(stretches_by(kRule, 10, {}, {}), IsEmpty());
  const auto all = stretches_by(kAsked, 12, {event_at(2)}, {turn_of(5, 5.5)});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], (Stretch{1.8, 2.2, 0.25, 0.1, "'touch'"}));
  EXPECT_NEAR(all[1].from, 4.8, 1e-12);
  EXPECT_NEAR(all[1].until, 5.7, 1e-12);
  EXPECT_EQ(all[1].cause, "a link turns more than 15 degrees a frame");
}

TEST(OwnSlowMotion, OfWhatLiesNearIsOne) {
  // 0.2 s around each, and less than 0.4 s between: at 2.79 s, not at 2.81 s.
  const auto near = stretches_by(kAsked, 13, {event_at(2), event_at(2.79, "off")}, {turn_of(2, 2.1)});
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NEAR(near[0].until, 2.99, 1e-12);
  EXPECT_EQ(near[0].cause, "'touch', 'off', a link turns more than 15 degrees a frame");
  EXPECT_EQ(stretches_by(kAsked, 10, {event_at(2), event_at(2.81)}, {}).size(), 2u);
}

TEST(OwnSlowMotion, ReachesToTheEndsOfTheMotion) {
  const auto all = stretches_by(kAsked, 10, {event_at(0.1), event_at(9.95)}, {});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].from, 0);
  EXPECT_EQ(all[1].until, kInfinity) << "an event that ends a run leaves nothing behind it to speed up for";
}

TEST(OwnSlowMotion, OfShortMotionsIsShort) {
  // 1 s: a tenth of it.
  EXPECT_EQ(stretches_by(kRule, 1, {event_at(0.5)}, {}), (std::vector<Stretch>{{0.4, 0.6, 0.25, 0.05, "'touch'"}}));
  SlowMotionRule rule;
  rule.around = 0.25;
  EXPECT_EQ(stretches_by(rule, 2, {event_at(0.5)}, {}), (std::vector<Stretch>{{0.25, 0.75, 0.25, 0.125, "'touch'"}}));
}

// Two seconds, or twice as long; nothing beyond six seconds.
TEST(OwnSlowMotion, AddsTwoSecondsAtMostToShortMotionsAndNothingToOthers) {
  EXPECT_EQ(longest_film(20), 20);
  EXPECT_EQ(longest_film(6.001), 6.001);
  EXPECT_EQ(longest_film(6), 8);
  EXPECT_THAT(stretches_by(kRule, 8, {event_at(2)}, {turn_of(0, 8)}), IsEmpty());
  EXPECT_EQ(longest_film(5), 7);
  EXPECT_EQ(longest_film(2), 4);
  EXPECT_EQ(longest_film(1), 2);
  EXPECT_EQ(longest_film(20, true), 40) << "whoever sets its numbers wants it";
}

// Whatever asks, the film is no longer than that.
TEST(OwnSlowMotion, NeverMakesAFilmSeveralTimesLonger) {
  const auto film = [](const std::vector<Haste>& events, const std::vector<Haste>& turns) {
    return FilmClock(6, kTen, stretches_by(kRule, 6, events, turns)).film_seconds();
  };
  // All the time from the start on: what turns as fast all along is not seen to speed up, and keeps its speed; about events it is slow all the
  // same. What becomes fast is slow where that begins, for as long as it may.
  EXPECT_THAT(stretches_by(kRule, 6, {}, {turn_of(0, 6)}), IsEmpty());
  EXPECT_NEAR(film({}, {turn_of(2, 5.5)}), 8, 1e-9);
  EXPECT_EQ(stretches_by(kRule, 6, {event_at(3)}, {turn_of(0, 6)}).size(), 1u);
  // Briefly: as long as there is room for.
  EXPECT_NEAR(film({}, {turn_of(2, 2.8)}), 8, 1e-9);
  EXPECT_LT(film({}, {turn_of(2, 2.1)}), 8);
  std::vector<Haste> many;
  for (int i = 0; i < 11; ++i) many.push_back(event_at(0.5 + 0.5 * i, std::to_string(i).c_str()));
  EXPECT_LE(film(many, {}), 8);
  EXPECT_GT(film(many, {}), 7) << "as many as there is room for";
  std::vector<Haste> turns;
  for (int i = 0; i < 5; ++i) turns.push_back(turn_of(1 + i, 1.1 + i));
  EXPECT_LE(film({}, turns), 8);
}

TEST(OwnSlowMotion, AboutEventsComesFirst) {
  const auto all = stretches_by(kAsked, 10, {event_at(9)}, {turn_of(0, 5)});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_LT(all[0].until, 5);
  EXPECT_EQ(all[1].cause, "'touch'");
}

class SlowMotionKey : public WrittenScenes {};

TEST_F(SlowMotionKey, IsAutoNoneNumbersOrStretches) {
  const auto again = [&](const std::string& text) { return scene_text(read(text)); };
  const Scene plain = read("");
  ASSERT_TRUE(plain.slow_motion_rule);
  EXPECT_FALSE(plain.slow_motion_rule->is_asked);
  EXPECT_EQ(plain.slow_motion_rule->speed, 0.25);
  EXPECT_EQ(plain.slow_motion_rule->turn, 15 * kDegree);
  EXPECT_THAT(again(""), HasSubstr("\nslow_motion: auto\n"));
  EXPECT_THAT(again("slow_motion: auto\n"), HasSubstr("\nslow_motion: auto\n"));
  for (const char* none : {"none", "[]"}) {
    const Scene scene = read(std::string("slow_motion: ") + none + "\n");
    EXPECT_FALSE(scene.slow_motion_rule) << none;
    EXPECT_TRUE(scene.slow_motion.empty());
    EXPECT_THAT(scene_text(scene), HasSubstr("\nslow_motion: none\n"));
  }
  EXPECT_FALSE(read("slow_motion: [{from: 1, until: 2, speed: 0.5}]\n").slow_motion_rule) << "nothing but what is asked for";
  const Scene own = read("slow_motion: {speed: 0.1, turn: 30deg, around: 0.5s}\n");
  EXPECT_TRUE(own.slow_motion_rule->is_asked);
  EXPECT_EQ(own.slow_motion_rule->speed, 0.1);
  EXPECT_NEAR(own.slow_motion_rule->turn, 30 * kDegree, 1e-15);
  EXPECT_EQ(own.slow_motion_rule->around, 0.5);
  const std::string written = scene_text(own);
  EXPECT_THAT(written, HasSubstr("\nslow_motion: {speed: 0.1, turn: 0.52359877559829"));
  EXPECT_TRUE(read("slow_motion: {}\n").slow_motion_rule->is_asked);
}

TEST_F(SlowMotionKey, SaysWhatIsWrong) {
  const auto wrong = [&](const std::string& value) { return error("slow_motion: " + value + "\n"); };
  for (const char* value : {"off", "2", "false", "automatic", "\"\""})
    EXPECT_THAT(wrong(value), HasSubstr("one.yaml:2:14: 'slow_motion' must be auto, none, numbers")) << value;
  EXPECT_THAT(wrong("{speed: 1}"), HasSubstr("'slow_motion.speed' must lie between 0.001 and 0.9"));
  EXPECT_THAT(wrong("{turn: 15}"), HasSubstr("'slow_motion.turn' must lie above 0deg and up to 180deg"));
  EXPECT_THAT(wrong("{turn: 0}"), HasSubstr("'slow_motion.turn' must lie above"));
  EXPECT_THAT(wrong("{around: 0}"), HasSubstr("'slow_motion.around' must lie above 0 and up to 1000 s"));
  EXPECT_THAT(wrong("{around: long}"), HasSubstr("seconds are wanted, like 1.5s"));
  EXPECT_THAT(wrong("{factor: 0.5}"), HasSubstr("unknown key 'slow_motion.factor'"));
  EXPECT_THAT(error("compare: [{slow_motion: none}, {}]\n"), HasSubstr("'slow_motion' belongs to the whole picture"));
}

}  // namespace
}  // namespace chainreel

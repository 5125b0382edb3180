// `slow_motion:`: how it is read and written, and which instant each frame shows.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/film_clock.hpp"
#include "scene/text/scene_paths.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr FrameRate kTen{10, 1};

// 0.5 s, then 0.5 s at a quarter (2 s), 0.5 s, 1 s four times as fast (0.25 s), 0.5 s: 3.75 s of film.
FilmClock three_stretches() {
  return {3, kTen, {{1.5, 2.5, 4}, {0.5, 1, 0.25}}};
}

TEST(FilmClock, OfNoStretchIsThePlainOneToTheLastBit) {
  const FrameRate ntsc{30000, 1001};
  const FilmClock clock(7.3, ntsc);
  EXPECT_TRUE(clock.is_plain());
  ASSERT_EQ(clock.frame_count(), frame_count(7.3, ntsc));
  for (int k = 0; k < clock.frame_count(); ++k) {
    EXPECT_EQ(clock.time_of_frame(k), frame_time(k, ntsc));
    EXPECT_EQ(clock.frame_at(frame_time(k, ntsc)), k);
  }
  EXPECT_EQ(clock.film_seconds(), 7.3);
  EXPECT_EQ(clock.speed_at(3), 1);
  EXPECT_EQ(FilmClock().speed_at(3), 1);
}

TEST(FilmClock, IsTheIntegralOfOneOverTheSpeed) {
  const FilmClock clock = three_stretches();
  EXPECT_NEAR(clock.film_seconds(), 3.75, 1e-15 * 8);
  EXPECT_EQ(clock.frame_count(), 38) << "37.5, and half a frame counts";
  for (const auto& [t, film] : {std::pair{0.0, 0.0},
                                {0.4, 0.4},
                                {0.6, 0.9},
                                {1.0, 2.5},
                                {1.2, 2.7},
                                {1.9, 3.1},
                                {2.5, 3.25},
                                {2.9, 3.65}})
    EXPECT_NEAR(clock.film_time(t), film, 1e-14) << t;
  // Frames by hand: the last one before and the first one in each part.
  for (const auto& [k, t] : {std::pair{4, 0.4},
                             {5, 0.5},
                             {6, 0.525},
                             {24, 0.975},
                             {25, 1.0},
                             {26, 1.1},
                             {30, 1.5},
                             {31, 1.9},
                             {32, 2.3},
                             {33, 2.55},
                             {37, 2.95}})
    EXPECT_NEAR(clock.time_of_frame(k), t, 1e-14) << k;
}

TEST(FilmClock, ChangesItsSpeedOnOneFrame) {
  const FilmClock clock = three_stretches();
  const std::vector<double> times = clock.frame_times();
  for (int k = 0; k < clock.frame_count(); ++k) {
    const double speed = k < 5 ? 1 : k < 25 ? 0.25 : k < 30 ? 1 : k < 33 ? 4 : 1;
    EXPECT_EQ(clock.speed_at(times[std::size_t(k)]), speed) << k;
    EXPECT_EQ(clock.frame_at(times[std::size_t(k)]), k);
    if (k > 0) {
      EXPECT_LT(times[std::size_t(k) - 1], times[std::size_t(k)]);
    }
  }
  EXPECT_EQ(clock.frame_at(0.9749), 23);
}

// Bounds that no binary number hits: frame 6 n stands on 0.1 n all the same.
TEST(FilmClock, AFrameThatStandsOnAChangeBelongsToTheNewSpeed) {
  for (int n = 1; n < 40; ++n) {
    const FilmClock clock(10, {60, 1}, {{0.1 * n, 0.1 * n + 0.3, 0.1}});
    EXPECT_EQ(clock.time_of_frame(6 * n), 0.1 * n);
    EXPECT_EQ(clock.speed_at(clock.time_of_frame(6 * n)), 0.1);
    EXPECT_EQ(clock.speed_at(clock.time_of_frame(6 * n - 1)), 1);
    EXPECT_EQ(clock.speed_at(clock.time_of_frame(6 * n + 179)), 0.1);
    EXPECT_EQ(clock.speed_at(clock.time_of_frame(6 * n + 180)), 1) << "0.3 s last 180 frames";
  }
}

TEST(FilmClock, WhereStretchesOverlapTheSlowestHolds) {
  const FilmClock clock(10, kTen, {{1, 3, 0.5}, {2, 4, 0.25}, {3.5, 6, 4}, {-1, 0.5, 0.5}, {9, 12, 0.5}});
  EXPECT_THAT(clock.stretches(), ElementsAre(Stretch{0, 0.5, 0.5}, Stretch{1, 2, 0.5}, Stretch{2, 4, 0.25},
                                             Stretch{4, 6, 4}, Stretch{9, 10, 0.5}));
  EXPECT_NEAR(clock.film_seconds(), 1 + 0.5 + 2 + 8 + 0.5 + 3 + 2, 1e-13);
  EXPECT_EQ(clock.shortest_step(), 0.025);
}

TEST(FilmClock, FollowsEveryInstantOfItsEvent) {
  const std::vector<EventEntry> events{{"q1", {}, "touch", {}, {}}, {"q2 > 1", {}, "", {}, {}}};
  EventHits hits;
  const double nothing[] = {0.0};
  for (const auto& [event, t] : {std::pair{0, 1.0}, {1, 1.5}, {0, 3.0}}) hits.add(event, t, nothing, nothing);
  const std::vector<Stretch> around =
      stretches_of({{"touch", -0.25, 0.5, 0.1}, {"", 5, 6, 2}, {"q2 > 1", 0, 0.25, 0.5}}, events, hits);
  EXPECT_THAT(around, ElementsAre(Stretch{0.75, 1.5, 0.1}, Stretch{2.75, 3.5, 0.1}, Stretch{5, 6, 2},
                                  Stretch{1.5, 1.75, 0.5}));
}

class SlowMotion : public WrittenScenes {};

constexpr char kEvents[] = "events: [{when: \"q1 < 0\", name: touch}, {when: q2}]\n";

TEST_F(SlowMotion, IsReadAndWritten) {
  EXPECT_TRUE(read("").slow_motion.empty());
  const std::string text =
      std::string(kEvents) +
      "slow_motion: [{from: 1s, until: 1.5 s, speed: 0.25}, {from: 2, until: 5/2, speed: 4}, "
      "{event: touch, from: -0.2s, until: 0.3, speed: 0.1}]\n";
  Scene scene = read(text);
  ASSERT_EQ(scene.slow_motion.size(), 3u);
  EXPECT_EQ(scene.slow_motion[0].until, 1.5);
  EXPECT_EQ(scene.slow_motion[1].until, 2.5);
  EXPECT_EQ(scene.slow_motion[2].event, "touch");
  EXPECT_EQ(scene.slow_motion[2].from, -0.2);
  scene.model = "rr.urdf";
  for (const std::string& written : {scene_text(scene), moved_scene_text(scene_text(scene), ".")}) {
    const Scene again = read_scene(folder_.write("again.yaml", written));
    ASSERT_EQ(again.slow_motion.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(again.slow_motion[i].event, scene.slow_motion[i].event);
      EXPECT_EQ(again.slow_motion[i].from, scene.slow_motion[i].from);
      EXPECT_EQ(again.slow_motion[i].until, scene.slow_motion[i].until);
      EXPECT_EQ(again.slow_motion[i].speed, scene.slow_motion[i].speed);
    }
  }
}

TEST_F(SlowMotion, BelongsToThePageOfAComparison) {
  const std::string panels = "compare: [{method: rk4}, {method: explicit_euler}]\n";
  const std::string slow = "slow_motion: [{event: touch, from: 0, until: 1, speed: 0.5}]\n";
  const Scene scene = read(kEvents + slow + panels);
  EXPECT_EQ(scene.slow_motion.size(), 1u);
  EXPECT_THAT(scene_text(scene),
              HasSubstr("\nslow_motion: [{event: \"touch\", from: 0, until: 1, speed: 0.5}]\n"));
  EXPECT_THAT(error(std::string(kEvents) + "compare: [{slow_motion: []}, {}]\n"),
              HasSubstr("'slow_motion' belongs to the whole picture"));
}

TEST_F(SlowMotion, FollowsTheEventsOfTheFirstPanelAlone) {
  const std::string page = "slow_motion: [{event: touch, from: 0, until: 1, speed: 0.5}]\n";
  const std::string with = "events: [{when: \"q1 > 1\", name: touch}]", without = "events: []";
  EXPECT_EQ(error(page + "compare: [{" + with + "}, {" + without + "}]\n"), "");
  EXPECT_THAT(error(page + "compare: [{" + without + "}, {" + with + "}]\n"), HasSubstr("names 'touch'"));
}

TEST_F(SlowMotion, SaysWhatIsWrong) {
  const auto wrong = [&](const std::string& list) {
    return error(std::string(kEvents) + "slow_motion: " + list + "\n");
  };
  EXPECT_EQ(wrong("[{from: 9, until: 11, speed: 1}]"), "") << "what lies behind the end is cut";
  EXPECT_THAT(wrong("2"), HasSubstr("{speed: 0.25, turn: 15deg}, or a list of stretches: [{from: 1s"));
  EXPECT_THAT(wrong("[2]"), HasSubstr("'slow_motion.1' must be a stretch like {from: 1s"));
  EXPECT_THAT(wrong("[{from: 1, until: 2}]"),
              HasSubstr("one.yaml:3:15: 'slow_motion.1' needs `speed`: {from: 1s"));
  EXPECT_THAT(wrong("[{until: 2, speed: 2}]"), HasSubstr("needs `from`"));
  EXPECT_THAT(
      wrong("[{from: 2, until: 1, speed: 2}]"),
      HasSubstr("one.yaml:3:22: 'slow_motion.1.from' must lie before `until`: 2 s is not before 1 s"));
  EXPECT_THAT(wrong("[{from: soon, until: 1, speed: 2}]"), HasSubstr("seconds are wanted, like 1.5s"));
  EXPECT_THAT(wrong("[{from: -1, until: 1, speed: 2}]"),
              HasSubstr("seconds before an event go with `event: NAME`"));
  EXPECT_THAT(wrong("[{from: 10, until: 11, speed: 2}]"), HasSubstr("behind the end of the motion, 10 s"));
  for (const char* speed : {"0", "-1", "0.0009", "1001", "slow"})
    EXPECT_THAT(wrong("[{from: 0, until: 1, speed: " + std::string(speed) + "}]"),
                HasSubstr("'slow_motion.1.speed'"));
  EXPECT_THAT(wrong("[{from: 0, until: 1, speed: 0}]"), HasSubstr("must lie between 0.001 and 1000"));
  EXPECT_THAT(
      wrong("[{event: tuch, from: 0, until: 1, speed: 2}]"),
      HasSubstr("'slow_motion.1.event' names 'tuch', but no entry of 'events' has that name: did you mean "
                "'touch'? There are 'touch', 'q2'."));
  EXPECT_EQ(wrong("[{event: q2, from: 0, until: 1, speed: 2}]"), "");
  EXPECT_THAT(error("slow_motion: [{event: touch, from: 0, until: 1, speed: 2}]\n"),
              HasSubstr("names 'touch', but the scene has no 'events'"));
  EXPECT_THAT(wrong("[{from: 0, until: 1, sped: 2}]"), HasSubstr("unknown key 'slow_motion.1.sped'"));
  EXPECT_THAT(wrong("[{from: 1, until: 2, speed: 2}, {from: 0, until: 1.5, speed: 0.5}]"),
              HasSubstr("overlap: 0 to 1.5 s and 1 to 2 s; let one end where the next begins"));
  EXPECT_EQ(wrong("[{from: 1, until: 2, speed: 2}, {from: 0, until: 1, speed: 0.5}]"), "");
  EXPECT_THAT(error("duration: 1000\nslow_motion: [{from: 0, until: 1000, speed: 0.001}]\n"),
              HasSubstr("more than ten million frames"));
  EXPECT_THAT(error("duration: 5\nslow_motion: [{from: 0, until: 5, speed: 1000}]\n"),
              HasSubstr("less than half a frame"));
}

}  // namespace
}  // namespace chainreel

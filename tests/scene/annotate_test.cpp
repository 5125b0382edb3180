// `annotate:`: how it is read and written, and how the clock stands still for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/film_clock.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

TEST(FilmClockWithPauses, StandsStillAndGoesOnWhereItWas) {
  const FilmClock clock(2, {10, 1}, {}, {{0.5, 1}});
  EXPECT_FALSE(clock.is_plain());
  EXPECT_TRUE(clock.stretches().empty()) << "a pause is no slow motion";
  EXPECT_EQ(clock.film_seconds(), 3);
  ASSERT_EQ(clock.frame_count(), 30);
  for (int k = 0; k < 30; ++k)
    EXPECT_NEAR(clock.time_of_frame(k), k < 5 ? 0.1 * k : k < 15 ? 0.5 : 0.1 * k - 1, 1e-14) << k;
  EXPECT_EQ(clock.film_time(0.5), 0.5) << "when it comes there";
  EXPECT_NEAR(clock.film_time(0.6), 1.6, 1e-14);
  EXPECT_EQ(clock.frame_at(0.5), 15) << "the last frame not later";
  EXPECT_EQ(clock.shortest_step(), 0.1);
}

TEST(FilmClockWithPauses, HoldsAtBothEndsAndWithinSlowMotion) {
  const FilmClock clock(2, {10, 1}, {{1, 1.5, 0.5}}, {{2, 0.5}, {0, 0.3}, {1.25, 1}, {3, 7}, {1, 0}});
  EXPECT_NEAR(clock.film_seconds(), 2.5 + 0.3 + 1 + 0.5, 1e-14) << "what lies outside, or lasts no time, is none";
  EXPECT_EQ(clock.time_of_frame(0), 0);
  EXPECT_EQ(clock.time_of_frame(3), 0);
  EXPECT_EQ(clock.time_of_frame(clock.frame_count() - 1), 2);
  EXPECT_NEAR(clock.film_time(1.25), 0.3 + 1 + 0.5, 1e-14);
  EXPECT_EQ(clock.speed_at(1.3), 0.5) << "it goes on as slowly as before";
  const std::vector<double> times = clock.frame_times();
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
}

TEST(FilmClockWithPauses, ComeWithTheFirstOfTheirEvents) {
  const std::vector<EventEntry> events{{"q1", {}, "touch", {}, {}}, {"q2", {}, "", {}, {}}};
  EventHits hits;
  const double nothing[] = {0.0};
  for (const double t : {1.0, 3.0}) hits.add(0, t, nothing, nothing);
  AnnotationEntry touch, never;
  touch.event = "touch";
  touch.hold = 0.5;
  never.event = "q2";
  const std::vector<Pause> pauses = pauses_of({touch, never}, {{&events, &hits}});
  ASSERT_EQ(pauses.size(), 1u);
  EXPECT_EQ(pauses[0].at, 1);
  EXPECT_EQ(pauses[0].seconds, 0.5);
}

// Words of a comparison's panel go with that panel's run.
TEST(FilmClockWithPauses, ComeWithTheEventsOfTheirPanel) {
  const std::vector<EventEntry> events{{"q1", {}, "touch", {}, {}}};
  EventHits early, late, never;
  const double nothing[] = {0.0};
  early.add(0, 1, nothing, nothing);
  late.add(0, 2.5, nothing, nothing);
  AnnotationEntry entry;
  entry.event = "touch";
  entry.panel = 2;
  EXPECT_EQ(instant_of(entry, {{&events, &early}, {&events, &late}}), 2.5);
  EXPECT_EQ(instant_of(entry, {{&events, &early}, {&events, &never}}), std::nullopt);
  EXPECT_EQ(instant_of(entry, {{&events, &early}}), std::nullopt);
}

class Annotate : public WrittenScenes {};

constexpr char kTouch[] = "events: [{when: \"q1 < 0\", name: touch}]\n";

TEST_F(Annotate, IsReadAndWritten) {
  const std::string text = std::string(kTouch) +
                           "annotate: [{at: 1.2s, text: \"along $Lambda$\", point: gripper, hold: 1s}, "
                           "{event: touch, text: it turns, point: [0.2, -0.5]}]\n";
  Scene scene = read(text);
  scene.model = "rr.urdf";
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)));
  for (const Scene& one : {scene, again}) {
    ASSERT_EQ(one.annotate.size(), 2u);
    EXPECT_EQ(one.annotate[0].at, 1.2);
    EXPECT_EQ(one.annotate[0].text, "along $Lambda$");
    EXPECT_EQ(one.annotate[0].point, "gripper");
    EXPECT_EQ(one.annotate[0].hold, 1);
    EXPECT_EQ(one.annotate[1].event, "touch");
    EXPECT_EQ(one.annotate[1].hold, 2);
    EXPECT_THAT(one.annotate[1].spot, testing::ElementsAre(0.2, -0.5));
  }
  EXPECT_EQ(read(text + "compare: [{method: rk4}, {events: [], method: dop853}]\n").annotate.size(), 2u)
      << "of the page, with the first panel's events";
}

TEST_F(Annotate, SaysWhatIsWrong) {
  const auto wrong = [&](const std::string& entry) { return error(std::string(kTouch) + "annotate: [" + entry + "]\n"); };
  EXPECT_EQ(wrong("{at: 1, text: a, point: gripper}"), "");
  EXPECT_THAT(error("annotate: 3\n"), HasSubstr("one.yaml:2:11: 'annotate' must be a list of entries"));
  EXPECT_THAT(wrong("3"), HasSubstr("'annotate.1' must be an entry like {at: 1.2s"));
  EXPECT_THAT(wrong("{text: a, point: gripper}"), HasSubstr("'annotate.1.at' is missing: say when"));
  EXPECT_THAT(wrong("{at: 1, event: touch, text: a, point: gripper}"), HasSubstr("both say when"));
  EXPECT_THAT(wrong("{at: 11, text: a, point: gripper}"), HasSubstr("is 11 s, but the motion goes from 0 to 10 s"));
  EXPECT_THAT(wrong("{at: soon, text: a, point: gripper}"), HasSubstr("seconds are wanted, like 1.5s"));
  EXPECT_THAT(wrong("{event: tuch, text: a, point: gripper}"), HasSubstr("did you mean 'touch'?"));
  EXPECT_THAT(wrong("{at: 1, point: gripper}"), HasSubstr("'annotate.1.text' is missing"));
  EXPECT_EQ(wrong("{at: 1, text: \"costs $5\", point: gripper}"), "") << "a sign without a partner is one";
  EXPECT_THAT(wrong("{at: 1, text: a}"), HasSubstr("'annotate.1.point' is missing"));
  EXPECT_THAT(wrong("{at: 1, text: a, point: [1]}"), HasSubstr("has 1 numbers: a place is [right, up]"));
  EXPECT_THAT(wrong("{at: 1, text: a, point: gripper, hold: -1}"), HasSubstr("must lie between 0 and 3600 s"));
  EXPECT_THAT(wrong("{at: 1, text: a, point: gripper, holt: 1}"), HasSubstr("unknown key 'annotate.1.holt'"));
  EXPECT_THAT(wrong("{at: 1, text: a, point: gripper}, {at: 1, text: b, point: gripper}"),
              HasSubstr("'annotate.1' and 'annotate.2' overlap: both stand at 1 s"));
}

// Whoever asks for the first second of a scene need not rewrite it: what the file has behind that is left out, and said. What the command line
// itself says, and a file that contradicts itself, is an error.
TEST_F(Annotate, BehindTheEndThatTheCommandLineSaysIsLeftOut) {
  const std::string text = "slow_motion: [{from: 0.2, until: 0.4, speed: 0.5}, {from: 3, until: 4, speed: 0.5}]\n"
                           "annotate: [{at: 0.5, text: a, point: gripper}, {at: 5, text: b, point: gripper}]\n";
  const Scene whole = read(text), shorter = read(text, {"duration=1"});
  EXPECT_EQ(whole.annotate.size(), 2u);
  EXPECT_THAT(whole.notices, testing::IsEmpty());
  ASSERT_EQ(shorter.annotate.size(), 1u);
  EXPECT_EQ(shorter.annotate[0].at, 0.5);
  EXPECT_EQ(shorter.slow_motion.size(), 1u);
  EXPECT_THAT(shorter.notices, testing::UnorderedElementsAre(HasSubstr("'slow_motion.2' of the scene is left out"), HasSubstr("'annotate.2' of the scene is left out")));
  EXPECT_THAT(error(text + "duration: 1\n"), HasSubstr("'slow_motion.2.from' lies at or behind the end"));
  EXPECT_THAT(error(text, {"duration=1", "annotate=[{at: 5, text: b, point: gripper}]"}), HasSubstr("'annotate.1.at' is 5 s, but the motion goes from 0 to 1 s"));
  EXPECT_THAT(error(text, {"duration=1", "slow_motion=[{from: 3, until: 4, speed: 0.5}]"}), HasSubstr("lies at or behind the end"));
}

}  // namespace
}  // namespace chainreel

#include "scene/text/scene_difference.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(SceneDifference, NamesKeysWithBothValues) {
  EXPECT_THAT(explain_scene_texts("method: rk4\nstep: 0.01\n", "method: dop853\ntolerance: 1e-9\n"),
              ElementsAre("method rk4 -> dop853", "tolerance: left out -> 1e-9", "step: 0.01 -> left out"));
}

TEST(SceneDifference, GoesIntoMappingsAndListsOfThem) {
  EXPECT_THAT(
      explain_scene_texts("video: {width: 640, height: 360}\nevents: [{when: q1, kind: a}, {when: q2}]\n",
                          "video: {width: 640, height: 480}\nevents: [{when: q1, kind: b}]\n"),
      ElementsAre("video.height 360 -> 480", "events.1.kind a -> b", "events: without {when: q2}"));
}

TEST(SceneDifference, AnEntryThatCameOrWentIsToldWhole) {
  EXPECT_THAT(key_changes("slow_motion", "[{event: hit, speed: 0.1}]", ""),
              ElementsAre(testing::HasSubstr("hit")));
  EXPECT_THAT(key_changes("slow_motion", "[{event: a, speed: 0.1}, {event: hit, speed: 0.1}]", "[{event: a, speed: 0.1}]"),
              ElementsAre("slow_motion: without {event: hit, speed: 0.1}"));
  EXPECT_THAT(key_changes("events", "[{name: a}]", "[{name: a}, {name: b}]"), ElementsAre("events: with {name: b}"));
}

TEST(SceneDifference, NamesTheEntryOfAList) {
  EXPECT_THAT(explain_scene_texts("q: [0, 1]\nm: [[1, 2], [3, 4]]\n", "q: [0, 2]\nm: [[1, 2], [3, 5]]\n"),
              ElementsAre("q.2 1 -> 2", "m.2.2 4 -> 5"));
}

TEST(SceneDifference, OfOneKeyGoesDownToWhatDiffers) {
  EXPECT_THAT(key_changes("method", "rk4", "dop853"), ElementsAre("method rk4 -> dop853"));
  EXPECT_THAT(key_changes("step", "", "0.01"), ElementsAre("step: left out -> 0.01"));
  EXPECT_THAT(key_changes("torque", "[0, \"max(0, q1)\"]", "[0, \"max(1, q1)\"]"),
              ElementsAre("torque.2: max(0, q1) -> max(1, q1)"));
  EXPECT_THAT(key_changes("torque", "{pd: {kp: [1, 2], kd: [3]}}", "{pd: {kp: [1, 4], kd: [3]}, csv: a.csv}"),
              ElementsAre("torque.pd.kp.2 2 -> 4", "torque.csv: left out -> a.csv"));
  EXPECT_THAT(key_changes("torque", "[0, 0]", "{csv: a.csv}"), ElementsAre("torque: [0, 0] -> {csv: a.csv}"));
  EXPECT_THAT(key_changes("start.q", "[1.5707963267948966]", "[1.5705227719643442]"),
              ElementsAre("start.q.1 1.5708 -> 1.57052"));
}

TEST(SceneDifference, SaysWhatLeftAListAndWhatCame) {
  EXPECT_THAT(key_changes("draw", "[chain, trail, time]", "[chain, ellipse]"),
              ElementsAre("draw: without trail, without time, with ellipse"));
  EXPECT_THAT(key_changes("draw", "[a, a]", "[a]"), ElementsAre("draw: [a, a] -> [a]"));
  EXPECT_THAT(key_changes("draw", "[]", "[a]"), ElementsAre("draw [] -> [a]"));
  EXPECT_THAT(key_changes("frames", "{}", ""), ElementsAre("frames: {} -> left out"));
}

TEST(SceneDifference, OfTextsThatMeanTheSameIsNone) {
  EXPECT_THAT(key_changes("a", "[1, 2]", "[1,  2]"), IsEmpty());
  EXPECT_THAT(key_changes("a", "1", "1.0"), IsEmpty());
  EXPECT_THAT(key_changes("a", "x y", "\"x y\""), IsEmpty());
  EXPECT_THAT(key_changes("a", "[1", "[2"),
              ElementsAre("a: [1 -> [2"));  // of no YAML there is no meaning to compare
}

TEST(SceneDifference, IsNoneWhereOrderAloneDiffers) {
  EXPECT_THAT(explain_scene_texts("a: 1\nb: {}\nc: []\nd: ~\n", "d: ~\nc: []\nb: {}\na: 1\n"), IsEmpty());
}

TEST(SceneDifference, OfNoYamlIsAnError) {
  EXPECT_THROW(explain_scene_texts("a: [1\n", "a: 1\n"), Error);
}

}  // namespace
}  // namespace chainreel

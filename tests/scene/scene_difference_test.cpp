#include "scene/text/scene_difference.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(SceneDifference, NamesKeysWithBothValues) {
  EXPECT_THAT(
      explain_scene_texts("method: rk4\nstep: 0.01\n", "method: dop853\ntolerance: 1e-9\n"),
      ElementsAre("method: rk4 -> dop853", "tolerance: not given -> 1e-9", "step: 0.01 -> not given"));
}

TEST(SceneDifference, GoesIntoMappingsAndListsOfThem) {
  EXPECT_THAT(
      explain_scene_texts("video: {width: 640, height: 360}\nevents: [{when: q1, kind: a}, {when: q2}]\n",
                          "video: {width: 640, height: 480}\nevents: [{when: q1, kind: b}]\n"),
      ElementsAre("video.height: 360 -> 480", "events.1.kind: a -> b", "events.2.when: q2 -> not given"));
}

TEST(SceneDifference, TakesAListOfNumbersAsOneValue) {
  EXPECT_THAT(explain_scene_texts("q: [0, 1]\nm: [[1, 2], [3, 4]]\n", "q: [0, 2]\nm: [[1, 2], [3, 5]]\n"),
              ElementsAre("q: [0, 1] -> [0, 2]", "m: [[1, 2], [3, 4]] -> [[1, 2], [3, 5]]"));
}

TEST(SceneDifference, IsNoneWhereOrderAloneDiffers) {
  EXPECT_THAT(explain_scene_texts("a: 1\nb: {}\nc: []\nd: ~\n", "d: ~\nc: []\nb: {}\na: 1\n"), IsEmpty());
}

TEST(SceneDifference, OfNoYamlIsAnError) {
  EXPECT_THROW(explain_scene_texts("a: [1\n", "a: 1\n"), Error);
}

}  // namespace
}  // namespace chainreel

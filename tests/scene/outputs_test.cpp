// The keys of a scene that speak of its outputs, and its text for other folders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/text/scene_paths.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

class SceneOutputs : public WrittenScenes {};

TEST_F(SceneOutputs, AreReadAndWritten) {
  const Scene plain = read("");
  EXPECT_FALSE(plain.video.preset);
  EXPECT_FALSE(plain.video.crf);
  EXPECT_EQ(plain.hold.first, 0);
  EXPECT_FALSE(is_transparent(plain));
  Scene scene = read("video: {preset: overlay, crf: 20.5}\nhold: {first: 0.5, last: 2}\n");
  EXPECT_TRUE(is_transparent(scene));
  scene.model = "rr.urdf";
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)));
  EXPECT_EQ(again.video.preset, Preset::overlay);
  EXPECT_EQ(again.video.crf, 20.5);
  EXPECT_EQ(again.hold.first, 0.5);
  EXPECT_EQ(again.hold.last, 2);
  EXPECT_TRUE(is_transparent(read("layout: transparent\n")));
}

TEST_F(SceneOutputs, SayWhatIsWrong) {
  EXPECT_THAT(error("video: {preset: slide}\n"), HasSubstr("or still, not 'slide': did you mean 'slides'?"));
  EXPECT_THAT(error("video: {preset: \"\"}\n"), HasSubstr("or still, not ''"));
  EXPECT_THAT(error("video: {crf: -1}\n"), HasSubstr("'video.crf' must lie between 0"));
  EXPECT_THAT(error("hold: [1]\n"), HasSubstr("hold: {first: 1, last: 2}"));
  EXPECT_THAT(error("hold: {last: -1}\n"), HasSubstr("'hold.last' must lie between 0 and 3600 s"));
  EXPECT_THAT(error("hold: {middle: 1}\n"), HasSubstr("unknown key 'hold.middle'"));
  EXPECT_THAT(error("layout: transparant\n"), HasSubstr("did you mean 'transparent'?"));
}

TEST_F(SceneOutputs, PathsAreFoundFromAnotherFolder) {
  const std::string text =
      "title: \"\u03C4 and \\\"model: x\\\"\"\nmodel: models/rr.urdf\npackages: {robot: parts, other: "
      "/opt/robot}\n"
      "torque: [\"sin(t)\", {csv: \"my tau.csv\"}]\nparameters: {model: 3, csv: 1}\n"
      "compare:\n  - title: \"model: a\"\n    torque: {pd: {kp: [1], kd: [1], trajectory: in/q.csv}}\n"
      "  - title: b\n    model: b.urdf\n";
  EXPECT_EQ(moved_scene_text(text, "out/clips"),
            "title: \"\u03C4 and \\\"model: x\\\"\"\nmodel: \"../../models/rr.urdf\"\n"
            "packages: {robot: \"../../parts\", other: /opt/robot}\n"
            "torque: [\"sin(t)\", {csv: \"../../my tau.csv\"}]\nparameters: {model: 3, csv: 1}\n"
            "compare:\n  - title: \"model: a\"\n    torque: {pd: {kp: [1], kd: [1], trajectory: "
            "\"../../in/q.csv\"}}\n  - title: b\n    model: \"../../b.urdf\"\n");
  EXPECT_THROW(moved_scene_text("model: [", "out"), Error);
}

}  // namespace
}  // namespace chainreel

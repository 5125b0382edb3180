// Every scene of assets/scenes: it runs, its film is what it promises, and its picture is the golden one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/pipeline.hpp"
#include "draw/film.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/theme.hpp"
#include "support/picture_compare.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 640, kHeight = 360;

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(CHAINREEL_SOURCE_FOLDER) / "assets/scenes"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class EveryScene : public testing::TestWithParam<std::string> {
 protected:
  EveryScene()
      : prepared_(load_scene("assets/scenes/" + GetParam() + ".yaml",
                             {"video.width=640", "video.height=360", "text_scale=1.5"})),
        times_(frame_times(prepared_.scene)),
        trajectory_(simulate(prepared_.simulation, times_)),
        film_(prepared_.scene, prepared_.simulation.chain, trajectory_, trajectory_.size(), fonts_) {}

  // The frame at 1.2 s: chaos has not begun anywhere.
  static constexpr int kFrame = 72;

  Image image(int frame) const {
    Picture picture = film_.static_layer();
    picture.append(film_.frame(frame));
    return rasterise(picture, kWidth, kHeight, fonts_);
  }

  Pixel pixel_at(const Image& image, const Eigen::Vector3d& x) const {
    const Point page = film_.camera().project(x);
    return image.at(int(page.x * kHeight), int((1 - page.y) * kHeight));
  }

  Eigen::Vector3d gripper(int frame) const {
    const Chain& chain = prepared_.simulation.chain;
    Workspace ws(chain);
    compute_kinematics(chain, ws, trajectory_.q_at(frame), trajectory_.qd_at(frame));
    return frame_position(chain, ws, chain.end_effector);
  }

  Fonts fonts_;
  PreparedScene prepared_;
  std::vector<double> times_;
  Trajectory trajectory_;
  Film film_;
};

INSTANTIATE_TEST_SUITE_P(Assets, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& p) { return p.param; });

TEST_P(EveryScene, RunsToItsEnd) {
  EXPECT_EQ(trajectory_.status, RunStatus::finished) << trajectory_.trouble;
  EXPECT_EQ(trajectory_.size(), frame_count(prepared_.scene.duration, prepared_.scene.video.fps));
}

TEST_P(EveryScene, LooksLikeItsGolden) {
  // The same pixels are expected everywhere; processors without FMA differ by 1 in a few bytes, and another
  // build of FreeType may move a glyph's edge.
  EXPECT_TRUE(matches_golden(image(kFrame), GetParam(), {.max = 24, .mean = 0.05}));
}

TEST_P(EveryScene, ShowsTheGripperWhereThePhysicsHasIt) {
  const Color ink = light_theme().ink;
  const Pixel pixel = pixel_at(image(kFrame), gripper(kFrame));
  // A disc of 5 px: its centre pixel is flat ink.
  EXPECT_EQ(pixel, (Pixel{ink.r, ink.g, ink.b, 255}));
}

// Negative control: half a link away there is no gripper.
TEST_P(EveryScene, ShowsNoGripperElsewhere) {
  const Color ink = light_theme().ink;
  const Pixel pixel = pixel_at(image(kFrame), gripper(kFrame) + Eigen::Vector3d(0.02, 0.31, 0));
  EXPECT_NE(pixel, (Pixel{ink.r, ink.g, ink.b, 255}));
}

TEST_P(EveryScene, KeepsItsMarginsInTheBackgroundColour) {
  const Image picture = image(kFrame);
  const Color background = light_theme().background;
  for (const auto& [x, y] : {std::pair{1, 1}, {kWidth - 2, 1}, {1, kHeight - 2}, {kWidth - 2, kHeight - 2}})
    EXPECT_EQ(picture.at(x, y), (Pixel{background.r, background.g, background.b, 255}));
}

TEST_P(EveryScene, DiffersFromAnotherOfItsFrames) {
  // Negative control of the golden: a tenth of a second later is another picture.
  EXPECT_FALSE(
      pictures_agree(image(kFrame), image(kFrame + 6), {.max = 24, .mean = 0.05}, GetParam() + "_control"));
}

TEST(Scenes, OfTheLectureAreAllThere) {
  for (const char* name :
       {"pp_free", "pp_spring", "rr_free", "rr_torque", "rrr_free", "rrr_torque", "rr_ellipse"})
    EXPECT_THAT(scene_names(), testing::Contains(name));
}

}  // namespace
}  // namespace chainreel

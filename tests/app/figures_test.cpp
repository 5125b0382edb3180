// Snapshots and ellipse figures as files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

TEST(Snapshot, OfASceneHasTheScenesSize) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  const ProgramResult result = run_program({"snapshot", "assets/scenes/rrr_torque.yaml", "--at", "1.2", "-o",
                                            file, "--set", "video.width=640", "--set", "video.height=360"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Image image = read_png(file);
  EXPECT_EQ(image.width, 640);
  EXPECT_EQ(image.height, 360);
}

TEST(Snapshot, LiesBetweenItsNeighbouringFrames) {
  const TemporaryFolder folder;
  const auto at = [&](const std::string& t) {
    const std::string file = folder.file(t + ".png");
    EXPECT_EQ(run_program({"snapshot", "assets/scenes/rr_free.yaml", "--at", t, "-o", file, "--set",
                           "video.width=320", "--set", "video.height=180", "--set", "text_scale=1.5"})
                  .status,
              0);
    return read_png(file);
  };
  const Image a = at("0.5"), between = at("0.508"), b = at("0.516666666666666667");
  EXPECT_LT(compare_pictures(a, between).mean, compare_pictures(a, b).mean);
  EXPECT_LT(compare_pictures(between, b).mean, compare_pictures(a, b).mean);
}

TEST(Snapshot, OutsideTheDurationIsAUsageError) {
  const ProgramResult result = run_program({"snapshot", "assets/scenes/rr_free.yaml", "--at", "11"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("lies behind the end of assets/scenes/rr_free.yaml, whose duration is 10 s"));
}

TEST(Snapshot, OfAModelAtAPose) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  const ProgramResult result = run_program(
      {"snapshot", "models/rr.urdf", "--pose", "0,90deg", "-o", file, "--width", "640", "--height", "360"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(matches_golden(read_png(file), "pose_rr", {.max = 24, .mean = 0.05}));
}

TEST(Ellipse, FigureShowsEachPoseWithItsNumbers) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  const ProgramResult result =
      run_program({"ellipse", "models/rr.urdf", "--pose", "0,90deg", "--pose", "0,150deg", "--pose", "0,0",
                   "-o", file, "--width", "640", "--height", "360", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(matches_golden(read_png(file), "ellipse_rr", {.max = 24, .mean = 0.05}));
  // Published values: design of the lecture, RR with unit links and masses; a few roundings of numbers up
  // to 4.
  const Json report = Json::parse(result.out);
  ASSERT_EQ(report["poses"].size(), 3u);
  const Json& right_angle = report["poses"][0]["Lambda"];
  EXPECT_NEAR(right_angle[0][0].get<double>(), 1, 1e-14);
  EXPECT_NEAR(right_angle[0][1].get<double>(), 0, 1e-14);
  EXPECT_NEAR(right_angle[1][1].get<double>(), 2, 1e-14);
  const Json& folded = report["poses"][1]["Lambda"];
  EXPECT_NEAR(folded[0][0].get<double>(), 4, 1e-13);
  EXPECT_NEAR(folded[0][1].get<double>(), -std::sqrt(3), 1e-13);
  EXPECT_NEAR(folded[1][1].get<double>(), 2, 1e-13);
  EXPECT_TRUE(report["poses"][2]["Lambda"].is_null());
}

TEST(Ellipse, WantsAsManyNumbersAsTheChainHasJoints) {
  const ProgramResult result = run_program({"ellipse", "models/rr.urdf", "--pose", "0,1,2"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--pose 0,1,2 has 3 numbers"));
}

TEST(Sheet, OfNextToNoWidthIsRefusedAndDoesNotHang) {
  const TemporaryFolder folder;
  const ProgramResult run = run_program({"sheet", "assets/scenes/pp_free.yaml", "--at", "0,1", "--width", "16", "--height", "16384", "-o", folder.file("a.png")});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, testing::HasSubstr("are too small on this page"));
}

}  // namespace
}  // namespace chainreel

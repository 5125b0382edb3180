#include "support/picture_compare.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "encode/png.hpp"
#include "encode/test_pictures.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(PictureCompare, EqualPicturesDifferByNothing) {
  const Image image = random_picture(20, 10, 1);
  const PictureDifference difference = compare_pictures(image, image);
  EXPECT_TRUE(difference.same_size);
  EXPECT_EQ(difference.max, 0);
  EXPECT_EQ(difference.mean, 0);
  EXPECT_EQ(difference.x, -1);
}

TEST(PictureCompare, OneChangedPixelIsFoundWithItsPlaceAndSize) {
  const Image a = flat_picture(20, 10, {100, 100, 100});
  Image b = a;
  set_pixel(b, 7, 3, {100, 140, 100});
  const PictureDifference difference = compare_pictures(a, b);
  EXPECT_EQ(difference.max, 40);
  EXPECT_EQ(difference.mean, 40.0 / (20 * 10 * 4));
  EXPECT_EQ(difference.x, 7);
  EXPECT_EQ(difference.y, 3);
}

TEST(PictureCompare, AnotherSizeNeverAgrees) {
  EXPECT_FALSE(compare_pictures(flat_picture(4, 2, {}), flat_picture(2, 4, {})).same_size);
  EXPECT_FALSE(pictures_agree(flat_picture(4, 2, {}), flat_picture(2, 4, {}), {.max = 255, .mean = 255},
                              "size_control"));
}

TEST(PictureCompare, BothBoundsCount) {
  const TemporaryFolder folder;
  const GoldenPlaces places{folder.file("golden"), folder.file("failures"), false};
  fs::create_directories(places.goldens);
  const Image a = flat_picture(10, 10, {100, 100, 100});
  write_png(places.goldens + "/a.png", a);
  Image spot = a;  // large in one place, small on average
  set_pixel(spot, 0, 0, {200, 100, 100});
  EXPECT_TRUE(matches_golden(spot, "a", {.max = 100, .mean = 0.25}, places));
  EXPECT_FALSE(matches_golden(spot, "a", {.max = 99, .mean = 0.25}, places));
  EXPECT_FALSE(matches_golden(spot, "a", {.max = 100, .mean = 0.24}, places));
}

TEST(Golden, AMissingPictureFailsWithTheCommandThatWritesIt) {
  const TemporaryFolder folder;
  const GoldenPlaces places{folder.file("golden"), folder.file("failures"), false};
  const testing::AssertionResult result = matches_golden(flat_picture(2, 2, {}), "sub/new", {}, places);
  EXPECT_FALSE(result);
  EXPECT_THAT(result.message(), HasSubstr("CHAINREEL_UPDATE_GOLDEN=1 ctest"));
  EXPECT_THAT(result.message(), HasSubstr("'^Golden\\.AMissingPictureFailsWithTheCommandThatWritesIt$'"));
  EXPECT_FALSE(fs::exists(places.goldens + "/sub/new.png"));
  EXPECT_TRUE(fs::exists(places.failures + "/sub/new.actual.png"));
}

TEST(Golden, TheSwitchWritesAndTheNextRunAgrees) {
  const TemporaryFolder folder;
  GoldenPlaces places{folder.file("golden"), folder.file("failures"), true};
  const Image image = disc_picture(32, 16, 4);
  EXPECT_TRUE(matches_golden(image, "disc", {}, places));
  places.update = false;
  EXPECT_TRUE(matches_golden(image, "disc", {}, places));
}

TEST(Golden, AChangedPictureFailsAndLeavesItsDelta) {
  const TemporaryFolder folder;
  const GoldenPlaces places{folder.file("golden"), folder.file("failures"), false};
  fs::create_directories(places.goldens);
  write_png(places.goldens + "/disc.png", disc_picture(32, 16, 4));
  const testing::AssertionResult result =
      matches_golden(disc_picture(32, 16, 9), "disc", {.max = 8, .mean = 0.1}, places);
  EXPECT_FALSE(result);
  EXPECT_THAT(result.message(), HasSubstr("disc.delta.png"));
  const Image delta = read_png(places.failures + "/disc.delta.png");
  EXPECT_EQ(delta.at(0, 0), (Pixel{255, 255, 255}));  // white where nothing differs
  EXPECT_GT(compare_pictures(delta, flat_picture(32, 16, {255, 255, 255})).max, 0);
}

}  // namespace
}  // namespace chainreel

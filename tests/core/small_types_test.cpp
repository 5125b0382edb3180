#include <gtest/gtest.h>

#include "core/frame_rate.hpp"
#include "core/image.hpp"
#include "core/json.hpp"

namespace chainreel {
namespace {

TEST(JsonType, KeepsTheOrderInWhichKeysWereWritten) {
  Json json;
  json["zebra"] = 1;
  json["ape"] = {1.5, true, nullptr};
  json["mouse"]["b"] = "x";
  json["mouse"]["a"] = "y";
  EXPECT_EQ(json.dump(), R"({"zebra":1,"ape":[1.5,true,null],"mouse":{"b":"x","a":"y"}})");
  EXPECT_NE(nlohmann::json(json).dump(), json.dump());  // the sorted type would not
}

TEST(FrameRates, CountAndPlaceFramesByIndex) {
  EXPECT_EQ(frame_count(10, {60, 1}), 600);
  EXPECT_EQ(frame_count(1, {30000, 1001}), 30);  // 29.97 rounds to 30
  EXPECT_EQ(frame_count(0.005, {60, 1}), 0);
  EXPECT_EQ(frame_time(30, {30000, 1001}), 1.001);
  EXPECT_EQ(frame_time(600, {60, 1}), 10);
  EXPECT_NE(frame_count(10, {50, 1}), 600);
}

TEST(Images, ArePackedRowsOfBgraFromTheTop) {
  Image image(3, 2);
  EXPECT_EQ(image.bgra.size(), 24u);
  image.bgra[4 * 5 + 2] = 200;  // red of the last pixel
  image.bgra[4 * 5 + 3] = 255;
  EXPECT_EQ(image.at(2, 1), (Pixel{200, 0, 0, 255}));
  EXPECT_NE(image.at(1, 1), (Pixel{200, 0, 0, 255}));
}

}  // namespace
}  // namespace chainreel

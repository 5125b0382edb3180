#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

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

// Below and above the size from which memory begins at a large page.
TEST(PixelBytes, AreZeroAtFirstAndCopiedMovedAndCompared) {
  for (const std::size_t size : {std::size_t(0), std::size_t(5), std::size_t(1) << 20, std::size_t(3) << 20, std::size_t(1920 * 1080 * 4)}) {
    PixelBytes bytes(size);
    EXPECT_EQ(bytes.size(), size);
    EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; })) << size;
    if (size == 0) {
      EXPECT_TRUE(bytes.empty());
      continue;
    }
    bytes[size - 1] = 7;
    PixelBytes copy = bytes, other(size);
    EXPECT_TRUE(copy == bytes) << size;
    EXPECT_FALSE(other == bytes) << size;
    copy[0] = 1;
    EXPECT_EQ(bytes[0], 0) << "of the copy alone";
    other = bytes;  // of one size: in its place
    EXPECT_TRUE(other == bytes);
    other = PixelBytes(2);
    EXPECT_EQ(other.size(), 2u);
    copy = std::move(bytes);
    EXPECT_EQ(copy[size - 1], 7);
    EXPECT_EQ(bytes.size(), 0u);  // NOLINT: what is moved from is empty
  }
  const auto begins_at_a_large_page = [](const PixelBytes& bytes) { return reinterpret_cast<std::uintptr_t>(bytes.data()) % (1 << 21) == 0; };
  EXPECT_TRUE(begins_at_a_large_page(PixelBytes(1920 * 1080 * 4)));
}

}  // namespace
}  // namespace chainreel

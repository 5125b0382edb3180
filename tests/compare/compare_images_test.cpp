#include "compare/compare_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "compare/flip.hpp"
#include "compare/test_images.hpp"

namespace chainreel {
namespace {

constexpr Pixel kWhite = {255, 255, 255, 255}, kRed = {255, 0, 0, 255};

TEST(CompareImages, EqualPicturesAreEqual) {
  const Image image = noise(100, 80, 1);
  const ImageDifference d = compare_images(image, image, {});
  EXPECT_TRUE(d.is_equal());
  EXPECT_TRUE(d.passes({}));
  EXPECT_EQ(d.unequal + d.at_edges + d.beyond, 0);
  EXPECT_EQ(d.worst, 0);
  EXPECT_EQ(d.mean, 0);
  EXPECT_TRUE(d.box.empty());
}

TEST(CompareImages, SizesThatDifferPassNoTolerance) {
  const ImageDifference d = compare_images(flat_picture(4, 6, kWhite), flat_picture(6, 4, kWhite), {});
  EXPECT_FALSE(d.same_size);
  EXPECT_FALSE(d.is_equal());
  EXPECT_FALSE(d.passes({.error = 1, .pixels = 1000}));
  EXPECT_TRUE(difference_picture(flat_picture(4, 6, kWhite), flat_picture(6, 4, kWhite), {}).bgra.empty());
}

TEST(CompareImages, OnePixelIsFoundWhereverItIs) {
  const Image expected = flat_picture(150, 131, kWhite);
  for (const auto& [x, y] : {std::pair(0, 0), {149, 130}, {63, 63}, {64, 64}, {75, 40}, {149, 0}}) {
    Image actual = expected;
    set_pixel(actual, x, y, kRed);
    const ImageDifference d = compare_images(expected, actual, {});
    EXPECT_EQ(d.unequal, 1);
    EXPECT_EQ(d.beyond, 1);
    EXPECT_EQ(d.box, (PixelBox{x, y, 1, 1}));
    EXPECT_FALSE(d.passes({}));
    EXPECT_TRUE(d.passes({.pixels = 1}));
  }
}

// Tiles are a matter of speed: errors are those of the whole picture at once.
TEST(CompareImages, ErrorsAreThoseOfTheWholePicture) {
  const Image expected = noise(200, 150, 2);
  Image actual = expected;
  for (const auto& [x, y] : {std::pair(3, 3), {62, 10}, {66, 12}, {130, 127}, {199, 149}, {100, 64}})
    set_pixel(actual, x, y, kRed);
  const std::vector<float> errors = Flip().errors(expected, actual, {0, 0, 200, 150});
  double sum = 0, worst = 0;
  for (const float error : errors) sum += error;
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 200; ++x)
      if (expected.at(x, y) != actual.at(x, y))
        worst = std::max(worst, double(errors[std::size_t(y * 200 + x)]));
  const ImageDifference d = compare_images(expected, actual, {});
  EXPECT_EQ(d.worst, worst);
  EXPECT_NEAR(d.mean, sum / (200 * 150), 1e-12);
}

TEST(CompareImages, ToleranceOfErrorDecidesWhatCounts) {
  const Image expected = flat_picture(40, 40, {128, 128, 128, 255}), actual = flat_picture(40, 40, {131, 128, 128, 255});
  const ImageDifference d = compare_images(expected, actual, {.error = 0.1});
  EXPECT_EQ(d.unequal, 1600);
  EXPECT_EQ(d.beyond, 0);
  EXPECT_TRUE(d.passes({}));
  EXPECT_FALSE(d.is_equal());
  EXPECT_GT(d.worst, 0.01);
  EXPECT_EQ(d.box, (PixelBox{0, 0, 40, 40})) << "of all unequal ones where none is beyond";
  EXPECT_EQ(compare_images(expected, actual, {.error = d.worst * 0.99}).beyond, 1600);
  EXPECT_EQ(compare_images(expected, actual, {.error = 0}).beyond, 1600);
}

TEST(CompareImages, WhatIsMaskedIsNotLookedAt) {
  const Image expected = flat_picture(60, 60, kWhite);
  Image actual = expected;
  for (int i = 0; i < 9; ++i) set_pixel(actual, 20 + i, 30, kRed);
  const PixelBox over = {20, 30, 9, 1}, reaching = {-100, 25, 2000000000, 2000000000},
                 beside = {20, 31, 9, 5};
  EXPECT_TRUE(compare_images(expected, actual, {.masks = {over}}).is_equal());
  EXPECT_TRUE(compare_images(expected, actual, {.masks = {reaching}}).is_equal());
  EXPECT_EQ(compare_images(expected, actual, {.masks = {beside}}).unequal, 9);
  EXPECT_EQ(compare_images(expected, actual, {.masks = {{20, 30, -9, -1}, {20, 30, 0, 5}}}).unequal, 9);
  EXPECT_EQ(compare_images(expected, actual, {.masks = {{20, 30, 4, 1}, {25, 0, 2, 60}}}).unequal, 3);
}

TEST(CompareImages, WhatIsMaskedDoesNotBearOnItsNeighbours) {
  const Image expected = flat_picture(60, 60, {100, 100, 100, 255});
  Image faint = expected, strong = expected;
  set_pixel(faint, 30, 30, {104, 100, 100, 255});
  set_pixel(strong, 30, 30, {104, 100, 100, 255});
  for (int y = 0; y < 60; ++y) set_pixel(strong, 31, y, kRed);
  const ImageDifference d = compare_images(expected, strong, {.masks = {{31, 0, 1, 60}}});
  EXPECT_EQ(d.worst, compare_images(expected, faint, {}).worst);
  EXPECT_EQ(d.unequal, 1);
}

TEST(CompareImages, AlphaCountsEvenWhereNothingIsSeen) {
  // On mid grey both are mid grey.
  const Image expected = flat_picture(9, 9, {128, 128, 128, 255});
  Image actual = expected;
  set_pixel(actual, 4, 4, {128, 128, 128, 51});
  const ImageDifference d = compare_images(expected, actual, {});
  EXPECT_EQ(d.unequal, 1);
  EXPECT_NEAR(d.worst, 0.8, 1e-6);
  EXPECT_EQ(d.beyond, 1);
}

TEST(CompareImages, ColoursOfTransparentPixelsAreUnequalButNotSeen) {
  const ImageDifference d = compare_images(flat_picture(5, 5, {1, 2, 3, 0}), flat_picture(5, 5, {200, 2, 3, 0}), {});
  EXPECT_EQ(d.unequal, 25);
  EXPECT_EQ(d.worst, 0);
  EXPECT_TRUE(d.passes({}));
}

TEST(CompareImages, PicturesMayBeAsSmallAsTheyLike) {
  for (const auto& [width, height] : {std::pair(1, 1), {1, 70}, {70, 1}, {2, 2}, {65, 3}}) {
    const Image expected = flat_picture(width, height, kWhite), actual = flat_picture(width, height, kRed);
    EXPECT_EQ(compare_images(expected, actual, {}).beyond, width * height);
    EXPECT_EQ(compare_images(expected, actual, {.forgive_edges = true}).beyond, width * height)
        << "paper that has no edge has nothing to forgive";
    EXPECT_EQ(difference_picture(expected, actual, {.forgive_edges = true}).width, width);
  }
  EXPECT_TRUE(compare_images(Image(), Image(), {.forgive_edges = true}).is_equal());
}

TEST(CompareImages, AToleranceThatIsNoNumberAllowsNothing) {
  const Image expected = flat_picture(9, 9, kWhite), actual = flat_picture(9, 9, {254, 255, 255, 255});
  EXPECT_EQ(compare_images(expected, actual, {.error = std::nan("")}).beyond, 81);
}

TEST(CompareImages, AnEnvelopeOfAnotherSizeIsRefused) {
  const Image image = flat_picture(9, 9, kWhite), other = flat_picture(9, 9, kRed), small = flat_picture(8, 9, kWhite);
  const Envelope envelope = envelope_of(small);
  EXPECT_THROW(compare_images(image, other, {}, &envelope), std::logic_error);
  EXPECT_THROW(envelope_of(image, std::span(&small, 1)), std::logic_error);
}

TEST(CompareImages, IsSymmetricWithoutAnEnvelope) {
  const Image a = ring(20, 20, 10, 1), b = ring(22, 21, 11, 2);
  const ImageDifference there = compare_images(a, b, {}), back = compare_images(b, a, {});
  EXPECT_EQ(there.beyond, back.beyond);
  EXPECT_EQ(there.worst, back.worst);
  EXPECT_EQ(there.mean, back.mean);
}

TEST(DifferencePicture, ShowsWhereByHowMuchAndWhatIsMasked) {
  const Image expected = flat_picture(40, 40, {200, 200, 200, 255});
  Image actual = expected;
  set_pixel(actual, 5, 5, {0, 0, 0, 255});         // an eye sees it
  set_pixel(actual, 30, 5, {202, 200, 200, 255});  // hardly
  set_pixel(actual, 5, 30, {0, 0, 0, 255});        // masked
  const Image picture = difference_picture(expected, actual, {.masks = {{0, 25, 20, 10}}});
  const auto saturation = [&](int x, int y) {
    const Pixel p = picture.at(x, y);
    return std::max({p.r, p.g, p.b}) - std::min({p.r, p.g, p.b});
  };
  EXPECT_GT(saturation(5, 5), 80);
  EXPECT_GT(saturation(30, 5), 20);
  EXPECT_LT(saturation(30, 5), 80);
  EXPECT_EQ(saturation(5, 30), 0);
  EXPECT_EQ(saturation(20, 20), 0);
  EXPECT_LT(picture.at(2, 30).r, picture.at(3, 30).r) << "hatched";
  EXPECT_TRUE(picture.is_opaque());
}

TEST(DifferencePicture, LargerErrorsAreDarker) {
  const auto shade = [](std::uint8_t level) {
    const Image picture = difference_picture(flat_picture(8, 8, {0, 0, 0, 255}),
                                             flat_picture(8, 8, {level, level, level, 255}), {.error = 0});
    const Pixel p = picture.at(4, 4);
    return p.r + p.g + p.b;
  };
  EXPECT_GT(shade(20), shade(60));
  EXPECT_GT(shade(60), shade(255));
}

TEST(DifferencePicture, ShowsAntiAliasingApart) {
  const Image expected = ring(20, 20, 10, 3), actual = ring(20.2, 20, 10, 3);
  const Envelope envelope = envelope_of(expected);
  const ImageDifference d = compare_images(expected, actual, {}, &envelope);
  ASSERT_GT(d.at_edges, 0);
  const Image picture = difference_picture(expected, actual, {}, &envelope);
  long blue = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x) blue += picture.at(x, y) == Pixel{150, 200, 235, 255};
  EXPECT_EQ(blue, d.at_edges);
}

}  // namespace
}  // namespace chainreel

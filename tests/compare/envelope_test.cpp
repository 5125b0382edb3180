#include <algorithm>

#include "compare/envelope.hpp"

#include <gtest/gtest.h>

#include "compare/compare_images.hpp"
#include "compare/test_images.hpp"

namespace chainreel {
namespace {

constexpr double kX = 23.6, kY = 24.3, kRadius = 15.2;

Envelope of_ring(double stroke) {
  const Image moved[] = {ring(kX + 0.5, kY, kRadius, stroke), ring(kX - 0.5, kY, kRadius, stroke),
                         ring(kX, kY + 0.5, kRadius, stroke), ring(kX, kY - 0.5, kRadius, stroke)};
  return envelope_of(ring(kX, kY, kRadius, stroke), moved);
}

ImageDifference against_ring(double stroke, const Image& actual, double error = 0.1) {
  const Envelope envelope = of_ring(stroke);
  return compare_images(ring(kX, kY, kRadius, stroke), actual, {.error = error}, &envelope);
}

TEST(Envelope, ForgivesThinRingsThatAreDrawnOffByHalfAPixel) {
  for (const double stroke : {0.5, 1.0, 1.4, 3.0})
    for (const auto& [dx, dy] : {std::pair(0.5, 0.0),
                                 {-0.5, 0.0},
                                 {0.0, 0.5},
                                 {0.25, 0.0},
                                 {0.0, -0.3},
                                 {0.25, 0.25},
                                 {-0.2, 0.3},
                                 {-0.1, -0.1}}) {
      const ImageDifference d = against_ring(stroke, ring(kX + dx, kY + dy, kRadius, stroke), 0);
      EXPECT_GT(d.unequal, 0);
      EXPECT_EQ(d.at_edges, d.unequal) << stroke << " moved by " << dx << ' ' << dy;
      EXPECT_EQ(d.beyond, 0);
    }
}

TEST(Envelope, DoesNotForgiveARingThatIsOffByAPixel) {
  for (const double stroke : {0.5, 1.0, 1.4, 3.0})
    for (const auto& [dx, dy] : {std::pair(1.0, 0.0), {-1.0, 0.0}, {0.0, 1.0}, {0.7, 0.7}}) {
      const ImageDifference d = against_ring(stroke, ring(kX + dx, kY + dy, kRadius, stroke));
      EXPECT_GT(d.beyond, 20) << stroke << " moved by " << dx << ' ' << dy;
    }
}

TEST(Envelope, DoesNotForgiveARingThatIsMissing) {
  for (const double stroke : {0.5, 1.0, 3.0}) {
    const ImageDifference d = against_ring(stroke, drawn(48, 48, [](double, double) { return 0.0; }));
    EXPECT_GT(d.beyond, 60) << stroke;
  }
}

// Each pixel of a stroke between two rows may lose it to the other row, but not both.
TEST(Envelope, DoesNotForgiveAThinStrokeBetweenRowsThatIsMissing) {
  const auto stroke = [](double y) {
    return drawn(40, 20, [=](double, double py) { return 0.5 * std::clamp(1 - std::abs(py - y), 0.0, 1.0); });
  };
  const Image expected = stroke(10), missing = stroke(-10);
  const Image moved[] = {expected, expected, stroke(10.5), stroke(9.5)};
  const Envelope envelope = envelope_of(expected, moved);
  const ImageDifference gone = compare_images(expected, missing, {}, &envelope);
  EXPECT_EQ(gone.at_edges, 0);
  EXPECT_EQ(gone.beyond, gone.unequal);
  const ImageDifference shifted = compare_images(expected, stroke(10.25), {.error = 0}, &envelope);
  EXPECT_EQ(shifted.at_edges, shifted.unequal);
  EXPECT_GT(shifted.unequal, 0);
}

TEST(Envelope, HoldsThePeakOfAStrokeBetweenTheRenderings) {
  // A stroke of one pixel, off by a quarter: the five renderings know coverages up to 0.75 alone, one of them
  // is 1.
  const auto stroke = [](double x) {
    return drawn(20, 20, [=](double px, double) { return std::clamp(1 - std::abs(px - x), 0.0, 1.0); });
  };
  const Image moved[] = {stroke(10.75), stroke(10.75 + 0.5), stroke(10.75 - 0.5), stroke(10.75)};
  const Envelope envelope = envelope_of(stroke(10.75), moved);
  EXPECT_TRUE(is_within(envelope, stroke(10.5), 10, 10));
  EXPECT_FALSE(is_within(envelope, stroke(10.0), 9, 10));
}

TEST(Envelope, WithoutShapesIsHalfWayToTheNeighbours) {
  const Image expected = ring(kX, kY, kRadius, 3);
  const Envelope envelope = envelope_of(expected);
  const ImageDifference moved = compare_images(expected, ring(kX + 0.2, kY, kRadius, 3), {}, &envelope);
  EXPECT_EQ(moved.beyond, 0);
  EXPECT_GT(moved.at_edges, 9 * moved.unequal / 10);
  EXPECT_GT(compare_images(expected, ring(kX + 1, kY, kRadius, 3), {}, &envelope).beyond, 20);
}

// Tiles of 64 pixels are a matter of speed: the ring lies across four of them.
TEST(Envelope, OfNeighboursIsTheSameTileByTile) {
  const Image expected = ring(64.3, 63.8, 40, 1, 130), actual = ring(64.6, 63.7, 40, 1, 130);
  const Envelope whole = envelope_of(expected);
  const ImageDifference d = compare_images(expected, actual, {}, &whole);
  const ImageDifference by_tiles = compare_images(expected, actual, {.forgive_edges = true});
  EXPECT_EQ(by_tiles.at_edges, d.at_edges);
  EXPECT_EQ(by_tiles.beyond, d.beyond);
  EXPECT_EQ(by_tiles.worst, d.worst);
  EXPECT_GT(d.at_edges, 100);
  EXPECT_EQ(compare_images(expected, actual, {}).at_edges, 0);
}

TEST(Envelope, IsThePictureAloneWhereNothingChanges) {
  const Image flat = flat_picture(9, 9, {10, 20, 30, 255});
  const Envelope envelope = envelope_of(flat);
  EXPECT_EQ(envelope.low.bgra, flat.bgra);
  EXPECT_EQ(envelope.high.bgra, flat.bgra);
  EXPECT_EQ(envelope.mean_low.bgra, flat.bgra);
  Image other = flat;
  set_pixel(other, 4, 4, {11, 20, 30, 255});
  EXPECT_TRUE(is_within(envelope, other, 4, 4)) << "rounding";
  set_pixel(other, 4, 4, {12, 20, 30, 255});
  EXPECT_FALSE(is_within(envelope, other, 4, 4));
}

TEST(Envelope, OfNothingMovedIsThePicture) {
  const Image image = noise(7, 5, 8);
  const Envelope envelope = envelope_of(image, {});
  EXPECT_EQ(envelope.low.bgra, image.bgra);
  EXPECT_EQ(envelope.high.bgra, image.bgra);
}

// Four levels of 255 are more than rounding: they stay a difference in the middle of a surface and at its
// border alike.
TEST(Envelope, DoesNotForgiveAnotherColour) {
  const Image expected = ring(kX, kY, kRadius, 6);
  Image actual = expected;
  for (std::size_t i = 0; i < actual.bgra.size(); i += 4)
    if (actual.bgra[i + 2] == 20) actual.bgra[i + 2] = 24;
  const Envelope envelope = of_ring(6);
  const ImageDifference d = compare_images(expected, actual, {.error = 0.01}, &envelope);
  EXPECT_GT(d.unequal, 300);
  EXPECT_GT(d.beyond, d.unequal / 2);
}

}  // namespace
}  // namespace chainreel

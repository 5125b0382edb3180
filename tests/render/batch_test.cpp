// Shapes as streams of numbers, before any OpenGL.
#include "render/batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/drawing.hpp"

namespace chainreel {
namespace {

const Paint kPaint = {kBlack, kNothing, 0};

class BatchTest : public ::testing::Test {
 protected:
  GlyphAtlas atlas_{fonts(), 4096};
  Batch batch_{kSide, kSide, atlas_};
  Picture picture_;
};

TEST_F(BatchTest, NeighboursOfOneKindAreOneRun) {
  const Capsule capsule = {{0.2, 0.2}, {0.4, 0.4}, 0.1, kPaint};
  const Arc arc = {{0.5, 0.5}, 0.2, 0, 1, 0.01, kBlack};
  for (const Shape& shape : std::initializer_list<Shape>{capsule, capsule, arc, capsule}) picture_.add(shape);
  batch_.set(picture_);
  ASSERT_EQ(batch_.runs().size(), 3u);
  EXPECT_EQ(batch_.runs()[0].count, 2);
  EXPECT_EQ(batch_.runs()[2].primitive, Primitive::capsule);
  EXPECT_EQ(batch_.runs()[2].first, 2);
  EXPECT_EQ(batch_.instances(Primitive::capsule).size(), 3u * 4u * 5u);
}

TEST_F(BatchTest, AnotherClipIsAnotherRun) {
  picture_.clips = {{0, 0, 0.5, 0.5}, {0.2, 0.2, 0.2, 0.9}};
  const Capsule capsule = {{0.2, 0.2}, {0.4, 0.4}, 0.1, kPaint};
  picture_.add(capsule);
  picture_.add(capsule, 0);
  picture_.add(capsule, 1);  // an empty clip shows nothing
  batch_.set(picture_);
  ASSERT_EQ(batch_.runs().size(), 2u);
  EXPECT_EQ(batch_.runs()[1].clip, (PixelBox{0, kSide / 2, kSide / 2, kSide}));
}

TEST_F(BatchTest, WhatCannotBeSeenIsLeftOut) {
  picture_.add(Capsule{{1.5, 0.5}, {2.5, 0.5}, 0.1, kPaint});
  picture_.add(Capsule{{0.5, 0.5}, {0.6, 0.5}, 0.1, {color_of(0, 0), color_of(0, 1), 0}});
  picture_.add(Polygon{{{{0.1, 0.1}, {0.2, 0.2}}}, 2, kPaint});
  picture_.add(Trail{{}, kBlack});
  picture_.add(Trail{{TrailPoint{{0.5, 0.5}, 0.1, 0}, TrailPoint{{0.6, 0.5}, 0.1, 0}}, kBlack});
  picture_.add(GlyphRun{Face::label, 0.05, {3, 0.5}, {Glyph{36, 0, 0}}, kBlack, "A"});
  batch_.set(picture_);
  EXPECT_TRUE(batch_.runs().empty());
  picture_.add(Capsule{{0.5, 0.5}, {0.6, 0.5}, 0.1, kPaint});  // negative control
  batch_.set(picture_);
  EXPECT_EQ(batch_.runs().size(), 1u);
}

TEST_F(BatchTest, DiscsAreCapsulesSoThatTheyShareTheirRuns) {
  picture_.add(Capsule{{0.2, 0.2}, {0.4, 0.4}, 0.1, kPaint});
  picture_.add(Ellipse{{0.2, 0.2}, {0.05, 0}, {0, 0.05}, kPaint});
  batch_.set(picture_);
  ASSERT_EQ(batch_.runs().size(), 1u);
  EXPECT_EQ(batch_.runs()[0].count, 2);
}

TEST(TileMask, BoxesCoverTheSegmentOnceAndNotThePage) {
  constexpr int kWidth = 500, kHeight = 300;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-100, 600), reach(0.5, 20);
  for (int i = 0; i < 50; ++i) {
    const double ax = place(random), ay = place(random), bx = place(random), by = place(random),
                 r = reach(random);
    TileMask mask(kWidth, kHeight);
    mask.mark_segment(ax, ay, bx, by, r);
    std::vector<PixelBox> boxes;
    const PixelBox clip = {13, 7, 481, 290};
    mask.boxes(clip, boxes);
    std::vector<int> hits(std::size_t(kWidth) * kHeight);
    for (const PixelBox& box : boxes)
      for (int y = box.top; y < box.bottom; ++y)
        for (int x = box.left; x < box.right; ++x) ++hits[std::size_t(y) * kWidth + std::size_t(x)];
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double px = x + 0.5 - ax, py = y + 0.5 - ay, sx = bx - ax, sy = by - ay;
        const double t = std::clamp((px * sx + py * sy) / (sx * sx + sy * sy), 0.0, 1.0);
        const double d = std::hypot(px - t * sx, py - t * sy);
        const bool in_clip = x >= clip.left && x < clip.right && y >= clip.top && y < clip.bottom;
        const int hit = hits[std::size_t(y) * kWidth + std::size_t(x)];
        const bool must_hit = in_clip && d <= r, may_hit = in_clip && d <= r + 2 * TileMask::kSide;
        ASSERT_GE(hit, must_hit ? 1 : 0) << x << " " << y;
        ASSERT_LE(hit, may_hit ? 1 : 0) << x << " " << y;
      }
  }
}

}  // namespace
}  // namespace chainreel

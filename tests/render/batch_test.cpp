// Shapes as streams of numbers, before any OpenGL.
#include "render/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "render/drawing.hpp"
#include "render/windows.hpp"

namespace chainreel {
namespace {

const Paint kPaint = {kBlack, kNothing, 0};

class BatchTest : public ::testing::Test {
 protected:
  GlyphAtlas atlas_{fonts(), 4096};
  Batch batch_{kSide, kSide, atlas_};
  Picture picture_;

  Windows whole_page() {
    TileMask tiles(kSide, kSide);
    tiles.fill();
    batch_.set(picture_);
    Windows windows;
    windows.set(batch_, tiles);
    return windows;
  }
};

TEST_F(BatchTest, NeighboursOfOneKindAreOneRun) {
  const Capsule capsule = {{0.2, 0.2}, {0.4, 0.4}, 0.1, kPaint};
  const Arc arc = {{0.5, 0.5}, 0.2, 0, 1, 0.01, kBlack};
  for (const Shape& shape : std::initializer_list<Shape>{capsule, capsule, arc, capsule}) picture_.add(shape);
  const Windows windows = whole_page();
  ASSERT_EQ(windows.runs().size(), 3u);
  EXPECT_EQ(windows.runs()[2].primitive, Primitive::capsule);
  EXPECT_EQ(windows.runs()[0].count, 2 * windows.runs()[2].count);
  EXPECT_EQ(windows.runs()[2].first, windows.runs()[0].count);
  EXPECT_EQ(windows.instances(Primitive::capsule).size(),
            std::size_t(3 * windows.runs()[2].count * Windows::floats_of(Primitive::capsule)));
}

TEST_F(BatchTest, AClipCutsTheWindows) {
  picture_.clips = {{0, 0, 0.5, 0.5}, {0.2, 0.2, 0.2, 0.9}};
  const Capsule capsule = {{0.2, 0.2}, {0.4, 0.4}, 0.1, kPaint};
  picture_.add(capsule);
  picture_.add(capsule, 0);
  picture_.add(capsule, 1);  // an empty clip shows nothing
  batch_.set(picture_);
  ASSERT_EQ(batch_.pieces().size(), 2u);
  const PixelBox clip = {0, kSide / 2, kSide / 2, kSide / 2};
  EXPECT_EQ(batch_.pieces()[1].outline.box, common_part(batch_.pieces()[0].outline.box, clip));
  EXPECT_NE(batch_.pieces()[0].look, batch_.pieces()[1].look);
}

TEST_F(BatchTest, WhatCannotBeSeenIsLeftOut) {
  picture_.add(Capsule{{1.5, 0.5}, {2.5, 0.5}, 0.1, kPaint});
  picture_.add(Capsule{{0.5, 0.5}, {0.6, 0.5}, 0.1, {color_of(0, 0), color_of(0, 1), 0}});
  picture_.add(Polygon{{{{0.1, 0.1}, {0.2, 0.2}}}, 2, kPaint});
  picture_.add(Trail{{}, kBlack});
  picture_.add(Trail{{TrailPoint{{0.5, 0.5}, 0.1, 0}, TrailPoint{{0.6, 0.5}, 0.1, 0}}, kBlack});
  picture_.add(GlyphRun{Face::label, 0.05, {3, 0.5}, {Glyph{36, 0, 0}}, kBlack, "A"});
  EXPECT_TRUE(whole_page().runs().empty());
  picture_.add(Capsule{{0.5, 0.5}, {0.6, 0.5}, 0.1, kPaint});  // negative control
  EXPECT_EQ(whole_page().runs().size(), 1u);
}

TEST_F(BatchTest, DiscsAreCapsulesSoThatTheyShareTheirRuns) {
  picture_.add(Capsule{{0.2, 0.2}, {0.4, 0.4}, 0.1, kPaint});
  picture_.add(Ellipse{{0.2, 0.2}, {0.05, 0}, {0, 0.05}, kPaint});
  EXPECT_EQ(whole_page().runs().size(), 1u);
  EXPECT_EQ(batch_.pieces().size(), 2u);
}

TEST_F(BatchTest, GlyphsAreToldApartByWhatTheyAreNotByTheirPlaceInTheAtlas) {
  GlyphAtlas other(fonts(), 4096);
  Batch elsewhere(kSide, kSide, other);
  const auto letter = [](std::uint32_t index) { return GlyphRun{Face::label, 0.05, {0.5, 0.5}, {Glyph{index, 0, 0}}, kBlack, "?"}; };
  picture_.add(letter(36));
  batch_.set(picture_);
  Picture two;
  two.add(letter(40));
  two.add(letter(36));
  elsewhere.set(two);
  ASSERT_EQ(elsewhere.pieces().size(), 2u);
  // The first glyph stands at the same place of its atlas as the first of the other; the second is the same letter.
  EXPECT_NE(batch_.pieces()[0].look, elsewhere.pieces()[0].look);
  EXPECT_EQ(batch_.pieces()[0].look, elsewhere.pieces()[1].look);
}

// What a shape colours outside of its columns would be lost; where it is said to be even it must be.
class OutlineTest : public ::testing::Test {
 protected:
  static constexpr int kPage = 300;
  std::mt19937 random_{5};

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  // How deep each pixel's middle lies outside of the shape's edge, from below and from above; negative inside.
  struct Depth {
    double least, most;
  };

  void check(const Outline& o, const float* numbers, const std::function<Depth(double, double)>& depth_at) {
    for (const int height : {1, 7, 32})
      for (int top = 0; top < kPage; top += height) {
        const int bottom = std::min(kPage, top + height);
        const Spans spans = o.spans(top, bottom, numbers);
        for (int y = top; y < bottom; ++y)
          for (int x = 0; x < kPage; x += 3) {
            const Depth depth = depth_at(x + 0.5, y + 0.5);
            const bool is_outer = x >= spans.left && x < spans.right;
            const bool is_inner = is_outer && x >= spans.inner_left && x < spans.inner_right;
            if (!is_outer) ASSERT_GT(depth.most, o.reach) << x << " " << y;
            if (is_inner && o.kind != Outline::Kind::ring) ASSERT_LT(depth.least, -o.reach) << x << " " << y;
            if (is_inner && o.kind == Outline::Kind::ring) ASSERT_GT(depth.least, o.reach) << x << " " << y;
          }
      }
  }
};

TEST_F(OutlineTest, HoldsSegmentsAndRings) {
  for (int i = 0; i < 40; ++i) {
    const double phi = i == 0 ? 0 : i == 1 ? 1.5707963267948966 : number(0, 6.3);
    const Outline o = {Outline::Kind::segment, {0, 0, kPage, kPage}, number(-40, 340), number(-40, 340), std::cos(phi),
                       std::sin(phi), number(0, 300), 0, number(0.5, 20)};
    check(o, nullptr, [&](double x, double y) {
      const double along = (x - o.x) * o.u + (y - o.y) * o.v;
      const double d = std::hypot(x - o.x - std::clamp(along, 0.0, o.a) * o.u, y - o.y - std::clamp(along, 0.0, o.a) * o.v);
      return Depth{d, d};
    });
    const Outline ring = {Outline::Kind::ring, o.box, o.x, o.y, 1, 0, o.a, 0, o.reach};
    check(ring, nullptr, [&](double x, double y) {
      const double d = std::abs(std::hypot(x - ring.x, y - ring.y) - ring.a);
      return Depth{d, d};
    });
  }
}

TEST_F(OutlineTest, HoldsEllipses) {
  for (int i = 0; i < 60; ++i) {
    const double phi = i == 0 ? 0 : i == 1 ? 1.5707963267948966 : number(0, 6.3), b = std::pow(10, number(-1, 2.3));
    const double a = b * std::pow(10, number(0, 1.5));
    const Outline o = {Outline::Kind::ellipse, {0, 0, kPage, kPage}, number(-40, 340), number(-40, 340), std::cos(phi),
                       std::sin(phi), a, b, number(0.5, 20)};
    check(o, nullptr, [&](double x, double y) {
      const double along = (x - o.x) * o.u + (y - o.y) * o.v, across = (y - o.y) * o.u - (x - o.x) * o.v;
      // From the edge away by between |level - 1| b and |level - 1| a, level that of the scaled ellipse through it.
      const double level = std::hypot(along / a, across / b) - 1;
      return Depth{std::min(level * a, level * b), std::max(level * a, level * b)};
    });
  }
}

TEST_F(OutlineTest, HoldsPolygons) {
  for (int i = 0; i < 60; ++i) {
    // Corners on an ellipse, some of them twice or on an edge, in the sense of growing angle.
    std::array<float, 16> corners{};
    const double x = number(0, 300), y = number(0, 300), a = number(5, 200), b = number(1, 200);
    const int count = 3 + i % 6;
    for (int k = 0; k < 8; ++k) {
      const double angle = 6.283185307179586 * std::min(k, count - 1) / count;
      corners[std::size_t(2 * k)] = float(x + a * std::cos(angle));
      corners[std::size_t(2 * k + 1)] = float(y + b * std::sin(angle));
    }
    const Outline o = {.kind = Outline::Kind::polygon, .box = {0, 0, kPage, kPage}, .reach = number(0.5, 20)};
    check(o, corners.data(), [&](double px, double py) {
      double outside = -HUGE_VAL;
      for (std::size_t k = 0; k < 8; ++k) {
        const double ax = corners[2 * k], ay = corners[2 * k + 1], bx = corners[(2 * k + 2) % 16], by = corners[(2 * k + 3) % 16];
        const double length = std::hypot(bx - ax, by - ay);
        if (length > 0) outside = std::max(outside, ((by - ay) * (px - ax) - (bx - ax) * (py - ay)) / length);
      }
      // At a corner the distance is larger than that of the lines through it.
      return Depth{outside, outside > 0 ? HUGE_VAL : outside};
    });
  }
}

TEST(TileMask, BoxesCoverTheTilesOnceAndJoinRowsThatAreAlike) {
  constexpr int kWidth = 500, kHeight = 300;
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    TileMask mask(kWidth, kHeight);
    for (int row = 0; row < mask.rows(); ++row)
      for (int column = 0; column < mask.columns(); ++column)
        if (random() % 3 == 0) mask.mark(column, row);
    for (int row = 140 / TileMask::kSide; row < 5; ++row)
      for (int column = 0; column < 5; ++column) mask.mark(column, row);
    std::vector<PixelBox> boxes;
    const PixelBox clip = {13, 7, 468, 283};
    mask.boxes(clip, boxes);
    std::vector<int> hits(std::size_t(kWidth) * kHeight);
    for (const PixelBox& box : boxes)
      for (int y = box.y; y < box.bottom(); ++y)
        for (int x = box.x; x < box.right(); ++x) ++hits[std::size_t(y) * kWidth + std::size_t(x)];
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool in_clip = x >= clip.x && x < clip.right() && y >= clip.y && y < clip.bottom();
        const bool wanted = in_clip && mask.at(x / TileMask::kSide, y / TileMask::kSide);
        ASSERT_EQ(hits[std::size_t(y) * kWidth + std::size_t(x)], wanted ? 1 : 0) << x << " " << y;
      }
  }
  TileMask page(kWidth, kHeight);
  page.fill();
  std::vector<PixelBox> boxes;
  page.boxes({0, 0, kWidth, kHeight}, boxes);
  EXPECT_EQ(boxes, std::vector<PixelBox>({{0, 0, kWidth, kHeight}}));
}

}  // namespace
}  // namespace chainreel

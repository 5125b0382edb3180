// The canvas as a whole: clips, layers, opacity, limits, and the same bytes every time.
#include "render/canvas.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <thread>

#include "core/error.hpp"
#include "render/drawing.hpp"
#include "render/test_card.hpp"

namespace chainreel {
namespace {

constexpr int kWidth = 640, kHeight = 360;

const Picture& card() {
  static const Picture picture = test_card(fonts(), light_theme());
  return picture;
}

Image drawn(const Picture& picture, int width = kWidth, int height = kHeight) {
  Canvas canvas(width, height, fonts());
  Image image;
  canvas.draw(picture, image);
  return image;
}

TEST(Canvas, TheSamePictureGivesTheSameBytes) {
  Canvas one(kWidth, kHeight, fonts()), other(kWidth, kHeight, fonts());
  Image first, second, third, between;
  one.draw(card(), first);
  one.draw(test_card(fonts(), dark_theme()), between);
  one.draw(card(), second);
  other.draw(card(), third);
  EXPECT_EQ(first.bgra, second.bgra);
  EXPECT_EQ(first.bgra, third.bgra);
  EXPECT_NE(first.bgra, between.bgra);  // negative control: another theme is noticed
}

TEST(Canvas, EveryThreadMayHaveItsOwn) {
  const Image expected = drawn(card());
  std::array<Image, 3> images;
  std::vector<std::thread> threads;
  for (Image& image : images)
    threads.emplace_back([&image] {
      Canvas canvas(kWidth, kHeight, fonts());
      for (int i = 0; i < 3; ++i) canvas.draw(card(), image);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Image& image : images) EXPECT_EQ(image.bgra, expected.bgra);
}

TEST(Canvas, AStaticLayerChangesNoByte) {
  const Image expected = drawn(card());
  for (const std::size_t part : {std::size_t(0), std::size_t(7), std::size_t(20), card().items.size()}) {
    Picture below = card(), above = card();
    below.items.resize(part);
    above.items.erase(above.items.begin(), above.items.begin() + std::ptrdiff_t(part));
    above.background = color_of(0xFF00FF);  // not to be seen: the layer has its own
    Canvas canvas(kWidth, kHeight, fonts());
    canvas.set_static_layer(below);
    Image image;
    canvas.draw(card(), image);  // what is drawn once must not stay
    canvas.draw(above, image);
    EXPECT_EQ(image.bgra, expected.bgra) << part;
  }
}

TEST(Canvas, AClipCutsAtTheNearestPixelAndNowhereElse) {
  const Ellipse disc = {at_px(64, 64), {50 * kPx, 0}, {0, 50 * kPx}, {kBlack, color_of(0xFF0000), 3 * kPx}};
  Picture clipped;
  clipped.clips.push_back({30.4 * kPx, 1 - 70.3 * kPx, 80.6 * kPx, 1 - 20.7 * kPx});
  clipped.add(disc, 0);
  const Image cut = drawn(clipped, kSide, kSide), whole = draw_items({disc});
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool is_inside = x >= 30 && x < 81 && y >= 21 && y < 70;
      ASSERT_EQ(cut.at(x, y), is_inside ? whole.at(x, y) : (Pixel{255, 255, 255, 255})) << x << " " << y;
    }
}

TEST(Canvas, ClipsHoldForTrailsAndText) {
  Picture all = card(), clipped = card();
  clipped.clips.push_back({0.2, 0.1, 0.7, 0.95});
  for (Item& item : clipped.items) item.clip = int(clipped.clips.size()) - 1;
  for (Item& item : all.items) item.clip = -1;
  const Image cut = drawn(clipped), whole = drawn(all);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool is_inside = x >= 72 && x < 252 && y >= 18 && y < 324;
      ASSERT_EQ(cut.at(x, y), is_inside ? whole.at(x, y) : (Pixel{255, 255, 255, 255})) << x << " " << y;
    }
}

TEST(Canvas, WithoutBackgroundOpacityIsStraight) {
  const Ellipse red = {at_px(64, 64), {30.3 * kPx, 0}, {0, 30.3 * kPx}, {color_of(0xFF8000), kNothing, 0}};
  const Image image = draw_items({red}, kNothing);
  EXPECT_EQ(image.at(64, 64), (Pixel{0xFF, 0x80, 0x00, 255}));
  EXPECT_EQ(image.at(2, 2).a, 0);
  int edges = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Pixel p = image.at(x, y);
      if (p.a < 16 || p.a == 255) continue;
      ++edges;
      // The colour of the edge is the disc's; 8 bits of colour times opacity leave half a level over the
      // opacity.
      EXPECT_NEAR(p.r, 0xFF, 0.5 * 255 / p.a + 1);
      EXPECT_NEAR(p.g, 0x80, 0.5 * 255 / p.a + 1);
      EXPECT_NEAR(p.b, 0x00, 0.5 * 255 / p.a + 1);
    }
  EXPECT_GT(edges, 100);
}

TEST(Canvas, OpacitiesAddUpOverATranslucentBackground) {
  const Ellipse black = {at_px(64, 64), {30 * kPx, 0}, {0, 30 * kPx}, {color_of(0x000000, 0.5), kNothing, 0}};
  const Image image = draw_items({black}, color_of(0xFFFFFF, 0.5));
  // Half black over half white: opacity 3/4, a third of the colour from below.
  EXPECT_NEAR(image.at(64, 64).a, 0.75 * 255, 1);
  EXPECT_NEAR(image.at(64, 64).r, 255 / 3.0, 2);
  EXPECT_NEAR(image.at(2, 2).a, 0.5 * 255, 1);
  EXPECT_EQ(image.at(2, 2).r, 255);
}

TEST(Canvas, AnOpaqueBackgroundStaysOpaque) {
  const Image image = drawn(card());
  for (std::size_t i = 3; i < image.bgra.size(); i += 4) ASSERT_EQ(image.bgra[i], 255);
}

TEST(Canvas, ShapesThatAreNotNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Paint paint = {kBlack, kBlack, 0.01};
  for (const double bad : {nan, inf, -inf, 1e300}) {
    const Image image = draw_items(
        {Capsule{{bad, 0.5}, {0.5, bad}, 0.1, paint},
         Capsule{{0.4, 0.5}, {0.5, 0.5}, bad == 1e300 ? nan : bad, paint},
         Ellipse{{bad, bad}, {0.1, 0}, {0, 0.05}, paint}, Ellipse{{0.5, 0.5}, {nan, 0}, {0, 0.05}, paint},
         Arc{{0.5, 0.5}, 0.2, bad == 1e300 ? nan : bad, 1, 0.01, kBlack},
         Polygon{{{{0.1, 0.1}, {0.9, 0.1}, {nan, 0.9}}}, 3, paint},
         Trail{{TrailPoint{{nan, 0.5}, 0.1, 1}, TrailPoint{{0.5, bad}, 0.1, 1}}, kBlack},
         GlyphRun{Face::label, 0.1, {bad, 0.5}, {Glyph{36, 0, 0}}, kBlack, "A"}});
    EXPECT_EQ(covered_area(image), 0) << bad;
  }
}

TEST(Canvas, ALineThatComesFromFarAwayIsStillStraight) {
  const Paint paint = {kBlack, kNothing, 0};
  const auto line = [&](double reach) {
    const Point a = at_px(64 - reach * 0.8, 64 - reach * 0.6), b = at_px(64 + reach * 0.8, 64 + reach * 0.6);
    return draw_items({Capsule{a, b, 3 * kPx, paint, 1, 1}});
  };
  const Image near = line(300);
  EXPECT_GT(covered_area(near), 128 * 6);
  for (const double far : {1e4, 1e6, 1e9}) EXPECT_LE(largest_difference(line(far), near), 2) << far;
  EXPECT_GT(largest_difference(line(30), near), 200);  // negative control: a short one ends on the page
}

TEST(Canvas, SizesBeyondTheLimitsAreRefused) {
  for (const auto& [width, height] : {std::pair(0, 10), std::pair(10, -1), std::pair(1000000, 10)}) {
    try {
      Canvas(width, height, fonts()).draw(Picture{});
      ADD_FAILURE() << width << "x" << height;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::limit);
      EXPECT_THAT(error.what(), testing::HasSubstr(std::to_string(width)));
    }
  }
  EXPECT_NO_THROW(Canvas(1, 1, fonts()));
}

TEST(Canvas, AnySizeHasItsRowsInOrder) {
  // Sizes that are no multiple of anything: a mark in the upper left corner, none elsewhere.
  for (const auto& [width, height] : {std::pair(101, 33), std::pair(7, 250)}) {
    Picture picture;
    const double px = 1.0 / height;
    picture.add(
        Polygon{{{{0, 1}, {3 * px, 1}, {3 * px, 1 - 2 * px}, {0, 1 - 2 * px}}}, 4, {kBlack, kNothing, 0}});
    const Image image = drawn(picture, width, height);
    ASSERT_EQ(image.bgra.size(), std::size_t(4 * width * height));
    EXPECT_NEAR(covered_area(image), 6, 0.05);  // corners at thirds of a binary fraction
    EXPECT_GT(darkness(image, 2, 1), 0.99);
  }
}

// What lies under all that moves is drawn by one renderer, the rest by the other: together the bytes of one.
TEST(Canvas, FixedItemsAreDrawnFirstAndLeaveTheBytesAsTheyAre) {
  for (const double opacity : {1.0, 0.3}) {
    Picture picture;
    picture.background = color_of(0x204060, opacity);
    picture.add(Polygon{{{{0.1, 0.1}, {1.6, 0.2}, {0.8, 0.9}, {0.2, 0.7}}}, 4, {color_of(0xFF8000, 0.7), kBlack, 0.02}});
    picture.add(Ellipse{{0.9, 0.5}, {0.4, 0.1}, {-0.1, 0.3}, {color_of(0x00FF00, 0.4), {}, 0}});
    picture.add(Capsule{{0.3, 0.3}, {1.2, 0.8}, 0.05, {color_of(0x0000FF, 0.6), kBlack, 0.01}});
    const Image whole = drawn(picture, 160, 90);
    Canvas canvas(160, 90, fonts());
    for (picture.fixed = 0; picture.fixed <= picture.items.size(); ++picture.fixed)
      EXPECT_EQ(canvas.draw(picture).image.bgra, whole.bgra) << picture.fixed;
    picture.items.erase(picture.items.begin());
    picture.fixed = 1;
    EXPECT_NE(canvas.draw(picture).image.bgra, whole.bgra);  // nothing is kept of the picture before
  }
}

TEST(Canvas, WhatFailsWhileItComesIsToldByWhoDraws) {
  ComingRenderer coming(16, 16, PageUse::film, [] { throw Error(ExitCode::no_renderer, "none is there"); });
  Canvas canvas(std::move(coming), fonts());
  EXPECT_THROW(canvas.draw(Picture{}), Error);
  EXPECT_NO_THROW(canvas.draw(Picture{})) << "who tries again has another one";
}

TEST(Canvas, RendererHasAName) {
  const RendererInfo info = Canvas(16, 16, fonts()).info();
  EXPECT_FALSE(info.backend.empty());
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_GE(std::atof(info.version.c_str()), 3.3);
  EXPECT_EQ(Canvas(8, 8, fonts()).info().renderer, info.renderer);
  EXPECT_EQ(Canvas(8, 8, fonts(), PageUse::still).info().backend, "none");
}

}  // namespace
}  // namespace chainreel

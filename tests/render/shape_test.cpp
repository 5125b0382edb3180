// Each primitive by named pixels, by its area and by symmetry.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "picture/theme.hpp"
#include "render/drawing.hpp"

namespace chainreel {
namespace {

using std::numbers::pi;

const Paint kBlackFill = {kBlack, kNothing, 0};

Ellipse disc(double x, double y, double radius_px, const Paint& paint) {
  return {at_px(x, y), {radius_px * kPx, 0}, {0, radius_px * kPx}, paint};
}

Polygon rectangle(double left, double top, double right, double bottom, const Paint& paint) {
  return {{{at_px(left, top), at_px(right, top), at_px(right, bottom), at_px(left, bottom)}}, 4, paint};
}

// The edge's ramp is one pixel wide: along a straight edge its two halves cancel, along a circle of radius r
// the outer half has more room by 2 pi / 24 px^2 on either side. What remains is how the pixel grid samples
// the ramp, below 1/100 of a pixel for each pixel of the edge and of changing sign, and 8-bit rounding.
double area_tolerance(double perimeter) {
  return pi / 12 + 0.1 * std::sqrt(perimeter);
}

class Places {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  std::mt19937 random_{7};
};

TEST(Shapes, CapsulesCoverTheirArea) {
  Places place;
  for (int i = 0; i < 40; ++i) {
    const double ax = place(30, 98), ay = place(30, 98), bx = place(30, 98), by = place(30, 98),
                 r = place(0.5, 25);
    const double length = std::hypot(bx - ax, by - ay);
    const Image image = draw_items({Capsule{at_px(ax, ay), at_px(bx, by), r * kPx, kBlackFill}});
    EXPECT_NEAR(covered_area(image), pi * r * r + 2 * r * length, area_tolerance(2 * pi * r + 2 * length));
  }
}

TEST(Shapes, DiscsAndEllipsesCoverTheirArea) {
  Places place;
  for (int i = 0; i < 40; ++i) {
    const double a = place(2, 50), b = place(1, a), angle = place(0, 2 * pi);
    const Point u = {a * kPx * std::cos(angle), a * kPx * std::sin(angle)}, v = (b / a) * Point{-u.y, u.x};
    const Image image = draw_items({Ellipse{at_px(place(60, 68), place(60, 68)), u, v, kBlackFill}});
    EXPECT_NEAR(covered_area(image), pi * a * b, area_tolerance(2 * pi * a)) << a << " " << b;
  }
}

TEST(Shapes, AStrokeCoversItsBand) {
  const double r = 30.3, half = 2.2;
  const Image image = draw_items({disc(64.2, 63.9, r, {kNothing, kBlack, 2 * half * kPx})});
  EXPECT_NEAR(covered_area(image), 4 * pi * r * half, area_tolerance(4 * pi * r));
  EXPECT_EQ(darkness(image, 64, 64), 0);
}

TEST(Shapes, PolygonsCoverTheirAreaEitherWayRound) {
  Places place;
  for (int corners = 3; corners <= 8; ++corners) {
    const double radius = place(10, 50), turn = place(0, 1);
    Polygon polygon;
    polygon.count = corners;
    polygon.paint = kBlackFill;
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + 2 * pi * i / corners;
      polygon.corners[std::size_t(i)] = at_px(64 + radius * std::cos(angle), 64 + radius * std::sin(angle));
    }
    const Image image = draw_items({polygon});
    const double area = corners * radius * radius * std::sin(2 * pi / corners) / 2;
    EXPECT_NEAR(covered_area(image), area, area_tolerance(2 * pi * radius)) << corners;
    std::reverse(polygon.corners.begin(), polygon.corners.begin() + corners);
    // The same corners start another edge's arithmetic: one level of rounding.
    EXPECT_LE(largest_difference(draw_items({polygon}), image), 1);
  }
}

TEST(Shapes, ArcsCoverTheirBandAndTwoRoundEnds) {
  Places place;
  for (const double sweep : {0.0, 0.4, pi, -2.0, 4.5, 2 * pi}) {
    const double r = place(20, 40), half = place(1, 5);
    const Image image = draw_items({Arc{at_px(64.3, 63.6), r * kPx, 1.1, sweep, 2 * half * kPx, kBlack}});
    const double ends = std::abs(sweep) < 2 * pi ? pi * half * half : 0;
    EXPECT_NEAR(covered_area(image), 2 * half * r * std::abs(sweep) + ends,
                area_tolerance(2 * r * std::abs(sweep) + 2 * pi * half))
        << sweep;
  }
}

TEST(Shapes, AShapeOnePercentLargerHasAnotherArea) {
  // Negative control of the tolerances above.
  const Image image = draw_items({disc(64, 64, 40 * 1.01, kBlackFill)});
  EXPECT_GT(std::abs(covered_area(image) - pi * 40 * 40), area_tolerance(2 * pi * 40));
}

TEST(Shapes, InsideIsFillTheEdgeIsStrokeOutsideIsBackground) {
  const Theme& theme = light_theme();
  const Paint paint = {theme.link[0], theme.ink, 4 * kPx};
  const auto pixel = [](const Color& c) { return Pixel{c.r, c.g, c.b, 255}; };
  const std::pair<Shape, const char*> shapes[] = {
      {Capsule{at_px(40, 64), at_px(88, 64), 20 * kPx, paint}, "capsule"},
      {Ellipse{at_px(64, 64), {44 * kPx, 0}, {0, 20 * kPx}, paint}, "ellipse"},
      {rectangle(20, 44, 108, 84, paint), "polygon"},
  };
  for (const auto& [shape, name] : shapes) {
    const Image image = draw_items({shape});
    // The upper edge is at y = 44, the stroke reaches from 42 to 46: its ramps end half a pixel beyond.
    EXPECT_EQ(image.at(64, 64), pixel(theme.link[0])) << name;
    EXPECT_EQ(image.at(64, 47), pixel(theme.link[0])) << name;
    EXPECT_EQ(image.at(64, 44), pixel(theme.ink)) << name;
    EXPECT_EQ(image.at(64, 43), pixel(theme.ink)) << name;
    EXPECT_EQ(image.at(64, 40), pixel(color_of(0xFFFFFF))) << name;
    EXPECT_EQ(image.at(2, 2), pixel(color_of(0xFFFFFF))) << name;
  }
}

TEST(Shapes, FlatColorsAreExact) {
  for (const Theme* theme : {&light_theme(), &dark_theme()})
    for (const Color& c :
         {theme->ink, theme->link[1], theme->ellipse, theme->torque, theme->velocity, theme->grid}) {
      const Image image = draw_items({disc(64, 64, 20, {c, kNothing, 0})}, theme->background);
      EXPECT_EQ(image.at(64, 64), (Pixel{c.r, c.g, c.b, 255}));
      EXPECT_EQ(image.at(0, 127),
                (Pixel{theme->background.r, theme->background.g, theme->background.b, 255}));
    }
}

TEST(Shapes, TranslucentFillsMixWithTheBackground) {
  const Image image = draw_items({disc(64, 64, 20, {color_of(0x000000, 0.25), kNothing, 0})});
  EXPECT_NEAR(image.at(64, 64).r, 0.75 * 255, 1);  // 8-bit rounding of colour and of opacity
  EXPECT_EQ(image.at(64, 64).a, 255);
}

// A stroke lies half on its fill and half beside it, and what is translucent shows which.
TEST(Shapes, FillsShineThroughTranslucentStrokes) {
  const Paint paint = {color_of(0xFF0000), color_of(0x0000FF, 0.5), 8 * kPx};
  const std::pair<Shape, const char*> shapes[] = {
      {Capsule{at_px(40, 64), at_px(88, 64), 20 * kPx, paint}, "capsule"},
      {Ellipse{at_px(64, 64), {44 * kPx, 0}, {0, 20 * kPx}, paint}, "ellipse"},
      {rectangle(20, 44, 108, 84, paint), "polygon"},
  };
  for (const auto& [shape, name] : shapes) {
    const Image image = draw_items({shape});
    // The upper edge is at y = 44, the stroke reaches from 40 to 48; 8-bit rounding of colour and of opacity.
    EXPECT_EQ(image.at(64, 50), (Pixel{255, 0, 0, 255})) << name;
    const Pixel inside = image.at(64, 45), outside = image.at(64, 42);
    EXPECT_NEAR(inside.r, 127.5, 1.5) << name;
    EXPECT_EQ(inside.g, 0) << name;
    EXPECT_NEAR(inside.b, 127.5, 1.5) << name;
    EXPECT_NEAR(outside.r, 127.5, 1.5) << name;
    EXPECT_NEAR(outside.g, 127.5, 1.5) << name;
    EXPECT_EQ(outside.b, 255) << name;
  }
}

TEST(Shapes, NoBackgroundShinesThroughBetweenFillAndStroke) {
  // Black over black must be black wherever both are, at every place of the edge between pixels.
  Places place;
  for (int i = 0; i < 10; ++i) {
    const Image image = draw_items({disc(64 + place(0, 1), 64 + place(0, 1), 30, {kBlack, kBlack, 3 * kPx})});
    for (int x = 36; x < 92; ++x) EXPECT_EQ(darkness(image, x, 64), 1) << x;
  }
}

TEST(Shapes, RectanglesOnWholePixelsHaveSharpEdges) {
  const Image image = draw_items({rectangle(20, 30, 50, 60, kBlackFill)});
  EXPECT_EQ(darkness(image, 20, 30), 1);
  EXPECT_EQ(darkness(image, 49, 59), 1);
  EXPECT_EQ(darkness(image, 19, 45), 0);
  EXPECT_EQ(darkness(image, 50, 45), 0);
  EXPECT_EQ(covered_area(image), 30 * 30);
}

Image mirrored(const Image& image, bool sideways) {
  Image result(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int from_x = sideways ? image.width - 1 - x : x, from_y = sideways ? y : image.height - 1 - y;
      for (int k = 0; k < 4; ++k)
        result.bgra[std::size_t(4 * (y * image.width + x) + k)] =
            image.bgra[std::size_t(4 * (from_y * image.width + from_x) + k)];
    }
  return result;
}

TEST(Shapes, SymmetricShapesGiveSymmetricPixels) {
  const Paint paint = {color_of(0x3366CC, 0.7), kBlack, 3 * kPx};
  const Shape shapes[] = {
      disc(64, 64, 33.3, paint),
      Ellipse{at_px(64, 64), {50.7 * kPx, 0}, {0, 13.1 * kPx}, paint},
      Ellipse{at_px(64, 64), {0, 50.7 * kPx}, {13.1 * kPx, 0}, paint},
      Capsule{at_px(24.4, 64), at_px(103.6, 64), 9.9 * kPx, paint},
      rectangle(30.3, 50.2, 97.7, 77.8, paint),
      Arc{at_px(64, 64), 40 * kPx, 0, 2 * pi, 5.5 * kPx, kBlack},
  };
  for (const Shape& shape : shapes) {
    const Image image = draw_items({shape});
    // Corners lie symmetrically up to single precision: one level of rounding.
    EXPECT_LE(largest_difference(image, mirrored(image, true)), 1) << shape.index();
    EXPECT_LE(largest_difference(image, mirrored(image, false)), 1) << shape.index();
  }
  const Image off_center = draw_items({disc(64.3, 64, 33.3, paint)});  // negative control
  EXPECT_GT(largest_difference(off_center, mirrored(off_center, true)), 20);
}

TEST(Shapes, AnglesOfArcsGrowCounterClockwise) {
  const Image image = draw_items({Arc{at_px(64, 64), 40 * kPx, 0.2, 1.0, 6 * kPx, kBlack}});
  EXPECT_EQ(darkness(image, int(64 + 40 * std::cos(0.7)), int(64 - 40 * std::sin(0.7))), 1);  // up is up
  EXPECT_EQ(darkness(image, int(64 + 40 * std::cos(0.7)), int(64 + 40 * std::sin(0.7))), 0);
}

TEST(Shapes, NoLineIsThinnerThanAPixel) {
  for (const double slope : {0.0, 0.3, 1.0}) {
    const Image image =
        draw_items({Capsule{at_px(10, 20.3), at_px(110, 20.3 + 100 * slope), 1e-6 * kPx, kBlackFill}});
    // Across the line, one pixel; down a column, that over the cosine of the slope.
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 40; x < 80; ++x) sum += darkness(image, x, y);
    // The grid samples a triangle two pixels wide at distances of 0.7 to 1 pixel.
    EXPECT_NEAR(sum / 40, std::sqrt(1 + slope * slope), 0.05);
  }
}

TEST(Shapes, OpacityOfACapsuleRunsFromEndToEnd) {
  const Image image = draw_items({Capsule{at_px(14, 64), at_px(114, 64), 5 * kPx, kBlackFill, 0.9, 0.1}});
  for (int x = 14; x < 114; ++x)
    EXPECT_NEAR(darkness(image, x, 64), 0.9 - 0.8 * (x + 0.5 - 14) / 100, 1.0 / 255);
  EXPECT_NEAR(darkness(image, 11, 64), 0.9, 1.0 / 255);  // the round ends have the opacity of theirs
}

// Wherever its windows are cut: the part of a shape that is shaded has the bytes of what is filled evenly beside it.
TEST(Shapes, FadeTowardsTheEdgesOfAPartOfThePage) {
  Fade fade{{10 * kPx, 0, 1 - 20 * kPx, 1}};
  fade.left = 50 * kPx, fade.bottom = 40 * kPx;
  const Point middle = at_px(64, 64);
  const Paint paint{kBlack, {}, 0};
  for (const Shape& shape : std::initializer_list<Shape>{
           Ellipse{middle, {2, 0}, {0, 1.5}, paint, fade}, Ellipse{middle, {1.5, 0}, {0, 1.5}, paint, fade},
           Polygon{{at_px(-40, -40), at_px(200, -40), at_px(200, 200), at_px(-40, 200)}, 4, paint, fade}}) {
    const Image image = draw_items({shape});
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double left = (x + 0.5 - 10) / 50, bottom = (kSide - y - 0.5) / 40;
        const double expected = x >= kSide - 20 ? 0 : std::clamp(std::min(left, bottom), 0.0, 1.0);
        ASSERT_NEAR(darkness(image, x, y), expected, 1.0 / 255) << x << " " << y;
      }
  }
}

Trail wave(double alpha, double width_px) {
  Trail trail;
  trail.color = kBlack;
  for (int i = 0; i <= 60; ++i)
    trail.points.push_back({at_px(8 + 112 * i / 60.0, 64), width_px * kPx, alpha});
  return trail;
}

// The darkest pixel of each column between the path's ends.
std::pair<double, double> darkest_range(const Image& image) {
  double low = 1, high = 0;
  for (int x = 12; x < 116; ++x) {
    double darkest = 0;
    for (int y = 0; y < kSide; ++y) darkest = std::max(darkest, darkness(image, x, y));
    low = std::min(low, darkest), high = std::max(high, darkest);
  }
  return {low, high};
}

TEST(Shapes, TrailsDoNotBead) {
  const auto [low, high] = darkest_range(draw_items({wave(0.4, 9)}));
  EXPECT_NEAR(low, 0.4, 1.5 / 255);  // rounded in the layer and on the page
  EXPECT_NEAR(high, 0.4, 1.5 / 255);

  // Negative control: the same path as translucent capsules does.
  Picture beads;
  const Trail trail = wave(0.4, 9);
  for (std::size_t i = 1; i < trail.points.size(); ++i)
    beads.add(Capsule{trail.points[i - 1].p, trail.points[i].p, 4.5 * kPx, {color_of(0, 0.4), kNothing, 0}});
  Canvas canvas(kSide, kSide, fonts());
  Image image;
  canvas.draw(beads, image);
  EXPECT_GT(darkest_range(image).second, 0.6);
}

TEST(Shapes, TrailsCrossThemselvesWithoutGettingDarker) {
  Trail loop;
  loop.color = kBlack;
  for (int i = 0; i <= 400; ++i)  // four times around
    loop.points.push_back(
        {at_px(64 + 30 * std::cos(i * 2 * pi / 100), 64 + 30 * std::sin(i * 2 * pi / 100)), 6 * kPx, 0.4});
  const Image image = draw_items({loop});
  double darkest = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) darkest = std::max(darkest, darkness(image, x, y));
  EXPECT_NEAR(darkest, 0.4, 1.5 / 255);
  EXPECT_NEAR(covered_area(image), 0.4 * 2 * pi * 30 * 6, 0.4 * area_tolerance(4 * pi * 30));
}

TEST(Shapes, TrailsLieInThePaintersOrder) {
  const Shape cover = rectangle(50, 50, 70, 80, {color_of(0xFF0000), kNothing, 0});
  EXPECT_EQ(draw_items({wave(1, 9), cover}).at(60, 64), (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(draw_items({cover, wave(1, 9)}).at(60, 64), (Pixel{0, 0, 0, 255}));
  // Two trails of different colours, the second above the first.
  Trail blue = wave(1, 9);
  blue.color = color_of(0x0000FF);
  EXPECT_EQ(draw_items({wave(1, 9), blue}).at(60, 64), (Pixel{0, 0, 255, 255}));
}

}  // namespace
}  // namespace chainreel

// What moves, and a picture by itself, is drawn in memory, what lies under films by OpenGL: with the same bytes, whatever the shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/scalar.hpp"
#include "render/drawing.hpp"
#include "render/test_card.hpp"
#include "render/window_painter.hpp"

namespace chainreel {
namespace {

constexpr int kPageWidth = 320, kPageHeight = 180;

// Shapes of one kind, each unlike the others.
class Shapes {
 public:
  double number(double low, double high) {
    return low + (high - low) * double(random_()) / double(std::mt19937::max());
  }
  bool chance() { return random_() % 2 == 0; }
  Point point() { return {number(-0.1, 1.9), number(-0.1, 1.1)}; }
  std::uint8_t level() { return std::uint8_t(number(0, 255.9)); }
  Color color() { return {level(), level(), level(), chance() ? 1 : number(0, 1)}; }
  Paint paint() {
    Paint paint{color(), {}, 0};
    if (chance()) paint.stroke = color(), paint.stroke_width = number(0.001, 0.04);
    return paint;
  }
  Fade fade() {
    Fade fade;
    if (chance()) return fade;
    fade.scene = {number(0, 0.4), number(0, 0.3), number(0.9, 1.7), number(0.6, 1)};
    fade.left = number(0, 0.2), fade.right = chance() ? 0 : 0.1, fade.top = number(0, 0.2),
    fade.bottom = 0.05;
    return fade;
  }
  Capsule capsule() {
    Capsule capsule{point(), point(), number(0, 0.1), paint()};
    if (chance()) capsule.b = capsule.a;
    if (chance()) capsule.alpha_a = number(0, 1), capsule.alpha_b = number(0, 1);
    return capsule;
  }
  Ellipse ellipse() {
    const auto turn = sin_cos(number(0, 7));
    const double a = number(0.001, 0.6), b = a * (chance() ? number(0, 1) : number(0, 0.05));
    return {point(), {a * turn.c, a * turn.s}, {-b * turn.s, b * turn.c}, paint(), fade()};
  }
  Arc arc() { return {point(), number(0, 0.4), number(-7, 7), number(-7, 7), number(0.001, 0.1), color()}; }
  Polygon polygon() {
    Polygon polygon{.corners = {}, .count = 3 + int(number(0, 5.9)), .paint = paint(), .fade = fade()};
    const Point center = point();
    const double radius = number(0.01, 0.5), flat = number(0.1, 1), start = number(0, 7);
    for (int i = 0; i < polygon.count; ++i) {
      const auto turn = sin_cos(start + 6.283185 * i / polygon.count);
      polygon.corners[std::size_t(i)] = {center.x + radius * turn.c, center.y + flat * radius * turn.s};
    }
    return polygon;
  }
  Trail trail() {
    Trail trail{{}, color()};
    Point p = point();
    for (int i = 0; i < 20; ++i) {
      trail.points.push_back({p, number(0.002, 0.02), number(0, 1)});
      p.x += number(-0.1, 0.1), p.y += number(-0.1, 0.1);
    }
    return trail;
  }

 private:
  std::mt19937 random_{17};
};

Image by_opengl(const Picture& picture) {
  static Canvas& canvas = *new Canvas(kPageWidth, kPageHeight, fonts());  // the renderer's library may end before statics do
  Image image;
  canvas.draw(picture, image);
  return image;
}

// By itself, background and all.
Image as_still(const Picture& picture) {
  static Canvas canvas(kPageWidth, kPageHeight, fonts(), PageUse::still);
  Image image;
  canvas.draw(picture, image);
  return image;
}

// Over a page of the picture's background.
Image in_memory(const Picture& picture) {
  static Canvas& canvas = *new Canvas(kPageWidth, kPageHeight, fonts());  // the renderer's library may end before statics do
  Picture below;
  below.background = picture.background;
  canvas.set_static_layer(below);
  Image image;
  canvas.draw(picture, image);
  return image;
}

// The same on an opaque page, by vectors of one width.
Image filled_by(const WindowFillers& fillers, const Picture& picture) {
  static GlyphAtlas atlas(fonts(), 1024);
  Batch batch(kPageWidth, kPageHeight, atlas);
  batch.set(picture);
  TileMask tiles(kPageWidth, kPageHeight);
  tiles.fill();
  Windows windows;
  windows.set(batch, tiles);
  Image image(kPageWidth, kPageHeight);
  auto* const page = reinterpret_cast<std::uint32_t*>(image.bgra.data());
  const Color& c = picture.background;
  std::fill(page, page + kPageWidth * kPageHeight,
            255U << 24 | unsigned(c.r) << 16 | unsigned(c.g) << 8 | c.b);
  WindowPainter painter(kPageWidth, kPageHeight, fillers);
  for (const Run& run : windows.runs()) painter.draw(run, windows, batch, atlas, page);
  return image;
}

// "" where there is none, else how many pixels, the largest one and the first.
std::string difference(const Image& image, const Image& expected) {
  const auto text = [](const Pixel& p) {
    return std::to_string(p.r) + " " + std::to_string(p.g) + " " + std::to_string(p.b) + " " +
           std::to_string(p.a);
  };
  int pixels = 0;
  std::string first;
  for (int y = 0; y < kPageHeight; ++y)
    for (int x = 0; x < kPageWidth; ++x)
      if (image.at(x, y) != expected.at(x, y) && pixels++ == 0)
        first = std::to_string(x) + "," + std::to_string(y) + ": " + text(image.at(x, y)) + " instead of " +
                text(expected.at(x, y));
  if (pixels == 0) return "";
  return std::to_string(pixels) + " pixels, by " + std::to_string(largest_difference(image, expected)) +
         ", first at " + first;
}

TEST(WindowPainter, GivesTheBytesOfTheShaders) {
  Shapes shapes;
  const std::vector<std::pair<std::string, std::function<Shape()>>> kinds = {
      {"capsule", [&] { return shapes.capsule(); }},
      {"ellipse", [&] { return shapes.ellipse(); }},
      {"arc", [&] { return shapes.arc(); }},
      {"polygon", [&] { return shapes.polygon(); }},
      {"trail", [&] { return shapes.trail(); }}};
  for (const auto& [kind, make] : kinds)
    for (int round = 0; round < 40; ++round) {
      Picture picture;
      picture.background = {shapes.level(), shapes.level(), shapes.level(), round % 8 == 0 ? 0.5 : 1};
      for (int i = 0; i < 3; ++i) picture.add(make());
      const Image expected = by_opengl(picture);
      EXPECT_EQ(difference(in_memory(picture), expected), "") << kind << " " << round;
      EXPECT_EQ(difference(as_still(picture), expected), "") << kind << " " << round;
      if (picture.background.a < 1) continue;
      for (const WindowFillers& fillers : window_fillers())
        EXPECT_EQ(difference(filled_by(fillers, picture), expected), "")
            << kind << " " << round << ", " << fillers.lanes << " at once";
    }
}

TEST(WindowPainter, GivesTheBytesOfTheShadersForEachShapeOfACard) {
  for (const Theme& theme : {light_theme(), dark_theme()}) {
    const Picture card = test_card(fonts(), theme);
    for (std::size_t i = 0; i < card.items.size(); ++i) {
      Picture one = card;
      one.items = {card.items[i]};
      EXPECT_EQ(difference(in_memory(one), by_opengl(one)), "")
          << "item " << i << ", kind " << card.items[i].shape.index();
    }
  }
}

// What OpenGL clears a page with, and what a picture by itself begins with.
TEST(WindowPainter, BeginsWithTheBackgroundThatOpenGlClears) {
  Shapes shapes;
  for (int round = 0; round < 500; ++round) {
    Picture picture;
    picture.background = {shapes.level(), shapes.level(), shapes.level(), round < 256 ? round / 255.0 : round < 400 ? 0.5 : shapes.number(0, 1)};
    ASSERT_EQ(difference(as_still(picture), by_opengl(picture)), "") << round << ", opacity " << picture.background.a;
  }
}

}  // namespace
}  // namespace chainreel

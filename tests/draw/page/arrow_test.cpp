// Arrows in the widths of a style.
#include "draw/page/arrow.hpp"

#include <gtest/gtest.h>

#include "draw/shapes.hpp"

namespace chainreel {
namespace {

TEST(Arrow, HasAShaftAsWideAsTheLinesOfAStyleAndItsHeadAsEver) {
  Picture plain, wide;
  draw_arrow(plain, {0.2, 0.2}, {0.3, 0}, {color_of(0), 1}, -1);
  draw_arrow(wide, {0.2, 0.2}, {0.3, 0}, {color_of(0), 1, false, 0, 2}, -1);
  const auto shaft = [](const Picture& picture) { return test::all_of<Capsule>(picture).at(0); };
  const auto head = [](const Picture& picture) { return test::all_of<Polygon>(picture).at(0); };
  EXPECT_DOUBLE_EQ(shaft(wide).radius, 2 * shaft(plain).radius);
  double half = 0;  // of the head's width
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(head(wide).corners[std::size_t(i)].y, head(plain).corners[std::size_t(i)].y);
    half = std::max(half, head(wide).corners[std::size_t(i)].y - 0.2);
  }
  // A head is one even at the widest lines.
  EXPECT_GT(half, shaft(wide).radius);
}

// What is hardly there would be a speck in the background's colour on what lies below.
TEST(Arrow, AShortOneHasAThinCasing) {
  const auto around = [](double length) {
    Picture picture;
    draw_arrow(picture, {0.2, 0.2}, {length, 0}, {.color = color_of(0), .size = 1, .casing = color_of(1)}, -1);
    const std::vector<Polygon> heads = test::all_of<Polygon>(picture);
    EXPECT_EQ(heads.size(), 2u);
    return heads.front().paint.stroke_width / 2;
  };
  EXPECT_DOUBLE_EQ(around(0.3), around(0.1));
  EXPECT_LT(around(0.004), 0.2 * around(0.1));
}

TEST(Arrow, ARoundOneHasThemToo) {
  Picture plain, wide;
  draw_turn(plain, {0.5, 0.5}, {0.1, 0}, {0, 0.1}, 2, {color_of(0), 1}, -1);
  draw_turn(wide, {0.5, 0.5}, {0.1, 0}, {0, 0.1}, 2, {color_of(0), 1, false, 0, 1.5}, -1);
  EXPECT_DOUBLE_EQ(test::all_of<Arc>(wide).at(0).width, 1.5 * test::all_of<Arc>(plain).at(0).width);
}

}  // namespace
}  // namespace chainreel

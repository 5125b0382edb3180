// Words of marks: moved apart as little as need be, and left out where there is no room.
#include "draw/page/mark_labels.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "draw/shapes.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

constexpr Rect kLabelArea{0, 0, 1, 1};
constexpr double kAir = 0.01, kFarthest = 1.5;
constexpr double kRest = 1e-5;  // what the pushing leaves

Rect box(double x, double y, double width = 0.1, double height = 0.04) {
  return {x - width / 2, y - height / 2, x + width / 2, y + height / 2};
}

std::vector<PlacedBox> apart(const std::vector<Rect>& wishes) {
  return boxes_apart(wishes, kLabelArea, kAir, kFarthest);
}

void expect_tidy(const std::vector<PlacedBox>& placed) {
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].stands) continue;
    EXPECT_TRUE(test::is_inside(kLabelArea, Point{placed[i].box.x0, placed[i].box.y0}, kRest));
    EXPECT_TRUE(test::is_inside(kLabelArea, Point{placed[i].box.x1, placed[i].box.y1}, kRest));
    for (std::size_t j = 0; j < i; ++j) {
      if (!placed[j].stands) continue;
      Rect grown = placed[j].box;
      grown = {grown.x0 + kRest, grown.y0 + kRest, grown.x1 - kRest, grown.y1 - kRest};
      EXPECT_FALSE(test::overlap(placed[i].box, grown)) << i << " and " << j;
    }
  }
}

TEST(MarkLabels, StayWhereTheyAreWishedWhileTheyDoNotOverlap) {
  const std::vector<Rect> wishes{box(0.2, 0.5), box(0.4, 0.5), box(0.2, 0.6)};
  const auto placed = apart(wishes);
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    EXPECT_TRUE(placed[i].stands);
    EXPECT_EQ(placed[i].box.x0, wishes[i].x0);
    EXPECT_EQ(placed[i].box.y0, wishes[i].y0);
  }
}

TEST(MarkLabels, OfAPairGoApartTheShorterWayHalfEach) {
  const auto placed = apart({box(0.5, 0.50), box(0.5, 0.52)});
  expect_tidy(placed);
  EXPECT_NEAR(test::middle_of(placed[0].box).x, 0.5, 1e-12);
  EXPECT_NEAR(test::middle_of(placed[0].box).y, 0.485, kRest);  // 0.04 high and 0.01 of air about 0.51
  EXPECT_NEAR(test::middle_of(placed[1].box).y, 0.535, kRest);
}

TEST(MarkLabels, AtTheEdgeAreMovedInAndOutsideAreLeftOut) {
  const auto placed = apart({box(0.98, 0.5), box(1.2, 0.5)});
  EXPECT_TRUE(placed[0].stands);
  EXPECT_NEAR(placed[0].box.x1, 1, 1e-12);
  EXPECT_FALSE(placed[1].stands);
}

TEST(MarkLabels, InACrowdAreLeftOutOneByOneUntilTheRestStandsNear) {
  std::vector<Rect> wishes;
  for (int i = 0; i < 12; ++i) wishes.push_back(box(0.5 + 0.002 * i, 0.5 - 0.001 * i));
  const auto placed = apart(wishes);
  expect_tidy(placed);
  int standing = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].stands) continue;
    ++standing;
    EXPECT_LE(test::distance(test::middle_of(placed[i].box), test::middle_of(wishes[i])),
              kFarthest * 0.04 + kRest);
  }
  EXPECT_GE(standing, 3);
  EXPECT_LT(standing, 12);
}

TEST(MarkLabels, MoveLittleWhenTheirMarksMoveLittle) {
  // Two labels pass each other slowly: no jump of more than what one frame moves them, but where they change
  // sides.
  double largest = 0;
  Point before{};
  for (int k = 0; k <= 100; ++k) {
    const auto placed = apart({box(0.5, 0.5), box(0.35 + 0.001 * k, 0.53)});
    const Point now = test::middle_of(placed[1].box);
    if (k > 0) largest = std::max(largest, test::distance(now, before));
    before = now;
  }
  EXPECT_LT(largest, 0.025);
}

// Pictures of a sheet have words too small for anybody to see: a line to one led from nothing.
TEST(MarkLabels, NoLineLeadsToAWordThatNobodySees) {
  const auto lines = [](double size) {
    const TextLine line = lay_out_text(fonts(), "f", {Face::label, size, light_theme().ink, Align::left});
    const Rect at{0.2, 0.2, 0.2 + line.box.width(), 0.2 + line.box.height()};
    const std::vector<StandingWord> plan{{at, 1, {}}};
    MarkLabels labels(plan);
    MarkWord word{"force", line, {at}};
    word.tie = Tie{{0.6, 0.6}, 0.01, light_theme().ink, {}, 0.02};
    labels.add(std::move(word));
    Picture picture;
    labels.draw(picture, kLabelArea, light_theme().background, -1, kFarthest);
    return test::all_of<Capsule>(picture).size();
  };
  EXPECT_EQ(lines(1e-4), 0u);
  EXPECT_GT(lines(0.03), 0u) << "negative control";
}

}  // namespace
}  // namespace chainreel

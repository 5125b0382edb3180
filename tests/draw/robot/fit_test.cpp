#include "draw/robot/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "draw/shapes.hpp"

namespace chainreel {
namespace {

const Rect kFitArea{0.045, 0.11, 1.73, 0.87};
constexpr double kMargin = 0.06;
// The iteration ends at the last bits of numbers near 1.
constexpr double kConverged = 1e-13;

Rect page_box(const Camera& camera, const Rect& box_m) {
  const Point low = camera.project({box_m.x0, box_m.y0, 0}), high = camera.project({box_m.x1, box_m.y1, 0});
  return {low.x, low.y, high.x, high.y};
}

TEST(Fit, FillsTheAreaInOneDirectionAndIsCentredInBoth) {
  FitBox box;
  const Room joint = room_around(0.02), tip{0.01, 0.03, 0.1, 0.005};
  box.add(joint, {0, 0});
  box.add(joint, {1.7, -0.9});
  box.add(tip, {2.2, 0.4});
  Camera camera;
  fit_to(camera, box, kFitArea, kMargin);

  const Rect page = page_box(camera, box.box(camera.scale));
  const double wide = page.width() * (1 + 2 * kMargin) / kFitArea.width();
  const double high = page.height() * (1 + 2 * kMargin) / kFitArea.height();
  EXPECT_NEAR(std::max(wide, high), 1, kConverged);
  EXPECT_LT(std::min(wide, high), 1);
  EXPECT_NEAR(page.x0 - kFitArea.x0, kFitArea.x1 - page.x1, kConverged);
  EXPECT_NEAR(page.y0 - kFitArea.y0, kFitArea.y1 - page.y1, kConverged);
}

// Rooms that fill the area by themselves would leave a motion no scale at all: that of an arm on a square page below plots was 2e13 m long.
TEST(Fit, KeepsHalfOfTheScaleWhereRoomsFillTheArea) {
  for (const double radius : {0.1, 0.2, 0.4, 3.0}) {
    FitBox box;
    box.add(room_around(radius), {0, 0});
    box.add(room_around(radius), {1.7, -0.9});
    Camera camera, bare;
    fit_to(camera, box, kFitArea, kMargin);
    fit(bare, {0, -0.9, 1.7, 0}, kFitArea, kMargin);
    EXPECT_GE(camera.scale, 0.5 * bare.scale) << radius;
    const Point middle = camera.project({0.85, -0.45, 0}), center = center_of(kFitArea);
    EXPECT_NEAR(middle.x, center.x, kConverged);
    EXPECT_NEAR(middle.y, center.y, kConverged);
  }
}

TEST(Fit, KeepsEveryPlaceWithItsRoomInside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> metres(-3, 3), room(0, 0.08);
  for (int trial = 0; trial < 50; ++trial) {
    FitBox box;
    std::vector<std::pair<Point, double>> places;
    for (int i = 0; i < 6; ++i) {
      const double radius = room(random);
      const Room kind = room_around(radius);
      places.push_back({{metres(random), metres(random)}, radius});
      box.add(kind, places.back().first);
    }
    Camera camera;
    fit_to(camera, box, kFitArea, kMargin);
    for (const auto& [place, radius] : places) {
      const Point p = camera.project({place.x, place.y, 0});
      EXPECT_TRUE(test::is_inside(kFitArea, Rect{p.x - radius, p.y - radius, p.x + radius, p.y + radius}));
    }
  }
}

TEST(Fit, TakesTheSmallerOfRoomOnThePageAndRoomInMetres) {
  FitBox box;
  Room link = room_around(0.02);
  link.metres = 0.05;
  link.beyond = 0.001;
  box.add(link, {0, 0});
  box.add(link, {1, 0});
  EXPECT_NEAR(box.box(0.1).width(), 1 + 2 * 0.06, 1e-15);  // 0.05 m and a thousandth are 0.006 on the page
  EXPECT_NEAR(box.box(1.0).width(), 1 + 2 * 0.02, 1e-15);  // 0.05 m would be 0.05: the page's bound holds
}

// What is wished for is held where that is cheap; else the camera gives no more than its share of the scale, moves as far as
// what must be seen lets it, and cuts at opposite edges alike.
TEST(Fit, HoldsWishesAsFarAsTheyCostLittle) {
  FitBox box;
  box.add({}, {0, 0});
  box.add({}, {1, 2});
  Camera bare;
  fit_to(bare, box, kFitArea, kMargin);
  const auto wished = [&](Point place, double room) {
    FitBox wishes;
    wishes.add({room, room, room, room, -1, 0, true}, place);
    Camera camera;
    fit_to(camera, box, wishes, kFitArea, kMargin);
    return std::pair{camera, wishes};
  };
  const auto holds = [&](const Camera& camera, const Rect& metres) {
    return test::is_inside(test::shifted(kFitArea, {}), page_box(camera, metres)) ||
           std::max({kFitArea.x0 - page_box(camera, metres).x0, page_box(camera, metres).x1 - kFitArea.x1,
                     kFitArea.y0 - page_box(camera, metres).y0, page_box(camera, metres).y1 - kFitArea.y1}) < kConverged;
  };
  // Beside a high motion there is room: it moves, and keeps its scale.
  {
    const auto [camera, wishes] = wished({3, 1}, 0.1);
    EXPECT_DOUBLE_EQ(camera.scale, bare.scale);
    EXPECT_TRUE(holds(camera, wishes.box(camera.scale)));
    EXPECT_FALSE(holds(bare, wishes.box(bare.scale))) << "else the test says nothing";
  }
  // Above it a little is given.
  {
    const auto [camera, wishes] = wished({0.5, 2}, 0.12);
    EXPECT_LT(camera.scale, bare.scale);
    EXPECT_GT(camera.scale, kKeptForWishes * bare.scale);
    EXPECT_TRUE(holds(camera, wishes.box(camera.scale)));
  }
  // Much too much: what must be seen is seen, with its margin.
  for (const Point place : {Point{0.5, 9}, {0.5, -9}, {40, 1}, {-40, 1}}) {
    const auto [camera, wishes] = wished(place, 0.1);
    EXPECT_DOUBLE_EQ(camera.scale, kKeptForWishes * bare.scale);
    EXPECT_TRUE(holds(camera, box.box(camera.scale, kMargin)));
    const Rect seen = page_box(camera, box.box(camera.scale, kMargin));
    const double nearest = std::abs(place.y) > 5 ? (place.y > 0 ? seen.y0 - kFitArea.y0 : kFitArea.y1 - seen.y1)
                                                 : (place.x > 0 ? seen.x0 - kFitArea.x0 : kFitArea.x1 - seen.x1);
    EXPECT_NEAR(nearest, 0, kConverged) << "it moved as far towards the wish as it could";
  }
  Camera same;
  fit_to(same, box, {}, kFitArea, kMargin);
  EXPECT_EQ(same.scale, bare.scale);
  EXPECT_EQ(same.origin.x, bare.origin.x);
}

TEST(Fit, MarksInTheMarginTakeRoomOnlyBeyondIt) {
  constexpr double kWide = 0.1;
  FitBox bare;
  bare.add({}, {0, 0});
  bare.add({}, {1, 1});
  Camera without;
  fit_to(without, bare, kFitArea, kWide);
  const double margin = kWide * without.scale;  // units of H, as wide above as below
  for (const double reach : {0.5 * margin, 2 * margin}) {
    FitBox box = bare;
    Room mark;
    mark.up = reach;
    mark.in_margin = true;
    box.add(mark, {0.5, 1});
    Camera camera;
    fit_to(camera, box, kFitArea, kWide);
    const double top = camera.project({0.5, 1, 0}).y + reach;
    if (reach < margin) {
      EXPECT_NEAR(camera.scale, without.scale, kConverged);
      EXPECT_LT(top, kFitArea.y1 - 0.4 * margin);
    } else {
      EXPECT_LT(camera.scale, without.scale);
      EXPECT_NEAR(top, kFitArea.y1, kConverged);
    }
  }
}

TEST(Fit, ShowsOneMetreWhereNothingHasAnExtent) {
  FitBox box;
  box.add(room_around(0.03), {5, 5});
  Camera camera;
  fit_to(camera, box, kFitArea, 0);
  EXPECT_NEAR(camera.scale, kFitArea.height(), kConverged);
  const Point p = camera.project({5, 5, 0});
  EXPECT_NEAR(test::distance(p, test::middle_of(kFitArea)), 0, kConverged);
}

// Negative control: a fit that forgot one place would not see it.
TEST(Fit, ChangesWhenAPlaceOutsideIsAddedAndNotWhenItIsInside) {
  FitBox box;
  const Room kind = room_around(0.02);
  box.add(kind, {0, 0});
  box.add(kind, {1, 1});
  Camera camera;
  fit_to(camera, box, kFitArea, kMargin);
  const double scale = camera.scale;
  box.add(kind, {0.5, 0.5});
  box.add(kind, {std::nan(""), 3});  // passed over
  fit_to(camera, box, kFitArea, kMargin);
  EXPECT_EQ(camera.scale, scale);
  box.add(kind, {0.5, 1.5});
  fit_to(camera, box, kFitArea, kMargin);
  EXPECT_LT(camera.scale, 0.8 * scale);
}

}  // namespace
}  // namespace chainreel

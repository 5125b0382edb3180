// The ellipse's edge against the exact distance, for shapes from a disc to a needle.
#include <algorithm>

#include <gtest/gtest.h>

#include "render/drawing.hpp"

namespace chainreel {
namespace {

// Signed distance from (x, y) to the ellipse with semi-axes a >= b > 0, by bisection of the same equation
// that the shader solves by Newton's method, in long double: D. Eberly, "Distance from a point to an
// ellipse", 2013.
double exact_distance(double x, double y, long double a, long double b) {
  const long double px = std::abs(x), py = std::abs(y);
  const bool is_inside = (px / a) * (px / a) + (py / b) * (py / b) < 1;
  long double foot_x, foot_y;
  const long double evolute_tip = (a * a - b * b) / a;
  if (py == 0 && px < evolute_tip) {
    foot_x = a * px / evolute_tip;
    foot_y = b * std::sqrt(1 - (foot_x / a) * (foot_x / a));
  } else if (py == 0) {
    foot_x = a, foot_y = 0;
  } else {
    const long double z0 = px / a, z1 = py / b, r = a * a / (b * b);
    long double low = z1 - 1, high = std::sqrt(r * z0 * r * z0 + z1 * z1) - 1, s = 0;
    for (int i = 0; i < 120; ++i) {
      s = (low + high) / 2;
      const long double u = r * z0 / (s + r), v = z1 / (s + 1);
      (u * u + v * v > 1 ? low : high) = s;
    }
    foot_x = r * px / (s + r), foot_y = py / (s + 1);
  }
  const double d = double(std::sqrt((foot_x - px) * (foot_x - px) + (foot_y - py) * (foot_y - py)));
  return is_inside ? -d : d;
}

double ramp(double d) {
  return std::clamp(0.5 - d, 0.0, 1.0);
}

// The largest difference between what is drawn and what the exact distance says, over all pixels.
double worst_error(double a_px, double b_px, double angle, double half_stroke_px) {
  const Point center = at_px(64.3, 63.8);
  const Point u = {a_px * kPx * std::cos(angle), a_px * kPx * std::sin(angle)};
  const Point v = {-b_px * kPx * std::sin(angle), b_px * kPx * std::cos(angle)};
  const Image image = draw_items({Ellipse{center, u, v, {kNothing, kBlack, 2 * half_stroke_px * kPx}}});
  double worst = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double dx = x + 0.5 - 64.3, dy = 63.8 - (y + 0.5);
      const double along = dx * std::cos(angle) + dy * std::sin(angle);
      const double across = dy * std::cos(angle) - dx * std::sin(angle);
      const double d = exact_distance(along, across, a_px, std::max(b_px, 0.01));
      const double expected = ramp(d - half_stroke_px) - ramp(d + half_stroke_px);
      worst = std::max(worst, std::abs(darkness(image, x, y) - expected));
    }
  return worst;
}

// 8-bit rounding is half a level; single precision adds less than another.
constexpr double kLevel = 1.0 / 255;

TEST(Ellipse, EdgeIsExactForEveryShape) {
  for (const double b : {49.9, 40.0, 20.0, 5.0, 1.0, 0.1, 0.01})
    for (const double angle : {0.0, 0.4})
      for (const double half_stroke : {0.5, 5.0})
        EXPECT_LE(worst_error(50, b, angle, half_stroke), kLevel) << b << " " << angle << " " << half_stroke;
}

TEST(Ellipse, EdgeIsExactWhenItReachesFarBeyondThePage) {
  for (const double a : {500.0, 1e5})
    for (const double b : {0.5, 10.0, 55.0})
      EXPECT_LE(worst_error(a, b, 0.3, 2.0), 2 * kLevel) << a << " " << b;
}

TEST(Ellipse, AnEllipseOneTwentiethOfAPixelWiderIsNoticed) {
  // Negative control: the comparison resolves a twentieth of a pixel.
  const Point center = at_px(64.3, 63.8);
  const auto image = [&](double a) {
    return draw_items({Ellipse{center, {a * kPx, 0}, {0, 20 * kPx}, {kNothing, kBlack, 4 * kPx}}});
  };
  EXPECT_GT(largest_difference(image(50), image(50.05)), 5);
}

TEST(Ellipse, WithoutMinorAxisItIsALine) {
  const Point center = at_px(64, 64), u = {40 * kPx, 0.0};
  const Paint stroke = {kNothing, kBlack, 4 * kPx};
  const Image needle = draw_items({Ellipse{center, u, {0, 0}, stroke}});
  const Image line = draw_items({Capsule{center - u, center + u, 2 * kPx, {kBlack, kNothing, 0}}});
  // The needle is a line of the stroke's width but for the 0.01 px that its axis keeps.
  EXPECT_LE(largest_difference(needle, line), 0.02 * 255);
  EXPECT_EQ(largest_difference(needle, draw_items({Ellipse{center, {0, 0}, u, stroke}})), 0);

  const Image filled = draw_items({Ellipse{center, u, {0, 0}, {kBlack, kNothing, 0}}});
  EXPECT_GT(darkness(filled, 64, 64) + darkness(filled, 64, 63),
            0.9);  // one pixel thick without a stroke, too
}

TEST(Ellipse, WithoutAnyAxisItIsADot) {
  const Image dot = draw_items({Ellipse{at_px(64.5, 64.5), {0, 0}, {0, 0}, {kBlack, kBlack, 6 * kPx}}});
  EXPECT_EQ(darkness(dot, 64, 64), 1);
  EXPECT_EQ(darkness(dot, 70, 64), 0);
}

}  // namespace
}  // namespace chainreel

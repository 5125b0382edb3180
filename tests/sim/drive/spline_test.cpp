#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/drive/reference.hpp"

namespace chainreel {
namespace {

std::vector<double> uneven(int n) {
  std::vector<double> t;
  for (int k = 0; k < n; ++k) t.push_back(k + 0.3 * std::sin(double(k)));
  return t;
}

TEST(Spline, IsExactOnCubics) {
  const auto y = [](double t) { return 2 - t + 3 * t * t - 0.5 * t * t * t; };
  const std::vector<double> t = uneven(9);
  std::vector<double> samples;
  for (double x : t) samples.push_back(y(x));
  const Spline spline(t, samples);
  for (double x = t.front(); x < t.back(); x += 0.37) {
    // Values up to 60, some twenty roundings in the elimination; a derivative divides by steps of about 1.
    EXPECT_NEAR(spline.at(x).y, y(x), 1e-12);
    EXPECT_NEAR(spline.at(x).yd, -1 + 6 * x - 1.5 * x * x, 1e-12);
    EXPECT_NEAR(spline.at(x).ydd, 6 - 3 * x, 1e-12);
  }
}

// Largest error of the second derivative on a sine.
double curvature_error(int n) {
  std::vector<double> t, y;
  for (int k = 0; k <= n; ++k) {
    t.push_back(3.0 * k / n);
    y.push_back(std::sin(t.back()));
  }
  const Spline spline(t, y);
  double largest = 0;
  for (double x = 0; x <= 3; x += 0.001)
    largest = std::max(largest, std::abs(spline.at(x).ydd + std::sin(x)));
  return largest;
}

TEST(Spline, LosesTwoOrdersInTheSecondDerivative) {
  // Cubic splines: fourth order in y, second in its curvature; the error at the ends falls a little faster.
  EXPECT_NEAR(std::log2(curvature_error(40) / curvature_error(80)), 2, 0.3);
}

TEST(Spline, StandsStillOutsideItsSamples) {
  const Spline spline({0, 1, 2, 3}, {1, 2, 0, 5});
  EXPECT_EQ(spline.at(-1).y, 1);
  EXPECT_EQ(spline.at(-1).yd, 0);
  EXPECT_EQ(spline.at(4).y, 5);
}

TEST(Spline, TakesFewSamples) {
  EXPECT_EQ(Spline({1}, {7}).at(1).y, 7);
  EXPECT_DOUBLE_EQ(Spline({0, 2}, {1, 5}).at(0.5).y, 2);
  EXPECT_DOUBLE_EQ(Spline({0, 1, 2}, {0, 1, 4}).at(1.5).y, 2.25);
}

}  // namespace
}  // namespace chainreel

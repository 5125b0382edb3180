// Numbers of what is cut: one stands for as long as it takes to read it, and says of what it is true.
#include "draw/layers/peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

constexpr double kPeakFps = 60, kCut = 10;
constexpr int kStays = 12, kRead = 18;  // 0.2 s, 0.3 s

// A bump of `height` at `middle`, above a fifth of what is cut everywhere else.
std::vector<double> bump(int count, int middle, double height, int half) {
  std::vector<double> values(std::size_t(count), 0.2 * kCut);
  for (int k = middle - half; k <= middle + half; ++k) values[std::size_t(k)] = height * (1 - std::abs(k - middle) / (half + 1.0));
  return values;
}

// Not before it: beside an arrow that has not got there a number would be read as its.
TEST(Peaks, OneNumberStandsFromWhereItIsCut) {
  const std::vector<double> values = bump(120, 60, 40, 3);
  const auto peaks = peaks_along(values, kCut, kPeakFps);
  int stands = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    stands += peaks[k].has_value();
    if (std::abs(values[k]) > kCut) EXPECT_TRUE(peaks[k]) << k << ": no break stands bare";
    if (!peaks[k]) continue;
    EXPECT_EQ(peaks[k]->value, 40);
    EXPECT_FALSE(peaks[k]->is_steady);
    EXPECT_GE(k, 58u);
  }
  EXPECT_EQ(stands, std::max(5 + kStays, kRead));  // five frames are beyond the cut
  // Negative control: what is not cut has no number.
  for (const auto& peak : peaks_along(values, 41, kPeakFps)) EXPECT_FALSE(peak);
}

TEST(Peaks, OfWhatStaysTheSameIsNoPeak) {
  for (const auto& peak : peaks_along(std::vector<double>(60, -12.0), kCut, kPeakFps)) {
    ASSERT_TRUE(peak);
    EXPECT_TRUE(peak->is_steady);
    EXPECT_EQ(peak->value, -12);
  }
}

TEST(Peaks, HaveTheirSign) {
  std::vector<double> values;
  for (int k = 0; k < 120; ++k) values.push_back(30 * std::cos(k * 3.14159265358979 / 119));
  const auto peaks = peaks_along(values, kCut, kPeakFps);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (peaks[k]) EXPECT_GT(peaks[k]->value * values[k], 0) << k;
  ASSERT_TRUE(peaks.front() && peaks.back());
  EXPECT_DOUBLE_EQ(peaks.front()->value, 30);
  EXPECT_NEAR(peaks.back()->value, -30, 1e-9);  // of a cosine's rounding
  EXPECT_FALSE(peaks[60]);                      // where next to nothing acts
}

// A force that is there for three frames alone has its number for as long as one reads it, though there is nothing about it.
TEST(Peaks, AreReadWhereNothingElseActs) {
  std::vector<double> values(120, 0.0);
  for (const std::size_t k : {50, 51, 52}) values[k] = 20;
  const auto peaks = peaks_along(values, kCut, kPeakFps);
  EXPECT_EQ(std::ranges::count_if(peaks, [](const auto& peak) { return peak.has_value(); }), kRead);
}

// Turns that follow so quickly upon one another have no number that anybody could read.
TEST(Peaks, LeaveOutWhatNobodyReads) {
  std::vector<double> values;
  for (int k = 0; k < 60; ++k) values.push_back(k / 6 % 2 == 0 ? 20 : -20);
  const auto peaks = peaks_along(values, kCut, kPeakFps);
  for (std::size_t k = 0; k + 6 < peaks.size(); ++k) EXPECT_FALSE(peaks[k]) << k;  // but of the last, which the last picture shows for longer
}

TEST(Peaks, AreThoseOfTheCurveBetweenFrames) {
  const std::vector<double> t{0, 1, 2, 3}, values{-1, -2, -2, 1}, curve{-1, -1, -2, -9, -2, 5, 1}, curve_t{0, 0.5, 1, 1.5, 2, 2.5, 3};
  EXPECT_EQ(extremes_near(values, t, curve, curve_t), (std::vector<double>{-2, -9, -9, 5}));
  // Negative control: of nothing between them.
  EXPECT_EQ(extremes_near(std::vector<double>{1.0}, std::vector<double>{0.0}, std::vector<double>{1.0}, std::vector<double>{0.0}), std::vector<double>{1.0});
}

}  // namespace
}  // namespace chainreel

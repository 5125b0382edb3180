// The themes against the table of colours that they were chosen by: contrast with the background, and how far
// apart what must be told apart is for every kind of colour vision.
#include "picture/theme.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "picture/color_vision.hpp"

namespace chainreel {
namespace {

struct Row {
  std::string token;
  Color color;
  double contrast;
};

std::vector<Row> light_rows() {
  const Theme& t = light_theme();
  return {{"ink", t.ink, 17.4},         {"muted", t.muted, 5.8},
          {"base", t.base, 3.2},        {"rule", t.rule, 1.7},
          {"grid", t.grid, 1.3},        {"link 1", t.link[0], 2.3},
          {"link 2", t.link[1], 2.3},   {"link 3", t.link[2], 3.4},
          {"link 4", t.link[3], 3.1},   {"ellipse", t.ellipse, 5.0},
          {"torque", t.torque, 7.5},    {"velocity", t.velocity, 5.0},
          {"force", t.force, 12.4},     {"constraint", t.constraint, 12.3},
          {"curve 1", t.curve[0], 5.2}, {"curve 2", t.curve[1], 4.5},
          {"curve 3", t.curve[2], 7.7}, {"A", t.side_a, 5.2},
          {"B", t.side_b, 4.5},         {"x", t.axis[0], 5.5},
          {"y", t.axis[1], 5.3},        {"z", t.axis[2], 7.0}};
}

std::vector<Row> dark_rows() {
  const Theme& t = dark_theme();
  return {{"ink", t.ink, 16.0},         {"muted", t.muted, 8.2},
          {"base", t.base, 5.6},        {"rule", t.rule, 2.2},
          {"grid", t.grid, 1.3},        {"link 1", t.link[0], 7.8},
          {"link 2", t.link[1], 8.0},   {"link 3", t.link[2], 5.3},
          {"link 4", t.link[3], 5.9},   {"ellipse", t.ellipse, 14.6},
          {"torque", t.torque, 5.0},    {"velocity", t.velocity, 14.7},
          {"force", t.force, 9.2},      {"constraint", t.constraint, 8.9},
          {"curve 1", t.curve[0], 7.8}, {"curve 2", t.curve[1], 8.0},
          {"curve 3", t.curve[2], 5.3}, {"A", t.side_a, 7.8},
          {"B", t.side_b, 8.0}};
}

// The table has one decimal; a twentieth is half of its last digit, and a hair for its rounding.
constexpr double kContrastTolerance = 0.0501;

TEST(Theme, ContrastsAreThoseOfTheTable) {
  for (const Row& row : light_rows())
    EXPECT_NEAR(contrast(row.color, light_theme().background), row.contrast, kContrastTolerance) << row.token;
  for (const Row& row : dark_rows())
    EXPECT_NEAR(contrast(row.color, dark_theme().background), row.contrast, kContrastTolerance) << row.token;
}

TEST(Theme, ContrastOfBlackOnWhiteIs21) {
  EXPECT_DOUBLE_EQ(contrast(color_of(0x000000), color_of(0xFFFFFF)), 21);
  EXPECT_DOUBLE_EQ(contrast(color_of(0x777777), color_of(0x777777)), 1);
}

// Pairs from table 1 of Sharma, Wu, Dalal; it has four decimals.
TEST(Theme, ColorDifferenceReproducesPublishedPairs) {
  EXPECT_NEAR(ciede2000({50, 2.6772, -79.7751}, {50, 0, -82.7485}), 2.0425, 5e-5);
  EXPECT_NEAR(ciede2000({50, 3.1571, -77.2803}, {50, 0, -82.7485}), 2.8615, 5e-5);
  EXPECT_NEAR(ciede2000({50, 0, 0}, {50, -1, 2}), 2.3669, 5e-5);
  EXPECT_NEAR(ciede2000({50, 2.5, 0}, {73, 25, -18}), 27.1492, 5e-5);
}

std::vector<Row> vectors_of(const Theme& t) {
  return {{"torque", t.torque, 0},
          {"velocity", t.velocity, 0},
          {"force", t.force, 0},
          {"constraint", t.constraint, 0},
          {"ellipse", t.ellipse, 0}};
}

struct Closest {
  double difference = 1e9;
  std::string names;
};

Closest closest_pair(const std::vector<Row>& rows) {
  Closest closest;
  for (const Vision vision : kVisions)
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double d = difference(vision, rows[i].color, rows[j].color);
        if (d < closest.difference)
          closest = {d, rows[i].token + " and " + rows[j].token + ", vision " + std::to_string(int(vision))};
      }
  return closest;
}

TEST(Theme, WhatMayMeetInAPictureIsToldApartByEveryKindOfVision) {
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    std::vector<Row> rows = vectors_of(*theme);
    rows.push_back({"ink", theme->ink, 0});
    for (std::size_t i = 0; i < 3; ++i) rows.push_back({"link " + std::to_string(i + 1), theme->link[i], 0});
    const Closest closest = closest_pair(rows);
    EXPECT_GE(closest.difference, 12) << closest.names;  // the distance the colours were chosen for
  }
}

// Weights lie on ghosts, which at most are half of a link's colour; on links themselves arrows have an edge of the background's colour.
TEST(Theme, WeightsAreSeenOnGhosts) {
  const auto half = [](Color over, Color below) {
    const auto mean = [](std::uint8_t a, std::uint8_t b) { return std::uint8_t((a + b) / 2); };
    return Color{mean(over.r, below.r), mean(over.g, below.g), mean(over.b, below.b), 1};
  };
  for (const Theme* theme : {&light_theme(), &dark_theme()})
    for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(contrast(theme->force, half(theme->link[i], theme->background)), 3) << i;
  // Negative control: the ochre that weights had in the dark was lost there.
  EXPECT_LT(contrast(color_of(0xA6812B), half(dark_theme().link[1], dark_theme().background)), 2);
}

TEST(Theme, RedAndGreenOfAFrameAreConfusedWhichIsWhyAxesBearLetters) {
  // The negative control of the test above: a pair known to be too close is found to be.
  EXPECT_LT(difference(Vision::deutan, light_theme().axis[0], light_theme().axis[1]), 12);
  EXPECT_GT(difference(Vision::normal, light_theme().axis[0], light_theme().axis[1]), 40);
}

// Four times the distance that any two marks have; both sides are words too, and so at least 4.5 above the page.
TEST(Theme, TwoSidesOfAComparisonAreFarApart) {
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    for (const Vision vision : kVisions) EXPECT_GE(difference(vision, theme->side_a, theme->side_b), 48) << int(vision);
    for (const Color side : {theme->side_a, theme->side_b}) EXPECT_GE(contrast(side, theme->background), 4.5);
  }
}

}  // namespace
}  // namespace chainreel

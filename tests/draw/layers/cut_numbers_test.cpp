// What films say of an axis that is cut: words that can be read, true at every frame.
#include "draw/layers/cut_numbers.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

constexpr double kFilmRate = 60;
constexpr double kStepRoundOff = 1e-12;  // of quotients of small whole numbers

// Cut in frames [from, until) of 120, with the mass grow(k) there.
template <class Grow>
std::vector<CutNumber> said(int from, int until, Grow grow) {
  std::vector<CutLength> lengths(120);
  for (int k = from; k < until; ++k) lengths[std::size_t(k)] = grow(k);
  return numbers_along(lengths, kFilmRate);
}

TEST(CutNumbers, OfAPassageThatRunsAreOneBoundThatHoldsInAllOfIt) {
  const auto grow = [](int k) { return 8.92 * std::pow(1.5, 5 - std::abs(k - 35)); };
  const auto numbers = said(30, 41, grow);
  double before = 0;
  for (int k = 29; k < 42; ++k) {
    const CutNumber& now = numbers[std::size_t(k)];
    if (k >= 30 && k < 41) {
      EXPECT_EQ(now.bound, "> 5") << k;
      EXPECT_GT(now.length, 5) << k;
      EXPECT_GT(now.opacity, 0) << k;
    }
    const double opacity = k >= 30 && k < 41 ? now.opacity : 0;
    EXPECT_LE(std::abs(opacity - before), 0.25 + kStepRoundOff) << "a third of 11 frames, rounded, to come: " << k;
    before = opacity;
  }
  EXPECT_EQ(numbers[35].opacity, 1);
}

// Negative control: a number that can be read is said.
TEST(CutNumbers, StandWhereTheyChangeSlowly) {
  const auto numbers = said(20, 100, [](int k) { return 10 * std::pow(1.3, k / 60.0); });
  for (int k = 20; k < 100; ++k) EXPECT_EQ(numbers[std::size_t(k)].bound, "");
  // 0.15 s are 9 frames.
  EXPECT_NEAR(numbers[20].opacity, 1.0 / 9, kStepRoundOff);
  EXPECT_EQ(numbers[28].opacity, 1);
  EXPECT_NEAR(numbers[99].opacity, 1.0 / 9, kStepRoundOff);
  // A passage that is too short to read a number, however slow.
  EXPECT_EQ(said(20, 45, [](int) { return 10.5; })[30].bound, "> 10");
}

TEST(CutNumbers, AreWhereThePassageSlowsDown) {
  // Quick for 0.1 s, then slow until the end of the film.
  const auto numbers = said(10, 120, [](int k) { return 4.2 * std::pow(1.4, std::min(k - 10, 6)); });
  EXPECT_EQ(numbers[12].bound, "> 2");
  EXPECT_EQ(numbers[110].bound, "");
  EXPECT_EQ(numbers[119].opacity, 1) << "where the film ends nothing goes";
  std::set<std::string> bounds;
  for (int k = 10; k < 120; ++k) bounds.insert(numbers[std::size_t(k)].bound);
  EXPECT_EQ(bounds.size(), 2u);
}

TEST(CutNumbers, BoundsAreBelowAllThatTheyAreOf) {
  const auto bound = [](double length) { return said(20, 25, [&](int) { return length; })[22].bound; };
  EXPECT_EQ(bound(5.001), "> 5");
  EXPECT_EQ(bound(5), "> 2") << "it is not above itself";
  EXPECT_EQ(bound(1), "> 0.5");
  EXPECT_EQ(bound(1000), "> 500");
  EXPECT_EQ(bound(575), "> 500");
  EXPECT_EQ(bound(0.0342), "> 0.02");
  EXPECT_EQ(bound(2.3e6), "> 2\u00D710\u2076");
  EXPECT_EQ(said(20, 25, [](int k) { return k == 22 ? HUGE_VAL : 34.0; })[22].bound, "> 20") << "of an open one, too";
}

// How heavy the arm is becomes seen while it is: each bound is true, and stands as long as it takes to read it.
TEST(CutNumbers, GrowAndFallWithTheAxis) {
  const auto grow = [](int k) { return 12 * std::pow(1.15, 50 - std::abs(k - 60)); };
  const auto numbers = said(10, 111, grow);
  std::vector<std::string> bounds;
  for (int k = 10, since = 10; k < 111; ++k) {
    const CutNumber& now = numbers[std::size_t(k)];
    EXPECT_GT(now.length, std::stod(now.bound.substr(2))) << k;
    if (k == 10 || now.bound != numbers[std::size_t(k - 1)].bound) {
      EXPECT_TRUE(k == 10 || k - since >= 18) << k;
      bounds.push_back(now.bound);
      since = k;
    }
  }
  EXPECT_THAT(bounds, ::testing::ElementsAre("> 10", "> 100", "> 2000", "> 100", "> 10"));
}

TEST(CutNumbers, OfAnAxisThatLeadsFarOutAreBoundsHoweverSlow) {
  const std::vector<CutLength> still(120, 2981.0);
  EXPECT_EQ(numbers_along(still, kFilmRate, 2000)[60].bound, "> 2000");
  EXPECT_EQ(numbers_along(still, kFilmRate, 4000)[60].bound, "") << "negative control";
}

// The film of the fall: through the straight pose the ellipse grows out of its scene and comes back within 0.2 s. A still of an
// instant within has its number.
TEST(CutNumbers, OfAFilmAreNoneThatRuns) {
  Scene scene = read_scene("assets/scenes/rr_ellipse.yaml");
  const Simulation simulation = prepare(scene, false);
  std::vector<double> times;
  for (int k = 0; k < 60; ++k) times.push_back(k / kFilmRate);
  const Trajectory run = simulate(simulation, times);
  const Fonts fonts;
  const Film film(scene, {{scene, simulation.chain, run, &simulation}}, times, fonts);
  std::set<std::string> words, of_stills;
  for (int k = 20; k < 40; ++k) {
    std::set<std::string> of_both_axes;
    for (const auto& [picture, seen] : {std::pair{film.frame(k), &words}, {film.still(k), &of_both_axes}})
      for (const GlyphRun& glyphs : test::all_of<GlyphRun>(picture))
        if (glyphs.text.ends_with(" kg") && glyphs.color.a > 0) seen->insert(glyphs.text.substr(glyphs.text.find_first_not_of(" =")));  // behind a name
    of_both_axes.erase("1 kg");  // of the bar
    // Where the film has but one of them, too: it fades before the other goes.
    EXPECT_EQ(of_both_axes.size(), 2u) << k;
    of_stills.insert(of_both_axes.begin(), of_both_axes.end());
  }
  words.erase("1.00 kg");
  int bounds = 0;
  for (const std::string& word : words) bounds += word.starts_with(">") ? 1 : 0;
  EXPECT_EQ(bounds, 1);
  // But for those so heavy that their axes lead out by ten pages.
  int numbers = 0;
  for (const std::string& word : of_stills) {
    if (word.starts_with(">"))
      EXPECT_GE(std::stod(word.substr(2)), 100) << word;
    else
      ++numbers;
  }
  EXPECT_GT(numbers, 1);
}

}  // namespace
}  // namespace chainreel

// Plots beside the scene of a clip.
#include "draw/film/plot_strip.hpp"

#include "draw/film/exact_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw/page/house_style.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

StripRun run_of(const std::string& title, bool wild, const std::vector<double>& y) {
  PlotCurves plot;
  plot.title = "height [m]";
  plot.curves.push_back({"", y});
  StripRun run{title, wild, {{}}, {plot}};
  for (std::size_t k = 0; k < y.size(); ++k) run.times[0].push_back(double(k));
  return run;
}

PlotStyle style_of(const Fonts& fonts) {
  return {&fonts, &light_theme(), 1};
}

constexpr Rect kStripArea{0.1, 0.1, 1.6, 0.4};

double right_end(const Picture& picture, Color color) {
  double right = 0;
  for (const Item& item : picture.items)
    if (const auto* trail = std::get_if<Trail>(&item.shape))
      if (trail->color == color)
        for (const TrailPoint& point : trail->points) right = std::max(right, point.p.x);
  return right;
}

TEST(PlotStrip, DrawsThePastInFullAndTheFuturePale) {
  const Fonts fonts;
  const PlotStrip strip(strip_data({run_of("a", false, {0, 1, 2, 3, 4})}, 0, 4, light_theme()), kStripArea,
                        style_of(fonts));
  Picture still, moving;
  strip.draw_static(still);
  strip.draw_frame(moving, 2);
  const Color full = light_theme().curve[0];
  const double width = size::kPlotLine;
  EXPECT_NEAR(right_end(moving, full), strip.frame().at_x(2), width);
  EXPECT_NEAR(right_end(still, full.faded(0.45)), strip.frame().at_x(4), width);
  EXPECT_EQ(right_end(still, full), 0);
}

// Of one colour below the other nobody would know that there are two.
TEST(PlotStrip, TheSecondOfTwoEqualCurvesShowsTheFirstThroughItsGaps) {
  const Fonts fonts;
  const auto two = [](double apart) {
    StripRun run = run_of("a", false, {0, 1, 2, 3, 4});
    run.plots[0].curves[0].name = "lambda1";
    run.plots[0].curves.push_back({"lambda2", {0, 1 + apart, 2, 3, 4}});
    return strip_data({run}, 0, 4, light_theme());
  };
  const StripData equal = two(0.001), apart = two(0.1);
  EXPECT_TRUE(equal.curves[1].covers);
  EXPECT_EQ(equal.curves[1].style.dash, Dash::even);
  EXPECT_FALSE(equal.curves[0].covers);
  EXPECT_FALSE(apart.curves[1].covers);
  EXPECT_EQ(apart.curves[1].style.dash, Dash::dashed);
  // What is to come of it hides the other one in its dashes, or both would mix.
  Picture picture;
  PlotStrip(equal, kStripArea, style_of(fonts)).draw_static(picture);
  const auto of = [&](Color color) { return test::all_of<Trail>(picture, [&](const Trail& trail) { return trail.color == color; }).size(); };
  EXPECT_EQ(of(light_theme().background), 1u);
  EXPECT_GE(of(light_theme().curve[1].faded(0.45)), 1u);
}

TEST(PlotStrip, RunsThatWentWildDoNotDecideOnTheAxis) {
  const Fonts fonts;
  const auto tame = run_of("a", false, {0, 1, 2}), wild = run_of("b", true, {0, 50, 1e8});
  const PlotStrip strip(strip_data({tame, wild}, 0, 2, light_theme()), kStripArea, style_of(fonts));
  EXPECT_LT(strip.frame().y.high, 3);
  const PlotStrip alone(strip_data({wild}, 0, 2, light_theme()), kStripArea, style_of(fonts));
  EXPECT_GT(alone.frame().y.high, 1e7);
}

// Few peaks far above the rest leave the plot, and their numbers stand there; what comes to stay, many peaks, and a constant with a pulse do not.
TEST(PlotStrip, NeedlesLeaveThePlotWithTheirNumbers) {
  const Fonts fonts;
  const auto curve = [](auto value) {
    std::vector<double> y;
    for (int k = 0; k <= 1000; ++k) y.push_back(value(k));
    return y;
  };
  const auto wave = [](int k) { return 5 * std::sin(0.02 * k); };
  const auto near = [](int k, int at) { return std::exp(-std::pow((k - at) / 3.0, 2)); };
  const auto needles = curve([&](int k) { return wave(k) - 260 * near(k, 300) - 170 * near(k, 700) + 8 * near(k, 500); });
  const auto drawn = [&](const std::vector<double>& y, const Rect& area = kStripArea) {
    StripRun run = run_of("a", false, y);
    run.plots[0].title = "force [N]";
    PlotStrip strip(strip_data({run}, 0, 1000, light_theme()), area, style_of(fonts));
    Picture still, moving;
    strip.draw_static(still);
    strip.draw_frame(moving, 500);
    const auto heads = [](const Picture& picture) { return test::all_of<Polygon>(picture, [](const Polygon& p) { return p.count == 3; }).size(); };
    return std::tuple{strip.frame().y, test::words_of(still), heads(still), heads(moving)};
  };
  const auto [axis, words, all, so_far] = drawn(needles);
  EXPECT_GT(axis.low, -30);
  EXPECT_GT(axis.high, 7.9 - 5) << "a peak that is not much higher than the rest is in the plot";
  EXPECT_NE(words.find("\u2212260 N"), std::string::npos) << words;
  EXPECT_NE(words.find("\u2212170 N"), std::string::npos) << words;
  EXPECT_EQ(all, 2u);
  EXPECT_EQ(so_far, 1u) << "the other one is to come";
  const auto dense = curve([&](int k) { return 5 * std::sin(0.5 * k) - 260 * near(k, 300); });
  EXPECT_NE(std::get<1>(drawn(dense)).find("to \u2212260 N"), std::string::npos) << "no room beside";
  // In a short clip one needle takes a larger part of the time; two of them, or one that leaves the rest readable, are how the curve is.
  const auto wide = [](int k, int at) { return std::exp(-std::pow((k - at) / 60.0, 2)); };
  EXPECT_GT(std::get<0>(drawn(curve([&](int k) { return wave(k) - 260 * wide(k, 600); }))).low, -30);
  EXPECT_LT(std::get<0>(drawn(curve([&](int k) { return wave(k) - 60 * wide(k, 600); }))).low, -55);
  EXPECT_LT(std::get<0>(drawn(curve([&](int k) { return wave(k) - 260 * wide(k, 300) - 260 * wide(k, 700); }))).low, -250);
  const auto keeps_all = [&](auto value) {
    const auto shown = drawn(curve(value));
    EXPECT_EQ(std::get<2>(shown), 0u);
    return std::get<0>(shown);
  };
  EXPECT_GT(keeps_all([&](int k) { return wave(k) + 260 * near(k, 1000); }).high, 250) << "it does not come back";
  EXPECT_GT(keeps_all([&](int k) { return wave(k) + 15 * near(k, 300); }).high, 13.6) << "no five times as high";
  EXPECT_GT(keeps_all([&](int k) { return 260 * near(k, 300); }).high, 250) << "all that happens";
  EXPECT_GT(keeps_all([&](int k) {
              double y = wave(k);
              for (int at = 100; at < 1000; at += 100) y += 260 * std::exp(-std::pow((k - at) / 1.0, 2));
              return y;
            }).high, 250) << "nine of them are how it is";
}

// Where one leaves the plot it points on, and how far it gets is said.
TEST(PlotStrip, RunsThatWentWildSayWhereTheyGo) {
  const Fonts fonts;
  const auto tame = run_of("a", false, {0, 1, 2}), wild = run_of("b", true, {0, 50, 3e8});
  const auto drawn = [&](const std::vector<StripRun>& runs, double t) {
    Picture picture;
    const PlotStrip strip(strip_data(runs, 0, 2, light_theme()), kStripArea, style_of(fonts));
    strip.draw_static(picture);
    const std::size_t before = picture.items.size();
    strip.draw_frame(picture, t);
    picture.items.erase(picture.items.begin(), picture.items.begin() + std::ptrdiff_t(before));
    return picture;
  };
  const auto words = [&](const std::vector<StripRun>& runs) {
    Picture picture;
    PlotStrip(strip_data(runs, 0, 2, light_theme()), kStripArea, style_of(fonts)).draw_static(picture);
    return test::words_of(picture);
  };
  EXPECT_NE(words({tame, wild}).find("to 3\u00D710\u2078 m"), std::string::npos) << words({tame, wild});
  EXPECT_EQ(words({tame, tame}).find("to "), std::string::npos);
  const auto heads = [](const Picture& picture) { return test::all_of<Polygon>(picture, [](const Polygon& p) { return p.count == 3; }).size(); };
  EXPECT_EQ(heads(drawn({tame, wild}, 2)), 1u);
  EXPECT_EQ(heads(drawn({tame, wild}, 0.5)), 0u) << "not before it leaves";
  EXPECT_EQ(heads(drawn({tame, tame}, 2)), 0u);
}

// A curve that ends within the frame, as that of a run that was stopped, goes nowhere from there.
TEST(PlotStrip, NoLineLeadsFromWhereACurveEndsEarly) {
  const Fonts fonts;
  const auto reaches = [&](double end) {
    Picture picture;
    PlotStrip strip(strip_data({run_of("a", false, {0, 1, 2}), run_of("b", false, {0, 1, 1}), run_of("c", false, {0, 0, 0})}, 0, end, light_theme()), kStripArea, style_of(fonts));
    strip.draw_static(picture);
    EXPECT_NE(test::words_of(picture).find("b"), std::string::npos) << "it is named";
    const double middle = (strip.frame().at_x(2) + strip.frame().box.x1) / 2;  // of what lies behind its end
    const auto leads_on = [&](const Capsule& line) { return line.a.x < middle - 0.02 && line.a.x > strip.frame().box.x0 + 0.02 && line.b.x > middle + 0.02; };
    return test::all_of<Capsule>(picture, leads_on).size();
  };
  EXPECT_EQ(reaches(4), 0u);
}

// Whatever a run grows to has its place there; negative control: on a linear axis a wild one leaves it.
TEST(PlotStrip, AnAxisOfFactorsHoldsWhatGrowsWithoutEnd) {
  const Fonts fonts;
  const auto strip = [&](PlotScale scale) {
    std::vector<StripRun> runs{run_of("calm", false, {1, 2, 1, 2, 1}), run_of("wild", true, {1, 1e2, 1e5, 1e6, 1e8})};
    for (StripRun& run : runs) run.plots[0].scale = scale, run.step = 2;
    return PlotStrip(strip_data(runs, 0, 4, light_theme()), kStripArea, style_of(fonts));
  };
  const PlotFrame factors = strip(PlotScale::log).frame(), linear = strip(PlotScale::linear).frame();
  EXPECT_EQ(factors.y.scale, Scale::log);
  EXPECT_GT(factors.y.high, 1e8);
  EXPECT_LT(factors.y.low, 1);
  EXPECT_GT(factors.y.low, 0.01);
  EXPECT_LT(linear.y.high, 3);
  // Between the ends of steps, at 1 s and 3 s, it has no points: lines there would be none of the run's.
  Picture picture;
  strip(PlotScale::log).draw_static(picture);
  const Color wild = light_theme().side_b.faded(0.45);
  for (const Trail& curve : test::all_of<Trail>(picture))
    if (curve.color == wild) EXPECT_EQ(curve.points.size(), 3u);
}

// What has no place there has its name, which says so; negative control: what has one for a while is named without.
TEST(PlotStrip, AnAxisOfFactorsNamesWhatIsNotAboveZero) {
  const Fonts fonts;
  const auto words_of = [&](const std::vector<double>& other) {
    StripRun run = run_of("a", false, {1, 10, 100, 1000, 1e308});
    run.plots[0].curves[0].name = "up";
    run.plots[0].curves.push_back({"down", other});
    run.plots[0].scale = PlotScale::log;
    const PlotStrip strip(strip_data({run}, 0, 4, light_theme()), kStripArea, style_of(fonts));
    EXPECT_TRUE(std::isfinite(strip.frame().y.high));
    Picture picture;
    strip.draw_static(picture);
    EXPECT_TRUE(test::all_finite(picture));
    return test::words_of(picture);
  };
  EXPECT_NE(words_of({-1, -2, 0, -3, -4}).find("down \u2264 0"), std::string::npos);
  const std::string once = words_of({1, 2, 0, -3, -4});
  EXPECT_NE(once.find("down"), std::string::npos);
  EXPECT_EQ(once.find("\u2264"), std::string::npos);
}

// Of a curve that runs off to a pole no number is told, for its samples there are chance; it points on where it leaves for good.
TEST(PlotStrip, CurvesThatRunOffToAPolePointOnAndTellNoNumber) {
  const Fonts fonts;
  const auto drawn = [&](const std::vector<double>& y, double& high) {
    StripRun run = run_of("a", false, y);
    run.plots[0].curves[0].shown_low = -2, run.plots[0].curves[0].shown_high = 2;
    const PlotStrip strip(strip_data({run}, 0, 4, light_theme()), kStripArea, style_of(fonts));
    high = strip.frame().y.high;
    Picture picture;
    strip.draw_static(picture);
    return picture;
  };
  const auto heads = [](const Picture& picture) { return test::all_of<Polygon>(picture, [](const Polygon& p) { return p.count == 3; }).size(); };
  double high = 0;
  for (const double farthest : {9.0, 900.0}) {
    const Picture leaves = drawn({0, 1, 5, farthest, NAN}, high);
    EXPECT_LT(high, 2.2);
    EXPECT_EQ(heads(leaves), 1u);
    EXPECT_EQ(test::words_of(leaves).find("to "), std::string::npos);
  }
  EXPECT_EQ(heads(drawn({0, 9, 1, 0.5, 0}, high)), 0u) << "it comes back";
}

// Unless a run lies on it, the exact curve is there, and named where names of runs have no room.
TEST(PlotStrip, RunsThatErrHaveTheExactCurveBesideThem) {
  const Fonts fonts;
  const auto exact = run_of("exact", false, {0, 1, 2}), far = run_of("a", false, {0, 1.5, 3}), wild = run_of("b", true, {0, 50, 3e8});
  const auto strip_of = [&](const std::vector<StripRun>& runs, const StripRun& truth, double end = 2) {
    StripData data = strip_data(runs, 0, end, light_theme());
    add_exact(data, truth, 0, light_theme());
    return data;
  };
  const StripData data = strip_of({far, wild}, exact);
  ASSERT_EQ(data.curves.size(), 3u);
  EXPECT_EQ(data.curves.front().label, "exact") << "below the others";
  EXPECT_EQ(data.curves.front().style.color, light_theme().ink);
  EXPECT_EQ(strip_of({far, exact}, exact).curves.size(), 2u) << "one of them is exact";
  EXPECT_EQ(strip_of({far, wild}, exact, 4).curves.front().label, "exact until 2 s");
  Picture picture;
  PlotStrip(data, {0.1, 0.1, 0.5, 0.4}, style_of(fonts)).draw_static(picture);
  EXPECT_NE(test::words_of(picture).find("thin: exact"), std::string::npos);
  EXPECT_EQ(test::words_of(picture).find("to 3"), std::string::npos) << "that had no room";
}

// What hardly changes is shown with zero, but where runs differ in that it changes.
TEST(PlotStrip, WhatOneRunKeepsAndAnotherDoesNotIsSeen) {
  const Fonts fonts;
  const auto kept = run_of("a", false, {-20, -20, -20}), drifts = run_of("b", false, {-20, -19.9, -19.7}), alike = run_of("c", false, {-20, -19.7, -20});
  const auto axis = [&](const std::vector<StripRun>& runs) { return PlotStrip(strip_data(runs, 0, 2, light_theme()), kStripArea, style_of(fonts)).frame().y; };
  EXPECT_LT(axis({kept, drifts}).high, -19.5);
  EXPECT_GE(axis({drifts}).high, 0) << "by itself";
  EXPECT_GE(axis({alike, alike}).high, 0) << "what both do alike";
  EXPECT_GE(axis({kept, kept}).high, 0);
}

// Where steps end, and what nobody promises, is seen in the plot itself.
TEST(PlotStrip, MarksLongStepsAndWhatIsNotAccurate) {
  const Fonts fonts;
  const auto drawn = [&](const StripRun& run, PlotQuantity quantity = PlotQuantity::expression, Rect area = kStripArea) {
    StripRun shown = run;
    shown.plots[0].quantity = quantity;
    Picture still;
    PlotStrip(strip_data({shown}, 0, 4, light_theme()), area, style_of(fonts)).draw_static(still);
    return still;
  };
  const auto discs = [](const Picture& picture) { return test::all_of<Ellipse>(picture).size(); };
  const auto zones = [](const Picture& picture) {
    return test::all_of<Polygon>(picture, [](const Polygon& p) { return p.paint.fill == light_theme().grid; }).size();
  };
  StripRun run = run_of("a", false, {0, 1, 2, 3, 4});
  const std::size_t none = discs(drawn(run));
  run.step = 2;
  EXPECT_EQ(discs(drawn(run)) - none, 3u * (discs(drawn(run)) - none) / 3) << "a mark each at 0, 2 and 4";
  EXPECT_GE(discs(drawn(run)), none + 3);
  const std::size_t ends = discs(drawn(run));
  run.breaks = {1};
  EXPECT_EQ(3 * (discs(drawn(run)) - none), 4 * (ends - none)) << "a torque jumps at 1 s, where a step ends, too";
  run.breaks.clear();
  run.step = 0;
  EXPECT_EQ(zones(drawn(run)), 0u);
  EXPECT_EQ(test::words_of(drawn(run)).find("until"), std::string::npos);
  run.energy_off = 0.567;
  EXPECT_EQ(test::words_of(drawn(run)).find("error"), std::string::npos) << "a plot of something else";
  EXPECT_NE(test::words_of(drawn(run, PlotQuantity::energy)).find("numerical error of total: 0.57 J"), std::string::npos);
  const std::string narrow = test::words_of(drawn(run, PlotQuantity::energy, {0.1, 0.1, 0.5, 0.4}));
  EXPECT_EQ(narrow.find("numerical"), std::string::npos);
  EXPECT_NE(narrow.find("error: 0.57 J"), std::string::npos) << "shorter rather than nothing";
  run.steps = "semi-implicit Euler, 1 ms";
  EXPECT_NE(test::words_of(drawn(run, PlotQuantity::energy)).find("semi-implicit Euler, 1 ms: total off by 0.57 J"), std::string::npos) << "the cause, where it has room";
  run.accurate_until = 2.6584;
  EXPECT_EQ(zones(drawn(run)), 1u);
  EXPECT_NE(test::words_of(drawn(run)).find("accurate until 2.66 s"), std::string::npos);
  run.accurate_until = 4;
  EXPECT_EQ(zones(drawn(run)), 0u) << "to the end of the clip";
}

// A mass that passes a pole between two samples leaves the plot below what these have, which is as high as chance has it; one without is whole.
TEST(PlotStrip, MassesLeaveThePlotAtTheirPoles) {
  const Fonts fonts;
  const auto strip = [&](double pole) {
    std::vector<double> longer, shorter;
    for (int k = 0; k <= 200; ++k) longer.push_back(1 + 1e4 / ((k - pole) * (k - pole))), shorter.push_back(1);
    StripRun run = run_of("a", false, longer);
    run.plots[0].quantity = PlotQuantity::effective_mass;
    run.plots[0].curves = {{"Lambda1", longer}, {"Lambda2", shorter}};
    return PlotStrip(strip_data({run}, 0, 200, light_theme()), kStripArea, style_of(fonts));
  };
  const Axis cut = strip(100.3).frame().y, whole = strip(-150).frame().y;
  EXPECT_EQ(cut.scale, Scale::log);
  EXPECT_LT(cut.high, 1e4 / (1.3 * 1.3));
  EXPECT_GT(cut.high, 1e4 / (6 * 6.0));
  EXPECT_EQ(whole.scale, Scale::linear) << "less than two decades";
  Picture picture;
  strip(100.3).draw_static(picture);
  EXPECT_TRUE(test::all_finite(picture));
  EXPECT_GT(right_end(picture, light_theme().ellipse.faded(0.45)), kStripArea.x0) << "as the axes of the ellipse";
}

// Samples on the pole itself, as where a film stands still there, do not press the rest of the curve to its bottom.
TEST(PlotStrip, PolesHaveThreeDecadesAtMost) {
  const Fonts fonts;
  std::vector<double> masses;
  for (int k = 0; k <= 200; ++k) masses.push_back(k >= 100 && k < 110 ? 1e6 : 2 + k % 10);
  StripRun run = run_of("a", false, masses);
  run.plots[0].quantity = PlotQuantity::effective_mass;
  const Axis axis = PlotStrip(strip_data({run}, 0, 200, light_theme()), kStripArea, style_of(fonts)).frame().y;
  EXPECT_NEAR(axis.high, 2000, 1e-9);
}

// A curve of one body has its colour, whichever place it has in its plot; those of constraints have that of their arrows, in two tones.
TEST(PlotStrip, CurvesHaveTheColourOfWhatTheyAreOf) {
  const auto colours = [](PlotCurves plot) {
    StripRun run = run_of("a", false, {0, 1, 2});
    for (PlotCurve& curve : plot.curves) curve.y = {0, 1, 2};
    run.plots = {std::move(plot)};
    std::vector<Color> found;
    for (const StripCurve& curve : strip_data({run}, 0, 2, light_theme()).curves) found.push_back(curve.style.color);
    return found;
  };
  PlotCurves second, row;
  second.curves = {{"q2", {}}};
  second.curves[0].body = 2;
  EXPECT_EQ(colours(second), (std::vector<Color>{light_theme().curve[1]}));
  second.curves[0].body = 0;
  EXPECT_EQ(colours(second), (std::vector<Color>{light_theme().curve[0]})) << "of none";
  row.quantity = PlotQuantity::lambda;
  row.curves = {{"lambda1", {}}, {"lambda2", {}}};
  const auto tones = colours(row);
  EXPECT_EQ(tones[0], light_theme().constraint);
  EXPECT_NE(tones[1], tones[0]);
  EXPECT_GE(contrast(tones[1], light_theme().background), 3) << "as marks have";
}

// Of a mass that is infinite all along there is no curve, but that is said.
TEST(PlotStrip, SaysThatAMassIsInfinite) {
  const Fonts fonts;
  StripRun run = run_of("a", false, {});
  run.times = {{0, 1, 2}};
  run.plots[0].quantity = PlotQuantity::effective_mass;
  run.plots[0].curves = {{"Lambda1", {HUGE_VAL, HUGE_VAL, HUGE_VAL}}, {"Lambda2", {1, 1, 1}}};
  Picture picture;
  PlotStrip(strip_data({run}, 0, 2, light_theme()), kStripArea, style_of(fonts)).draw_static(picture);
  EXPECT_NE(test::words_of(picture).find("\u221E"), std::string::npos);
}

// A motion of 10 J: what its sum of energies does within a method's noise is a line, a hundredth of what moves is a drift.
TEST(PlotStrip, NoiseOfAnEnergyThatIsKeptIsNoCurve) {
  const Fonts fonts;
  const auto energies = [](const std::string& title, const std::vector<double>& total) {
    StripRun run = run_of(title, false, total);
    run.plots[0].quantity = PlotQuantity::energy;
    run.plots[0].title = "energy [J]";
    run.plots[0].curves = {{"kinetic", {0, 10, 0}}, {"potential", {0, -10, 0}}, {"total", total}};
    return run;
  };
  const auto strip = [&](const std::vector<StripRun>& runs, const Rect& area = kStripArea) {
    return PlotStrip(strip_data(runs, 0, 2, light_theme()), area, style_of(fonts));
  };
  const auto span = [](const PlotStrip& one) { return one.frame().y.high - one.frame().y.low; };
  const PlotStrip kept = strip({energies("a", {0, 0, 0}), energies("b", {0, 0.001, 0.00213})});
  EXPECT_GE(span(kept), 0.05 * 10);
  EXPECT_EQ(kept.frame().y.title, "energy [J], constant to 0.0022 J");
  EXPECT_EQ(strip({energies("a", {0, 0, 0}), energies("b", {0, 0.001, 0.00213})}, {0.1, 0.1, 0.5, 0.4}).frame().y.title, "energy [J]") << "no room";
  const PlotStrip drifts = strip({energies("a", {-200, -200, -200}), energies("b", {-200, -199.95, -199.9})});
  EXPECT_LT(span(drifts), 0.1 / 0.15) << "a drift of 0.1 J is more than a seventh of the plot";
  EXPECT_EQ(drifts.frame().y.title, "energy [J]");
  // By itself an energy has its parts beside it; other quantities have no scale.
  EXPECT_LT(span(strip({run_of("a", false, {0, 0, 0}), run_of("b", false, {0, 0.001, 0.002})})), 0.003);
}

TEST(PlotStrip, TwoRunsBearTheColoursOfTheirTitlesMoreAreNamed) {
  const auto a = run_of("left", false, {0, 1}), b = run_of("right", false, {1, 0}),
             c = run_of("third", false, {0, 0});
  const StripData two = strip_data({a, b}, 0, 1, light_theme());
  EXPECT_EQ(two.curves[0].style.color, light_theme().side_a);
  EXPECT_EQ(two.curves[1].style.color, light_theme().side_b);
  EXPECT_EQ(two.curves[0].label, "");
  const StripData three = strip_data({a, b, c}, 0, 1, light_theme());
  EXPECT_EQ(three.curves[2].label, "third");
}

// What a title in its colour says need not be said again where the end tells what has become of an energy.
TEST(PlotStrip, EnergiesOfRunsThatTitlesNameEndInNumbers) {
  std::vector<StripRun> runs{run_of("kept", false, {-20.8, -20.8}), run_of("gained", false, {-20.8, 0.71}), run_of("wild", true, {-20.8, 1e12})};
  for (StripRun& run : runs) run.is_named_by_colour = true;
  const StripData heights = strip_data(runs, 0, 1, light_theme());
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(heights.curves[i].label, runs[i].title);
  for (StripRun& run : runs) run.plots[0].quantity = PlotQuantity::energy_error, run.plots[0].title = "energy error [J]";
  const StripData energies = strip_data(runs, 0, 1, light_theme());
  EXPECT_EQ(energies.curves[0].label, "\u221220.8 J");
  EXPECT_EQ(energies.curves[1].label, "0.7 J");
  EXPECT_EQ(energies.curves[2].label, "");
  runs[1].is_named_by_colour = false;  // where colours do not tell them apart, their names do
  EXPECT_EQ(strip_data(runs, 0, 1, light_theme()).curves[1].label, "gained");
}

// Runs of what is written: the math face says q, the label face its unit.
std::vector<GlyphRun> strip_words(const PlotStrip& strip) {
  Picture picture;
  strip.draw_static(picture);
  std::vector<GlyphRun> runs;
  for (const Item& item : picture.items)
    if (const auto* run = std::get_if<GlyphRun>(&item.shape)) runs.push_back(*run);
  return runs;
}

bool says(const std::vector<GlyphRun>& runs, Face face, const std::string& text) {
  return std::any_of(runs.begin(), runs.end(), [&](const GlyphRun& run) { return run.face == face && run.text == text; });
}

TEST(PlotStrip, NamesOfQuantitiesAreFormulasAndAllOthersAreWords) {
  const Fonts fonts;
  StripRun run = run_of("a", false, {0, 1, 2});
  run.plots[0] = {PlotQuantity::tau, "tau [N m]", false, {{"tau1", {0, 1, 2}}, {"tau2", {0, 2, 4}}}};
  const auto symbols = strip_words(PlotStrip(strip_data({run}, 0, 2, light_theme()), kStripArea, style_of(fonts)));
  EXPECT_TRUE(says(symbols, Face::math, "\U0001D70F"));
  EXPECT_TRUE(says(symbols, Face::label, " [N m]"));
  EXPECT_FALSE(says(symbols, Face::label, "tau1"));
  run.plots[0] = {PlotQuantity::expression, "cost [$]", false, {{"", {0, 1, 2}}}};
  EXPECT_TRUE(says(strip_words(PlotStrip(strip_data({run}, 0, 2, light_theme()), kStripArea, style_of(fonts))),
                   Face::label, "cost [$]"));
}

TEST(PlotStrip, TheAxisOfTimeEndsWithItsLastNumberAndUnit) {
  const Fonts fonts;
  // 599 / 60 s is the last frame of a clip of 10 s; 1.234 s is no round time.
  for (const auto& [end, text] : {std::pair{599.0 / 60, "10\u2009s"}, {1.234, "1.234\u2009s"}}) {
    const PlotStrip strip(strip_data({run_of("a", false, {0, 1, 2})}, 0, end, light_theme()), kStripArea, style_of(fonts));
    EXPECT_TRUE(says(strip_words(strip), Face::label, text));
    EXPECT_LE(strip.frame().box.x1, kStripArea.x1);
  }
}

TEST(PlotStrip, OfAConstantTakesHalfTheHeightOfOthers) {
  const auto share = [](const std::vector<double>& y) { return share_of_height(strip_data({run_of("a", false, y)}, 0, 2, light_theme())); };
  EXPECT_EQ(share({-5, -5 + 1e-9, -5}), 0.5);
  EXPECT_EQ(share({0, 0, 0}), 0.5);
  EXPECT_EQ(share({-5, -5.01, -5}), 1);
  const PlotAreas areas = plot_areas({0, 0, 1.7, 0.9}, 2, PlotPlace::right, 0, 1, kPlotsBeside, 0, {0.5, 1});
  constexpr double kWords = 0.075;  // that each has, whatever its share
  EXPECT_NEAR(2 * (areas.plots[0].height() - kWords), areas.plots[1].height() - kWords, 1e-12);
  EXPECT_NEAR(areas.plots[0].y1, 0.9, 1e-12);
  EXPECT_NEAR(areas.plots[1].y0, 0, 1e-12);
}

TEST(PlotStrip, HasThreeNumbersUpAnAngleAxisAtLeast) {
  const Fonts fonts;
  StripRun run = run_of("a", false, {0, -3.3, 0.7});
  run.plots[0].angles = true;
  const auto words = strip_words(
      PlotStrip(strip_data({run}, 0, 2, light_theme()), {0.1, 0.1, 1.6, 0.28}, style_of(fonts)));
  int pis = 0;
  for (const GlyphRun& word : words) pis += word.text.find("\u03C0") != std::string::npos;
  EXPECT_GE(pis, 2);  // beside 0
}

// Round steps of 0.5 have two numbers between 0.55 and 1.45, and so low a plot has no room for all of 0.6, 0.8, ..: every other one has its number.
TEST(PlotStrip, HasThreeNumbersUpEachAxisThatHasRoomForThem) {
  const Fonts fonts;
  const auto numbers = [&](const std::vector<double>& y, double height) {
    const PlotStrip strip(strip_data({run_of("a", false, y)}, 0, 2, light_theme()), {0.1, 0.1, 1.6, 0.1 + height}, style_of(fonts));
    const Rect& box = strip.frame().box;
    const auto words = strip_words(strip);
    return std::ranges::count_if(words, [&](const GlyphRun& word) { return word.origin.x < box.x0 - 0.005 && box.y0 - 0.012 < word.origin.y && word.origin.y < box.y1 + 0.012; });
  };
  EXPECT_EQ(numbers({0.6, 1.4, 0.6}, 0.19), 3);
  EXPECT_GE(numbers({1.3, 2.35, 1.3}, 0.19), 3);
  EXPECT_EQ(numbers({5, 5, 5}, 0.2), 3) << "0, half of it, and itself";
  EXPECT_LT(numbers({0.6, 1.4, 0.6}, 0.13), 3) << "no room: negative control";
}

TEST(PlotStrip, PlotsAndSceneShareThePageWithoutOverlap) {
  const Rect page{0.05, 0.1, 1.7, 0.9};
  const PlotAreas below = plot_areas(page, 2, PlotPlace::below);
  EXPECT_LT(below.plots[0].y1, below.scene.y0);
  EXPECT_LT(below.plots[0].x1, below.plots[1].x0);
  EXPECT_NEAR(below.plots[0].height(), 0.30 * page.height(), 1e-12);
  const PlotAreas right = plot_areas(page, 3, PlotPlace::right);
  EXPECT_LT(right.scene.x1, right.plots[0].x0);
  EXPECT_GT(right.plots[0].y0, right.plots[1].y1);
  EXPECT_NEAR(right.plots[0].width(), 0.38 * page.width(), 1e-12);
  EXPECT_NEAR(plot_areas(page, 1, PlotPlace::below, 0.28).plots[0].height(), 0.28, 1e-12);
  // Larger words leave the frame as high as it was.
  EXPECT_NEAR(plot_areas(page, 1, PlotPlace::below, 0, 1.5).plots[0].height(), 0.24 + 0.5 * 0.075, 1e-12);
  EXPECT_EQ(plot_areas(page, 0, PlotPlace::below).scene.y0, page.y0);
}

TEST(PlotStrip, WhatIsConstantOrNoNumberStillHasAnAxis) {
  const Fonts fonts;
  for (const std::vector<double>& y : {std::vector<double>{5, 5, 5}, {0, 0, 0}, {NAN, NAN}}) {
    const PlotStrip strip(strip_data({run_of("a", false, y)}, 0, 2, light_theme()), kStripArea, style_of(fonts));
    EXPECT_GT(strip.frame().y.high, strip.frame().y.low);
  }
}

}  // namespace
}  // namespace chainreel
